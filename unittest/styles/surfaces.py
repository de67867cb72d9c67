# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Triangles of simple shapes, and the files that hold them. Coordinates of an STL file have single precision."""
import numpy as np


def sheet(corner, u, v, n=1, m=None):
    """Rectangle from corner along u and v, normal u x v, of n x m quads: [triangles][3][3]."""
    corner, u, v = (np.array(a, dtype=float) for a in (corner, u, v))
    m = m or n
    faces = []
    for i in range(n):
        for j in range(m):
            p = [corner + u * (i + a) / n + v * (j + b) / m for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces += [(p[0], p[1], p[2]), (p[0], p[2], p[3])] if (i + j) % 2 else [(p[0], p[1], p[3]), (p[1], p[2], p[3])]
    return np.array(faces)


def box(lo, hi, n=1):
    """Six faces with outward normals."""
    lo, hi = np.array(lo, dtype=float), np.array(hi, dtype=float)
    e = np.diag(hi - lo)
    low = [sheet(lo, e[b], e[a], n) for a, b in ((0, 1), (1, 2), (2, 0))]
    high = [sheet(lo + e[c], e[a], e[b], n) for a, b, c in ((0, 1, 2), (1, 2, 0), (2, 0, 1))]
    return np.concatenate(low + high)


def tube(centre, radius, lo, hi, facets, rings=1):
    """Around the z axis through centre, open at its ends, vertices on the circle."""
    faces = []
    phi = 2.0 * np.pi * np.arange(facets + 1) / facets
    x = centre[0] + radius * np.cos(phi)
    y = centre[1] + radius * np.sin(phi)
    x[-1], y[-1] = x[0], y[0]
    z = np.linspace(lo, hi, rings + 1)
    for k in range(facets):
        for r in range(rings):
            p = [np.array([x[k + a], y[k + a], z[r + b]]) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces += [(p[0], p[1], p[2]), (p[0], p[2], p[3])]
    return np.array(faces)


def binary_stl(triangles):
    record = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("spare", "<u2")])
    record["corner"] = triangles
    return bytes(80) + np.uint32(len(triangles)).tobytes() + record.tobytes()


def ascii_stl(triangles, name="part"):
    lines = [f"solid {name}"]
    for t in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{float(c):.9g}" for c in p) for p in t]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + [f"endsolid {name}", ""])


def obj(triangles):
    lines = ["v " + " ".join(f"{float(c):.9g}" for c in p) for t in triangles for p in t]
    lines += [f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(triangles))]
    return "\n".join(lines) + "\n"


def ply(triangles):
    n = len(triangles)
    lines = ["ply", "format ascii 1.0", f"element vertex {3 * n}", "property float x", "property float y",
             "property float z", f"element face {n}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(f"{float(c):.9g}" for c in p) for t in triangles for p in t]
    lines += [f"3 {3 * k} {3 * k + 1} {3 * k + 2}" for k in range(n)]
    return "\n".join(lines) + "\n"
