#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""screw.stl: shaft and blade around the x axis; trough.stl: the U around them. Both reach past the periodic box 0 < x < 10.

    python3 surface.py [quads of the blade along one turn, 48]
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from surfaces import grid, write  # noqa: E402

SHAFT, BLADE, TROUGH, PITCH, FROM, TO, TOP = 0.8, 3.0, 3.1, 5.0, -2.5, 12.5, 10.0


def blade(u, v):
    x, radius = FROM + (TO - FROM) * u, SHAFT + (BLADE - SHAFT) * v
    phi = 2.0 * math.pi * x / PITCH
    return (x, radius * math.cos(phi), radius * math.sin(phi))


def shaft(u, v):
    x, phi = FROM + (TO - FROM) * u, 2.0 * math.pi * (FROM + (TO - FROM) * u) / PITCH + 2.0 * math.pi * v
    return (x, SHAFT * math.cos(phi), SHAFT * math.sin(phi))


def trough(u, v):
    x, bend = FROM + (TO - FROM) * u, 24
    k = round(v * (bend + 2))
    if k == 0:
        return (x, -TROUGH, TOP)
    if k == bend + 2:
        return (x, TROUGH, TOP)
    phi = math.pi * (k - 1) / bend
    return (x, -TROUGH * math.cos(phi), -TROUGH * math.sin(phi))


def main():
    quads = int(sys.argv[1]) if len(sys.argv) > 1 else 48
    along = round(quads * (TO - FROM) / PITCH)
    write("screw.stl", grid(blade, along, 4) + grid(shaft, along, 12))
    write("trough.stl", grid(trough, 6, 26))


if __name__ == "__main__":
    main()
