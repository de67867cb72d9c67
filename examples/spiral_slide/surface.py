#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""slide.stl: a spiral floor with an outer and an inner wall, one and a half turns around the z axis.

    python3 surface.py [quads along one turn, 64]
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from surfaces import grid, write  # noqa: E402

INNER, OUTER, WALL, PITCH, TURNS = 2.0, 5.5, 2.0, 10.0, 1.5
PROFILE = [(INNER, 0.8), (INNER, 0.0), (OUTER, 0.0), (OUTER, WALL)]


def slide(u, v):
    radius, height = PROFILE[round(v * 3)]
    phi = 2.0 * math.pi * TURNS * u
    return (radius * math.cos(phi), radius * math.sin(phi), height + PITCH * TURNS * (1.0 - u))


def main():
    quads = int(sys.argv[1]) if len(sys.argv) > 1 else 64
    write("slide.stl", grid(slide, round(quads * TURNS), 3))


if __name__ == "__main__":
    main()
