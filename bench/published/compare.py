#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Logs of in.impact and in.silo against the reference curves: one table (Markdown) on standard output, one figure.

  compare.py PUBLISHED [--figure FILE.png] NAME=LOG ...     NAME: impact_50k, impact_100k or silo_large_M1

PUBLISHED holds the curves impact_50k_ball_z.csv, impact_100k_ball_z.csv and silo_large_M1_remaining.csv.
"""
import argparse
import os
import re
import sys

import numpy

START = 0.06  # m, height of the ball at time 0
CURVES = {"impact_50k": "impact_50k_ball_z.csv", "impact_100k": "impact_100k_ball_z.csv", "silo_large_M1": "silo_large_M1_remaining.csv"}


def reference(path):
    """Times (s) and {code: values} of a published curve."""
    table = numpy.genfromtxt(path, delimiter=",", names=True)
    first, *names = table.dtype.names
    return table[first], {re.sub("^(z_m|N)_", "", name): table[name] for name in names}


def logged(path, column):
    """Times (s) and values of a column of thermo output, all runs of a log joined."""
    times, values, head = [], [], None
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["Step"]:
                head = words
            elif line.startswith("Loop time"):
                head = None
            elif head and len(words) == len(head) and re.fullmatch(r"\d+", words[0]):
                time = float(words[1])
                if not times or time > times[-1] + 1e-12:
                    times.append(time)
                    values.append(float(words[head.index(column)]))
    return numpy.array(times), numpy.array(values)


def seconds(path):
    """Run time of all runs of a log, and nanoseconds per grain and step."""
    with open(path) as file:
        loops = re.findall(r"^Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", file.read(), re.M)
    work = sum(int(steps) * int(grains) for _, steps, grains in loops)
    total = sum(float(loop) for loop, _, _ in loops)
    return total, 1e9 * total / work if work else float("nan")


def at(times, values, t):
    """Linear interpolation, NaN beyond the data."""
    return float(numpy.interp(t, times, values)) if times[0] <= t <= times[-1] + 1e-9 else float("nan")


def impact_row(times, z):
    """Quantities of a ball: smallest displacement and its time, displacements at three times (m)."""
    fallen = z - START
    lowest = int(numpy.argmin(fallen))
    reached = lowest < len(times) - 1  # else the run is too short to show it
    return {"minimum": fallen[lowest] if reached else float("nan"), "t_min": times[lowest] if reached else float("nan"),
            **{f"t={t}": at(times, fallen, t) for t in (0.02, 0.05, 0.1)}}


def silo_row(times, n):
    """Rate (1/s), fitted from 0.5 to 3.5 s, or to the end of a shorter run, and grains that remain."""
    part = (times >= 0.5) & (times <= 3.5)
    rate = -numpy.polyfit(times[part], n[part], 1)[0] if part.sum() > 1 else float("nan")
    return {"rate 0.5-3.5 s": rate, **{f"t={t}": at(times, n, t) for t in (0.5, 1.0, 2.0, 3.0, 4.0)}}


def differences(own, other):
    """Largest difference of two curves where both exist, and the time of it."""
    times, values = other
    part = (times >= own[0][0] - 1e-9) & (times <= own[0][-1] + 1e-9)
    delta = numpy.interp(times[part], *own) - values[part]
    worst = int(numpy.argmax(abs(delta)))
    return delta[worst], times[part][worst]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("published")
    parser.add_argument("logs", nargs="+", metavar="NAME=LOG")
    parser.add_argument("--figure")
    arguments = parser.parse_args()
    panels = []
    for word in arguments.logs:
        name, _, path = word.partition("=")
        if name not in CURVES or not path:
            sys.exit(f"{word}: NAME=LOG is expected, NAME one of {', '.join(CURVES)}")
        ball = name.startswith("impact")
        times, codes = reference(os.path.join(arguments.published, CURVES[name]))
        own = logged(path, "v_z" if ball else "v_above")
        curves = {"GPUDEM": own, **{code: (times, values) for code, values in codes.items()}}
        rows = {code: (impact_row if ball else silo_row)(*curve) for code, curve in curves.items()}
        total, each = seconds(path)
        print(f"{name}: {own[0][-1]:g} s simulated in {total:.4g} s, {each:.4g} ns per grain and step\n")
        print(f"| {name} | {' | '.join(rows['GPUDEM'])} | GPUDEM differs most by, at |\n|{'---|' * (len(rows['GPUDEM']) + 2)}")
        for code, row in rows.items():
            worst = "" if code == "GPUDEM" else "{:.3g}, {:.3g} s".format(*differences(own, curves[code]))
            print(f"| {code} | {' | '.join('-' if numpy.isnan(v) else f'{v:.5g}' for v in row.values())} | {worst} |")
        print()
        panels.append((name, ball, curves))
    if arguments.figure:
        draw(panels, arguments.figure)


def draw(panels, path):
    """A panel for each log."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, len(panels), figsize=(4.5 * len(panels), 3.6), squeeze=False)
    for ax, (name, ball, curves) in zip(axes[0], panels):
        for code, (times, values) in curves.items():
            own = code == "GPUDEM"
            ax.plot(times, values - START if ball else values, "-" if own else "--", lw=2.0 if own else 1.0, label=code, zorder=3 if own else 2)
        ax.set_title(name, fontsize=9)
        ax.set_xlabel("time (s)")
        ax.set_ylabel("displacement of the ball (m)" if ball else "grains above the lip")
        ax.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


if __name__ == "__main__":
    main()
