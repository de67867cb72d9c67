#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""What each feature costs, and that what is not used costs nothing: pairs of scripts (feature_pairs.py), run in turn.

Two tables on standard output (Markdown), and their rows as CSV. Ratios are medians of the script with the feature over medians
of the one without; in brackets the smallest and the largest of two runs one after the other. Where both scripts move the grains
alike, their kinetic energies are compared. Scenes: copies of LAMMPS' chute (bench/in.chute) and of a settled bed (bench/in.settle,
bench/in.bed).

  bench/features.py --device gpu --budget 220          500 000 grains, as many turns as fit into 220 s
  bench/features.py --only wall idle --turns 2         walls, and all pairs of the second table
"""
import argparse
import csv
import os
import sys
import tempfile
import time

import runs
from feature_pairs import FEATURES, IDLE

HERE = runs.HERE
BEDS = {"bed": ("data.bed", []),
        "bed, one size": ("data.one", ["-var", "small", 1.0, "-var", "large", 1.0]),
        "bed, sizes 1 to 1.5": ("data.spread", ["-var", "small", 0.8, "-var", "large", 1.2, "-var", "spacing", 1.22])}
NAMES = ["table", "feature", "scene", "grains", "without", "with", "us_without", "us_with", "ratio", "ratio_low", "ratio_high",
         "bytes_without", "bytes_with", "rebuilds_without", "rebuilds_with", "energy_without", "energy_with", "samples"]


def script(scene, edits, loops=1):
    """The text of a scene's input with its edits, and so many measured runs."""
    name = "in.chute" if scene == "chute" else "in.bed"
    with open(os.path.join(HERE, name)) as f:
        text = f.read()
    for line, instead in edits:
        if text.count(line) != 1:
            sys.exit(f"{name} has {text.count(line)} lines '{line}'; an edit needs one")
        text = text.replace(line, instead)
    return text + "run             ${steps}\n" * (loops - 1)


def words(arguments, scene, folder):
    data = arguments.data if scene == "chute" else os.path.join(folder, BEDS[scene][0])
    size = arguments.chute if scene == "chute" else arguments.bed
    return ["-var", "data", os.path.abspath(data), "-var", "x", size, "-var", "y", size, "-var", "warm", arguments.warm,
            "-var", "steps", arguments.steps]


def settle(arguments, scene, folder):
    """Write the data file of a bed."""
    name, sizes = BEDS[scene]
    runs.start(arguments, ["-in", os.path.join(HERE, "in.settle"), "-var", "n", 16, "-var", "out", name, "-var", "steps",
                           arguments.settle, *sizes], folder)


class Series:
    """What was measured of one script."""

    def __init__(self, arguments, scene, edits, folder, name):
        self.arguments, self.folder = arguments, folder
        self.path = os.path.join(folder, f"in.{name}")
        with open(self.path, "w") as f:
            f.write(script(scene, edits, arguments.runs))
        self.words = ["-in", self.path, *words(arguments, scene, folder)]
        self.steps, self.bytes, self.rebuilds, self.energy, self.grains = [], 0.0, 0, 0.0, 0

    def measure(self):
        log = runs.start(self.arguments, self.words, self.folder)
        loops = log.loops[1:]  # the first warms up
        if len(loops) != self.arguments.runs:
            sys.exit(f"{self.path} ended after {len(loops)} measured runs:\n{log.text[-2000:]}")
        self.steps += [loop.per_step / loop.grains * 1e6 for loop in loops]  # us per step and grain
        self.bytes, self.grains = log.bytes_per_grain, loops[-1].grains
        self.rebuilds = sum(loop.rebuilds for loop in loops)
        self.energy = loops[-1].last["KinEng"]
        dumped = os.path.join(self.folder, "grains.bin")
        if os.path.exists(dumped):
            os.remove(dumped)
        return log.device


def energies(pair, a, b):
    """'same' to the last digit, or the difference relative to the energy; nothing where the motions differ."""
    if not pair.alike:
        return ""
    if a.energy == b.energy:
        return "same"
    return f"{abs(a.energy - b.energy) / max(abs(a.energy), abs(b.energy)):.0e} off"


def row(pair, a, b):
    c = runs.compare(a.steps, b.steps)
    return {"feature": pair.feature, "scene": pair.scene, "grains": a.grains, "without": pair.without, "with": pair.with_,
            "us_without": f"{c.first * a.grains:.5g}", "us_with": f"{c.second * b.grains:.5g}", "ratio": f"{c.ratio:.4f}",
            "ratio_low": f"{c.low:.4f}", "ratio_high": f"{c.high:.4f}", "bytes_without": a.bytes, "bytes_with": b.bytes,
            "rebuilds_without": a.rebuilds, "rebuilds_with": b.rebuilds, "energy_without": a.energy, "energy_with": b.energy,
            "samples": len(a.steps)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    runs.add_program(parser)
    parser.add_argument("--data", default=os.path.join(HERE, "..", "build", "deps", "lammps-source", "bench", "data.chute"))
    parser.add_argument("--chute", type=int, default=0, help="copies in x and y of 32 000 grains; default 4 on a GPU, else 1")
    parser.add_argument("--bed", type=int, default=0, help="copies in x and y of 7000 grains; default 8 on a GPU, else 1")
    parser.add_argument("--settle", type=int, default=60000, help="steps in which a bed settles")
    parser.add_argument("--warm", type=int, default=200)
    parser.add_argument("--steps", type=int, default=0, help="of each measured run; default 1000 on a GPU, else 100")
    parser.add_argument("--runs", type=int, default=5, help="measured in one process")
    parser.add_argument("--turns", type=int, default=5, help="at most so many processes of each script")
    parser.add_argument("--budget", type=float, default=220.0, help="no pair begins that would end later (s)")
    parser.add_argument("--only", nargs="+", default=[], metavar="WORD", help="pairs with one of these in table, name or scene")
    arguments = parser.parse_args()
    arguments.chute = arguments.chute or (4 if arguments.device == "gpu" else 1)
    arguments.bed = arguments.bed or (8 if arguments.device == "gpu" else 1)
    arguments.steps = arguments.steps or (1000 if arguments.device == "gpu" else 100)
    began = time.monotonic()

    listed = [(table, pair) for table, pairs in (("features", FEATURES), ("idle", IDLE)) for pair in pairs
              if not arguments.only or any(word in f"{table} {pair.feature} {pair.scene}" for word in arguments.only)]
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
        scenes = {scene for _, pair in listed for scene in (pair.scene, pair.other) if scene in BEDS}
        for scene in sorted(scenes):
            settle(arguments, scene, folder)
        measured = []
        for k, (table, pair) in enumerate(listed):
            measured.append((table, pair, Series(arguments, pair.scene, pair.absent, folder, f"{k}.without"),
                             Series(arguments, pair.other or pair.scene, pair.present, folder, f"{k}.with")))
        device, longest = "", 0.0
        for _ in range(arguments.turns):
            for _, _, without, with_ in measured:
                start = time.monotonic()
                if start - began + longest > arguments.budget:
                    break
                without.measure()
                device = with_.measure()
                longest = max(longest, time.monotonic() - start)
    if not measured or not measured[0][3].steps:
        sys.exit("nothing was measured: no pair has one of the words of --only, or the budget is too short")
    if not measured[-1][3].steps:
        print(f"{sum(not m[3].steps for m in measured)} pairs were not reached within {arguments.budget:g} s\n")
        measured = [m for m in measured if m[3].steps]
    rows = [{"table": table, **row(pair, a, b)} for table, pair, a, b in measured]
    samples = sorted({len(m[3].steps) for m in measured})
    print(f"{device}, {arguments.precision}; {' or '.join(map(str, samples))} runs of {arguments.steps} steps of each script, "
          f"{time.monotonic() - began:.0f} s in all. Rebuilds are those of the last process.\n")
    for table, title in (("features", "Absent and present"), ("idle", "Absent and present with nothing to do")):
        chosen = [(r, energies(pair, a, b)) for r, (t, pair, a, b) in zip(rows, measured) if t == table]
        if not chosen:
            continue
        print(f"**{title}**\n")
        runs.markdown(["feature", "scene", "grains", "without", "with", "us/step", "ratio", "bytes per grain", "rebuilds", "energy"],
                      [(r["feature"], r["scene"], r["grains"], r["without"], r["with"], f"{r['us_without']}, {r['us_with']}",
                        f"{float(r['ratio']):.3f} ({float(r['ratio_low']):.3f} to {float(r['ratio_high']):.3f})",
                        f"{r['bytes_without']:.0f}, {r['bytes_with']:.0f}", f"{r['rebuilds_without']}, {r['rebuilds_with']}",
                        energy) for r, energy in chosen])
    print("Where no energy is given the grains move otherwise, so that contacts and rebuilds differ too. Spins are always integrated "
          "(fix nve/sphere); torques come with friction.\n"
          "On one rank there are no ghosts: no list of them, no message and no memory.")
    if arguments.csv:
        with open(arguments.csv, "w", newline="") as f:
            table = csv.DictWriter(f, NAMES)
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    main()
