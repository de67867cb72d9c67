#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Slope of the heap in heap.dump: line through the highest grains of slices, both flanks; a picture if asked for.

    python3 angle.py [heap.dump ...] [--picture heap.png]
"""
import argparse
import math

import numpy as np

SLICE = 0.01   # metres


def grains(path):
    """Columns diameter x y z of the only snapshot."""
    lines = open(path).read().split("ITEM: ATOMS")[1].split("\n")[1:]
    return np.array([[float(w) for w in line.split()[1:]] for line in lines if line])


def flanks(table):
    """Slope in degrees of the left and the right flank, between 15 % and 85 % of the height."""
    d, x, z = table[:, 0], table[:, 1], table[:, 3]
    middle = np.median(x)
    slopes = []
    for side in (-1.0, 1.0):
        u = side * (x - middle)
        slices = (u // SLICE).astype(int)
        tops = [(np.mean(u[slices == k]), np.max(z[slices == k] + d[slices == k] / 2)) for k in range(slices.max() + 1)
                if np.count_nonzero(slices == k) > 3]
        tops = np.array(tops)
        height = tops[:, 1].max()
        use = (tops[:, 1] > 0.15 * height) & (tops[:, 1] < 0.85 * height)
        slopes.append(-math.degrees(math.atan(np.polyfit(tops[use, 0], tops[use, 1], 1)[0])))
    return slopes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dumps", nargs="*", default=["heap.dump"])
    parser.add_argument("--picture")
    arguments = parser.parse_args()
    all_slopes = []
    for path in arguments.dumps:
        slopes = flanks(grains(path))
        all_slopes += slopes
        print(f"{path}: {slopes[0]:.1f} and {slopes[1]:.1f} degrees")
    error = np.std(all_slopes, ddof=1) / math.sqrt(len(all_slopes)) if len(all_slopes) > 2 else float("nan")
    print(f"angle of repose {np.mean(all_slopes):.1f} +- {error:.1f} degrees ({len(all_slopes)} flanks)")
    if arguments.picture:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
        figure, axes = pyplot.subplots(len(arguments.dumps), 1, figsize=(8, 2.4 * len(arguments.dumps)), squeeze=False)
        for ax, path in zip(axes[:, 0], arguments.dumps):
            table = grains(path)
            ax.scatter(table[:, 1], table[:, 3], s=6, c=table[:, 2], cmap="viridis", linewidths=0)
            ax.set_aspect("equal")
            ax.set(xlabel="x (m)", ylabel="z (m)", title=f"{path}: {np.mean(flanks(table)):.1f} degrees")
        figure.tight_layout()
        figure.savefig(arguments.picture, dpi=110)


if __name__ == "__main__":
    main()
