#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Pressure against solid fraction from the logs of in.compaction and in.continue; a picture if asked for.

    python3 curve.py log.lammps [log.continued ...] [--dump compaction.dump] [--picture compaction.png]
"""
import argparse

import numpy as np


def stroke(path):
    """Columns step, solid fraction, pressure (Pa) of all rows below 'Step Atoms v_fraction v_pressure'."""
    rows, reading = {}, False
    for line in open(path):
        words = line.split()
        if words[:4] == ["Step", "Atoms", "v_fraction", "v_pressure"]:
            reading = True
        elif reading and len(words) == 5 and words[0].isdigit():
            # the force of a setup sees a punch at rest: the row that ended the run before stands
            rows.setdefault(int(words[0]), (float(words[2]), float(words[3])))
        else:
            reading = False
    return np.array([(step, *values) for step, values in sorted(rows.items())])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("logs", nargs="+")
    parser.add_argument("--dump", help="grains to draw, seen through a slice along the axis")
    parser.add_argument("--picture")
    arguments = parser.parse_args()
    for path in arguments.logs:
        table = stroke(path)
        print(path)
        for level in (0.60, 0.65, 0.70, 0.75):
            if table[0, 1] < level < table[-1, 1]:
                print(f"  solid fraction {level:.2f}: {np.interp(level, table[:, 1], table[:, 2]):.3g} Pa")
        print(f"  end: solid fraction {table[-1, 1]:.4f}, {table[-1, 2]:.4g} Pa")
    if not arguments.picture:
        return
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 2 if arguments.dump else 1, figsize=(9 if arguments.dump else 4.6, 3.6), squeeze=False)
    for path, style in zip(arguments.logs, ("k-", "r--", "b:")):
        table = stroke(path)
        kept = table[:, 2] > 0
        axes[0, 0].semilogy(table[kept, 1], table[kept, 2], style, label=path)
    axes[0, 0].set(xlabel="solid fraction", ylabel="pressure on the punch (Pa)")
    axes[0, 0].legend(fontsize=8)
    if arguments.dump:
        grains = np.loadtxt(arguments.dump, skiprows=9)
        inside = grains[np.abs(grains[:, 3]) < grains[:, 1] / 2]   # cut by the plane y = 0
        half = np.sqrt(np.maximum((inside[:, 1] / 2) ** 2 - inside[:, 3] ** 2, 0.0))
        circles = [pyplot.Circle((x, z), r) for x, z, r in zip(inside[:, 2] * 1e3, inside[:, 4] * 1e3, half * 1e3)]
        from matplotlib.collections import PatchCollection
        drawn = PatchCollection(circles, cmap="viridis", edgecolor="none")
        drawn.set_array(inside[:, 1] * 1e3)
        axes[0, 1].add_collection(drawn)
        axes[0, 1].autoscale_view()
        axes[0, 1].set_aspect("equal")
        axes[0, 1].set(xlabel="x (mm)", ylabel="z (mm)")
        figure.colorbar(drawn, ax=axes[0, 1], label="diameter (mm)")
    figure.tight_layout()
    figure.savefig(arguments.picture, dpi=110)


if __name__ == "__main__":
    main()
