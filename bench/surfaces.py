#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""What walls of triangles cost: a turning drum with lifters, a screw conveyor and a spiral slide, full of grains.

One table on standard output (Markdown), and its rows as CSV. The drum stands beside an exact cylinder and beside a region of its
shape, lifters included; screw and slide, which have no exact shape, beside a box with the same number of grains, as deep, under the
same law. All scenes begin on a lattice, settle for a while and are then measured in three runs; walls take turns. Ratios are of
medians; in brackets the smallest and the largest of two runs, one of each wall.

  bench/surfaces.py --device gpu --grains 4000000                   all scenes
  bench/surfaces.py --scenes drum --bare --triangles 1000 100000    a drum without lifters, whose exact shape is the cylinder
"""
import argparse
import csv
import os
import sys
import tempfile
import time
from dataclasses import dataclass, field

import runs
from surface_scenes import Box, Drum, Screw, Slide, write_data

NAMES = ["scene", "wall", "grains", "triangles", "us_per_step", "ratio", "ratio_low", "ratio_high", "ratio_exact", "contacts",
         "rebuilds", "bytes_per_grain", "energy", "samples"]


@dataclass
class Wall:
    scene: str
    name: str
    words: list
    plain: object = None   # the wall to compare with, None for itself
    exact: object = None   # the wall of the same shape without triangles, if there is one
    triangles: int = 0
    steps: list = field(default_factory=list)  # s per step of every run
    last: object = None    # the last run
    bytes: float = 0.0


def written(folder, name, scene):
    path = os.path.join(folder, f"data.{name}")
    write_data(path, scene.position, scene.lo, scene.hi)
    return ["-var", "data", path]


def drum(arguments, folder):
    scene = Drum(arguments.grains, not arguments.bare)
    words = ["-in", os.path.join(runs.HERE, "in.drum"), *written(folder, "drum", scene), "-var", "radius", f"{scene.radius:.9g}",
             "-var", "length", f"{scene.length:.9g}"]
    plain = Wall("drum", "cylinder", [*words, "-var", "wall", "cylinder"])
    walls, exact = [plain], plain
    if not arguments.bare:
        exact = Wall("drum", "cylinder and bars, region", [*words, "-var", "wall", "lifters"], plain)
        walls.append(exact)
    for count in arguments.triangles:
        stl = os.path.join(folder, f"drum{count}.stl")
        made = scene.write(stl, count)
        walls.append(Wall("drum", "triangles", [*words, "-var", "wall", "surface", "-var", "stl", stl], plain, exact, made))
    return walls


def box(folder, name, scene):
    words = ["-in", os.path.join(runs.HERE, "in.box"), *written(folder, f"{name}.box", Box(len(scene.position), scene.depth))]
    return Wall(name, "box", words)


def screw(arguments, folder):
    scene = Screw(arguments.grains)
    paths = [os.path.join(folder, f"{part}.stl") for part in ("screw", "trough")]
    made = scene.write(*paths)
    words = ["-in", os.path.join(runs.HERE, "in.screw"), *written(folder, "screw", scene), "-var", "scale", f"{scene.scale:.9g}",
             "-var", "screw", paths[0], "-var", "trough", paths[1]]
    plain = box(folder, "screw", scene)
    return [plain, Wall("screw", "triangles", words, plain, None, made)]


def slide(arguments, folder):
    scene = Slide(arguments.grains)
    stl = os.path.join(folder, "slide.stl")
    made = scene.write(stl)
    words = ["-in", os.path.join(runs.HERE, "in.slide"), *written(folder, "slide", scene), "-var", "scale", f"{scene.scale:.9g}",
             "-var", "stl", stl]
    plain = box(folder, "slide", scene)
    return [plain, Wall("slide", "triangles", words, plain, None, made)]


SCENES = {"drum": drum, "screw": screw, "slide": slide}


def measure(arguments, wall, folder):
    log = runs.start(arguments, wall.words + ["-var", "settle", arguments.settle, "-var", "steps", arguments.steps], folder)
    loops = log.loops[1:]  # the first settles
    if len(loops) != 3 or loops[-1].grains != arguments.grains:
        sys.exit(f"{wall.scene}, {wall.name}: {len(loops)} runs, {loops[-1].grains if loops else 0} of {arguments.grains} grains:\n"
                 f"{log.text[-2000:]}")
    begun = sum(value for name, value in log.loops[0].first.items() if name.startswith("f_"))
    if begun:
        sys.exit(f"{wall.scene}, {wall.name}: {begun:.0f} contacts with triangles at the start; the grains were to be clear of them")
    wall.steps += [loop.per_step for loop in loops]
    wall.last, wall.bytes = loops[-1], log.bytes_per_grain
    return log.device


def row(wall):
    c = runs.compare((wall.plain or wall).steps, wall.steps)
    contacts = [value for name, value in wall.last.last.items() if name.startswith("f_")]
    return {"scene": wall.scene, "wall": wall.name, "grains": wall.last.grains, "triangles": wall.triangles or "",
            "us_per_step": f"{1e6 * c.second:.4g}", "ratio": f"{c.ratio:.3f}" if wall.plain else "",
            "ratio_low": f"{c.low:.3f}" if wall.plain else "", "ratio_high": f"{c.high:.3f}" if wall.plain else "",
            "ratio_exact": f"{runs.compare(wall.exact.steps, wall.steps).ratio:.3f}" if wall.exact else "",
            "contacts": f"{sum(contacts):.0f}" if contacts else "", "rebuilds": wall.last.rebuilds,
            "bytes_per_grain": f"{wall.bytes:.0f}", "energy": f"{wall.last.last['KinEng']:.6g}", "samples": len(wall.steps)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    runs.add_program(parser)
    parser.add_argument("--scenes", nargs="+", default=list(SCENES), choices=list(SCENES))
    parser.add_argument("--grains", type=int, default=0, help="default a million on a GPU, else 20 000")
    parser.add_argument("--triangles", nargs="+", type=int, default=[1000, 100_000, 2_000_000], help="of the drum's shell")
    parser.add_argument("--bare", action="store_true", help="a drum without lifters")
    parser.add_argument("--settle", type=int, default=6000)
    parser.add_argument("--steps", type=int, default=500, help="of each of the three measured runs of a process")
    parser.add_argument("--turns", type=int, default=3, help="at most so many processes for each wall")
    parser.add_argument("--budget", type=float, default=110.0, help="no process begins that would end later (s)")
    arguments = parser.parse_args()
    arguments.grains = arguments.grains or (1_000_000 if arguments.device == "gpu" else 20_000)
    began, device, longest = time.monotonic(), "", 0.0

    with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
        walls = [wall for name in arguments.scenes for wall in SCENES[name](arguments, folder)]
        made = time.monotonic() - began
        for _ in range(arguments.turns):
            for wall in walls:
                start = time.monotonic()
                if start - began + longest > arguments.budget:
                    break
                device = measure(arguments, wall, folder)
                longest = max(longest, time.monotonic() - start)
    missed = [f"{wall.scene}, {wall.name} {wall.triangles or ''}".strip() for wall in walls if not wall.steps]
    rows = [row(wall) for wall in walls if wall.steps]

    print(f"{device}, {arguments.precision}; {arguments.steps} steps after {arguments.settle}, three runs of a process; scenes made in "
          f"{made:.0f} s, {time.monotonic() - began:.0f} s in all. Contacts and rebuilds are those of the last run.\n")
    runs.markdown(["scene", "wall", "grains", "triangles", "us/step", "ratio to cylinder or box", "ratio to the exact shape",
                   "contacts with triangles", "rebuilds", "bytes per grain", "kinetic energy"],
                  [(r["scene"], r["wall"], r["grains"], r["triangles"], r["us_per_step"],
                    r["ratio"] and f"{r['ratio']} ({r['ratio_low']} to {r['ratio_high']})", r["ratio_exact"], r["contacts"],
                    r["rebuilds"], r["bytes_per_grain"], r["energy"]) for r in rows])
    for name in missed:
        print(f"not reached within {arguments.budget:g} s: {name}")
    if arguments.csv:
        with open(arguments.csv, "w", newline="") as f:
            table = csv.DictWriter(f, NAMES)
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    main()
