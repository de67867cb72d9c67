#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Figures of doc/accuracy.md from accuracy.csv: plots.py CSV FOLDER."""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

STYLE = {"double": ("#2c6e9f", "-", "o"), "mixed": ("#c0392b", "--", "x")}


def series(rows, scene, quantity, precision, abscissa, skin="0.1"):
    """Pairs of abscissa and error, ordered."""
    return sorted((float(r[abscissa]), float(r["error"])) for r in rows if r["scene"] == scene and r["quantity"] == quantity
                  and r["precision"] == precision and r["skin"] == skin)


def plot(ax, rows, scene, quantity, abscissa, label="", colour=None):
    for precision, (own, line, mark) in STYLE.items():
        points = series(rows, scene, quantity, precision, abscissa)
        if points:
            ax.loglog(*zip(*points), line, marker=mark, ms=4, color=colour or own, label=f"{label or scene}, {precision}")


def draw(path, folder):
    rows = list(csv.DictReader(open(path)))
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.6))
    scenes = list(dict.fromkeys(r["scene"] for r in rows if r["quantity"] == "velocity"))
    for k, scene in enumerate(scenes):
        plot(left, rows, scene, "velocity", "steps per collision", colour=f"C{k}")
    left.set_xlabel("steps per collision time")
    left.set_ylabel("velocity error / relative speed (rms)")
    left.legend(fontsize=5.5)
    plot(right, rows, "cloud", "velocity", "seconds")
    right.set_xlabel("run time (s), 1000 grains, 4 collision times")
    right.set_ylabel("velocity error (rms)")
    right.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "accuracy_trajectories.png"), dpi=90)

    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.6))
    plot(left, rows, "elastic gas", "energy", "seconds")
    left.set_xlabel("run time (s)")
    left.set_ylabel("energy drift (relative)")
    left.legend(fontsize=7)
    for k, quantity in enumerate(("largest motion", "weight on the floor")):
        plot(right, rows, "resting bed", quantity, "steps per collision", label=quantity, colour=f"C{k}")
    right.set_xlabel("steps per collision time")
    right.set_ylabel("motion (diameters), weight (relative)")
    right.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "accuracy_drift.png"), dpi=90)


if __name__ == "__main__":
    draw(sys.argv[1], sys.argv[2])
