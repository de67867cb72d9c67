#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""hopper.stl: a cone of radius 2.5 at z = 0 to 6 at z = 5, and a tube from there to z = 25, open at both ends.

    python3 surface.py [facets of the circumference, 128]
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from surfaces import revolved, write  # noqa: E402


def main():
    facets = int(sys.argv[1]) if len(sys.argv) > 1 else 128
    write("hopper.stl", revolved([(2.5, 0.0), (6.0, 5.0), (6.0, 15.0), (6.0, 25.0)], facets))


if __name__ == "__main__":
    main()
