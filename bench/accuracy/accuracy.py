#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Error against run time: one CSV (accuracy.csv), from which plots.py draws the figures of doc/accuracy.md.

Single collisions and 10^3 grains against a reference in extended precision at 1/64 of the smallest step, the energy of an elastic
gas, a bed at rest; double and mixed, time steps of 1/5 to 1/200 of a collision, skins. A few minutes; --long
follows gas and bed for 10^6 steps.
"""
import argparse
import csv
import os
import sys

import plots
from measure import Programs, energy_drift, rest, root_mean_square, settle, trajectory
from scenes import bed, cloud, gas, single_collisions

HERE = os.path.dirname(os.path.abspath(__file__))
STEPS = (5, 10, 20, 50, 100, 200)   # per collision time
FINER = 64
SKINS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5)
COLUMNS = ("scene", "precision", "steps per collision", "skin", "quantity", "error", "seconds", "steps", "grains", "note")


class Table:
    """Rows of the CSV; each is also printed."""

    def __init__(self):
        self.rows = []

    def add(self, scene, precision, per_collision, errors, seconds, steps):
        for quantity, error in errors.items():
            self.rows.append(dict(zip(COLUMNS, (scene.name, precision, per_collision, scene.skin, quantity, f"{error:.4g}",
                                                f"{seconds:.4g}", steps, len(scene.x), scene.note))))
        shown = ", ".join(f"{quantity} {error:.2e}" for quantity, error in errors.items())
        print(f"{scene.name:16s} {precision:9s} 1/{per_collision:<5d} skin {scene.skin:<5g} {shown}; {seconds:.3g} s", flush=True)

    def write(self, path):
        with open(path, "w", newline="") as out:
            writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(self.rows)


def trajectories(programs, table, arguments):
    for scene in [*single_collisions(), cloud()]:
        finest = FINER * max(STEPS)
        exact = programs.exact(scene, finest)
        coarser = programs.exact(scene, finest // 4)
        own = {"position": root_mean_square((coarser - exact)[:, :3]), "velocity": root_mean_square((coarser - exact)[:, 3:6])}
        table.add(scene, "reference", finest // 4, own, 0.0, scene.duration * finest // 4)   # what a four times larger step changes
        for precision in arguments.precision:
            for n in STEPS:
                table.add(scene, precision, n, *trajectory(programs, scene, precision, n, exact, programs.repeat))
        if scene.name == "cloud":
            for precision in arguments.precision:
                for scene.skin in SKINS:
                    table.add(scene, precision, 50, *trajectory(programs, scene, precision, 50, exact, programs.repeat))


def gases(programs, table, arguments):
    for precision in arguments.precision:
        for n in STEPS:
            steps = arguments.steps if arguments.steps else 1000 * n
            scene = gas(1000)
            errors, seconds = energy_drift(programs, scene, precision, n, steps)
            table.add(scene, precision, n, {"energy": errors["energy"], "energy per collision time": errors["energy"] * n / steps},
                      seconds, steps)
        for skin in SKINS:   # for the time: larger, so that rows and rebuilds count
            scene = gas(100, side=20)
            scene.skin, scene.name, scene.note = skin, "elastic gas, skins", "8 x 10^3 grains"
            errors, seconds = energy_drift(programs, scene, precision, 50, 5000)
            table.add(scene, precision, 50, errors, seconds, 5000)


def beds(programs, table, arguments):
    scene = bed()
    restart = settle(programs, scene)
    for precision in arguments.precision:
        for n in STEPS:
            steps = arguments.steps if arguments.steps else 20000
            table.add(scene, precision, n, *rest(programs, scene, restart, precision, n, steps), steps)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "..", "build", "lmp_gpudem"))
    parser.add_argument("--reference", default=os.path.join(HERE, "..", "..", "build", "accuracy-reference"))
    parser.add_argument("--device", default="cpu", choices=["cpu", "gpu"])
    parser.add_argument("--threads", type=int, default=1, help="of the CPU backend")
    parser.add_argument("--precision", nargs="+", default=["double", "mixed"], choices=["double", "mixed"])
    parser.add_argument("--repeat", type=int, default=3, help="runs of each trajectory; the median time is kept")
    parser.add_argument("--long", dest="steps", action="store_const", const=1000000, help="10^6 steps of gas and bed")
    parser.add_argument("--scenes", nargs="+", default=["trajectories", "gas", "bed"], choices=["trajectories", "gas", "bed"])
    parser.add_argument("--output", default=".", help="folder of accuracy.csv and of the figures")
    arguments = parser.parse_args()
    for program in (arguments.gpudem, arguments.reference):
        if not os.path.exists(program):
            sys.exit(f"{program} is missing: build with scripts/build, or name it")

    programs = Programs(arguments.gpudem, arguments.reference, arguments.device, arguments.threads, arguments.repeat)
    table = Table()
    for name, measure in (("trajectories", trajectories), ("gas", gases), ("bed", beds)):
        if name in arguments.scenes:
            measure(programs, table, arguments)
    path = os.path.join(arguments.output, "accuracy.csv")
    table.write(path)
    if len(arguments.scenes) == 3:
        plots.draw(path, arguments.output)


if __name__ == "__main__":
    main()
