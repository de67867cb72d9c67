#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Grains of a dump (id diameter x y z vx vy vz) and the triangles of an STL file, seen along one axis.

    python3 picture.py DUMP STL PICTURE [--along y] [--turn DEGREES] [--about AXIS] [--front FRACTION]
"""
import argparse

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import collections, pyplot  # noqa: E402


def grains(path):
    """The last snapshot: diameter, places, speeds."""
    rows = open(path).read().split("ITEM: ATOMS")[-1].split("\n")[1:]
    table = np.array([[float(w) for w in row.split()] for row in rows if row])
    return table[:, 1], table[:, 2:5], np.linalg.norm(table[:, 5:8], axis=1)


def triangles(path):
    data = np.fromfile(path, dtype=np.uint8)[84:].reshape(-1, 50)
    return data[:, 12:48].copy().view("<f4").reshape(-1, 3, 3).astype(float)


def turned(x, degrees, axis):
    a, b = (axis + 1) % 3, (axis + 2) % 3
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    y = x.copy()
    y[..., a], y[..., b] = c * x[..., a] - s * x[..., b], s * x[..., a] + c * x[..., b]
    return y


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dump")
    parser.add_argument("stl")
    parser.add_argument("picture")
    parser.add_argument("--along", default="y", choices=list("xyz"), help="from far positive to negative")
    parser.add_argument("--turn", type=float, default=0.0, help="of the surface, right-hand rule")
    parser.add_argument("--about", default="y", choices=list("xyz"))
    parser.add_argument("--tilt", type=float, default=0.0, help="of the camera, degrees")
    parser.add_argument("--opacity", type=float, default=0.12)
    arguments = parser.parse_args()
    depth = "xyz".index(arguments.along)
    across, up = {0: (1, 2), 1: (0, 2), 2: (0, 1)}[depth]
    d, x, speed = grains(arguments.dump)
    t = turned(triangles(arguments.stl), arguments.turn, "xyz".index(arguments.about))
    x, t = (turned(a, arguments.tilt, across) for a in (x, t))

    figure, ax = pyplot.subplots(figsize=(7, 7))
    ax.add_collection(collections.PolyCollection(t[:, :, (across, up)], facecolors="0.5", edgecolors="0.2", linewidths=0.15,
                                                 alpha=arguments.opacity))
    order = np.argsort(x[:, depth] * (1 if depth == 1 else -1))[::-1]
    circles = collections.EllipseCollection(d[order], d[order], 0, units="xy", offsets=x[order][:, (across, up)],
                                            offset_transform=ax.transData, cmap="viridis", edgecolors="k", linewidths=0.2)
    circles.set_array(speed[order])
    ax.add_collection(circles)
    figure.colorbar(circles, ax=ax, label="speed", shrink=0.7)
    lo, hi = t.reshape(-1, 3).min(0), t.reshape(-1, 3).max(0)
    ax.set_xlim(lo[across] - 1, hi[across] + 1)
    ax.set_ylim(lo[up] - 1, hi[up] + 1)
    ax.set_aspect("equal")
    ax.set(xlabel="xyz"[across], ylabel="xyz"[up])
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=100)


if __name__ == "__main__":
    main()
