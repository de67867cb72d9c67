#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""drum.stl: a drum around the y axis, radius 8, length 6, with ends and eight lifters.

    python3 surface.py [facets of the circumference, 96] [rings, 4]
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from surfaces import brick, revolved, write  # noqa: E402

RADIUS, LENGTH, LIFTERS, HEIGHT, THICKNESS = 8.0, 6.0, 8, 1.2, 0.4


def main():
    facets = int(sys.argv[1]) if len(sys.argv) > 1 else 96
    rings = int(sys.argv[2]) if len(sys.argv) > 2 else 4
    half = LENGTH / 2
    shell = [(RADIUS, -half + LENGTH * k / rings) for k in range(rings + 1)]
    triangles = revolved([(0.0, -half)] + shell + [(0.0, half)], facets, "y")
    for k in range(LIFTERS):
        phi = 2.0 * math.pi * k / LIFTERS
        out, side = (math.cos(phi), 0.0, math.sin(phi)), (-math.sin(phi), 0.0, math.cos(phi))
        # the foot stands in the shell, so that no gap is left
        corner = [(RADIUS - HEIGHT) * out[d] - 0.5 * THICKNESS * side[d] - (half if d == 1 else 0.0) for d in range(3)]
        triangles += brick(corner, ([(HEIGHT + 0.1) * x for x in out], (0.0, LENGTH, 0.0), [THICKNESS * x for x in side]))
    write("drum.stl", triangles)


if __name__ == "__main__":
    main()
