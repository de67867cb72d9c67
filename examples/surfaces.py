# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Triangles of simple parts and the STL files that hold them, for the examples with walls of triangles."""
import math
import struct


def grid(place, nu, nv):
    """Triangles of the surface place(u, v), u and v from 0 to 1 in nu and nv steps: [(corner, corner, corner), ...]."""
    triangles = []
    for i in range(nu):
        for j in range(nv):
            a, b = place(i / nu, j / nv), place((i + 1) / nu, j / nv)
            c, d = place((i + 1) / nu, (j + 1) / nv), place(i / nu, (j + 1) / nv)
            triangles += [(a, b, c), (a, c, d)]
    return [t for t in triangles if len(set(t)) == 3]


def revolved(profile, facets, axis="z"):
    """The polygon profile = [(radius, height), ...] turned about an axis."""
    def place(u, v):
        k = min(int(v * (len(profile) - 1) + 0.5), len(profile) - 1)
        radius, height = profile[k]
        phi = 2.0 * math.pi * (round(u * facets) % facets) / facets
        ring = (radius * math.cos(phi), radius * math.sin(phi))
        return {"x": (height, *ring), "y": (ring[0], height, ring[1]), "z": (*ring, height)}[axis]
    return grid(place, facets, len(profile) - 1)


def brick(corner, edges):
    """The parallelepiped at corner with three edges."""
    def at(*n):
        return tuple(corner[d] + sum(n[k] * edges[k][d] for k in range(3)) for d in range(3))
    triangles = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        for side in (0, 1):
            def place(u, v):
                n = [0, 0, 0]
                n[i], n[j], n[k] = round(u), round(v), side
                return at(*n)
            triangles += grid(place, 1, 1)
    return triangles


def write(path, triangles):
    """A binary STL file."""
    with open(path, "wb") as f:
        f.write(bytes(80) + struct.pack("<I", len(triangles)))
        for t in triangles:
            f.write(struct.pack("<12fH", 0.0, 0.0, 0.0, *(c for corner in t for c in corner), 0))
    print(f"{path}: {len(triangles)} triangles")
