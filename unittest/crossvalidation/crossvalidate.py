#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""The same scenes in LIGGGHTS and in GPUDEM, each from one description; tables in Markdown on standard output, figures on request.

contacts: single contacts step by step, term by term, and questions about LIGGGHTS' laws.
rolling: a sphere that rolls on a plane until rolling friction has stopped it.
bulk: pile, drum, hopper and compaction, means over seeds.
"""
import argparse
import os
import statistics
import sys

import bulk
import collisions
import rolling
from programs import Programs

PROGRAMS = ("liggghts", "double", "mixed")
NAMES = {"liggghts": "LIGGGHTS", "double": "GPUDEM double", "mixed": "GPUDEM mixed"}
HERE = os.path.dirname(os.path.abspath(__file__))


def worst(differences):
    """The field that differs most, as text."""
    field = max(differences, key=differences.get)
    return f"{differences[field]:.1e} ({field})"


def contacts(programs, arguments):
    print("### Term by term\n\nLargest difference over 800 steps of one contact.\n\n| term | double | mixed |\n|---|---|---|")
    curves = {}
    for term, scene in collisions.terms():
        reference = programs.run(scene, "liggghts")
        runs = {p: programs.run(scene, p) for p in ("double", "mixed")}
        found = [worst(collisions.differences(scene, r.rows, reference.rows)) for r in runs.values()]
        print(f"| {term} | {' | '.join(found)} |", flush=True)
        curves[scene.name] = (scene, reference.rows, runs["double"].rows, runs["mixed"].rows)
    print("\n### What LIGGGHTS 3.8 does where its documentation leaves it open\n\n| question | reading | largest difference | |\n|---|---|---|---|")
    for question, readings, answer in collisions.questions():
        for reading, scene in readings.items():
            reference, ours = (programs.run(scene, p).rows for p in ("liggghts", "double"))
            print(f"| {question} | {reading} | {worst(collisions.differences(scene, ours, reference))} | "
                  f"{'this' if reading == answer else ''} |", flush=True)
            question = ""
    print("\n### A run in parts\n\nSpeed after 1200 steps in one run and in forty (m/s; 1 at first).\n\n"
          "| contact | LIGGGHTS | GPUDEM double | GPUDEM mixed |\n|---|---|---|---|")
    for rolling_too in (False, True):
        speeds = [[programs.run(collisions.in_parts(rolling_too, n), p).rows[-1][0, 3] for n in (1, 40)] for p in PROGRAMS]
        print(f"| {'rolls, epsd' if rolling_too else 'slides'} | " + " | ".join(f"{a:.6f}, {b:.6f}" for a, b in speeds) + " |", flush=True)
    if arguments.output:
        import plots
        plots.contacts(curves, arguments.output)


def rolls(programs, arguments):
    print("\n### A sphere rolling to rest on a plane\n\n| model | program | distance/closed form - 1 | speed, surface speed at the end (of v0) | "
          "largest difference of velocity, spin | seconds |\n|---|---|---|---|---|---|")
    curves = {}
    for model in rolling.MODELS:
        scene = rolling.rolls(model)
        runs = {p: programs.run(scene, p) for p in PROGRAMS}
        for program, run in runs.items():
            end = run.rows[-1, 0]
            found = collisions.differences(scene, run.rows, runs["liggghts"].rows)
            apart = "" if program == "liggghts" else f"{found['velocity']:.1e}, {found['spin']:.1e}"
            print(f"| {model} | {NAMES[program]} | {end[0] / rolling.DISTANCE - 1.0:+.1e} | {end[3] / rolling.SPEED:.0e}, "
                  f"{end[7] * rolling.RADIUS / rolling.SPEED:.0e} | {apart} | {run.seconds:.3f} |", flush=True)
        curves[model] = (scene, runs)
    if arguments.output:
        import plots
        plots.rolls(curves, arguments.output)


def in_bulk(programs, arguments):
    print(f"\n### In bulk\n\nMeans over {arguments.seeds} seeds ({3 * arguments.seeds} piles) and their standard errors; median seconds of a run.\n\n"
          "| scene | grains, steps | quantity | LIGGGHTS | GPUDEM double | GPUDEM mixed | double - LIGGGHTS (standard errors) | "
          "mixed - LIGGGHTS | seconds |\n|---|---|---|---|---|---|---|---|---|")
    found = {}
    for name, scene, values, seconds in bulk.compare(programs, PROGRAMS, arguments.seeds):
        size = f"{len(scene.x)}, {scene.steps + sum(steps for _, steps in scene.then)}"
        times = ", ".join(f"{statistics.median(seconds[p]):.1f}" for p in PROGRAMS)
        for quantity, of in values.items():
            means = " | ".join("{:.4g} +- {:.2g}".format(*bulk.mean(of[p])) for p in PROGRAMS)
            apart = " | ".join(f"{bulk.apart(of[p], of['liggghts']):+.1f}" for p in PROGRAMS[1:])
            print(f"| {name} | {size} | {quantity} | {means} | {apart} | {times} |", flush=True)
            name = size = times = ""
            found[quantity] = of
    if arguments.output:
        import plots
        plots.in_bulk(found, NAMES, arguments.output)


PARTS = {"contacts": contacts, "rolling": rolls, "bulk": in_bulk}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.environ.get("GPUDEM_LMP") or os.path.join(HERE, "..", "..", "build", "lmp_gpudem"))
    parser.add_argument("--liggghts", default=os.environ.get("LIGGGHTS") or "liggghts")
    parser.add_argument("--parts", nargs="+", default=list(PARTS), choices=list(PARTS))
    parser.add_argument("--quick", action="store_const", const=["contacts", "rolling"], dest="parts", help="contacts and rolling: half a minute")
    parser.add_argument("--seeds", type=int, default=6, help="of the scenes in bulk, at least two; a minute and a half each")
    parser.add_argument("--output", help="folder of the figures (needs matplotlib)")
    arguments = parser.parse_args()
    programs = Programs(arguments.gpudem, arguments.liggghts)
    if missing := programs.missing():
        sys.exit(missing)
    for part in arguments.parts:
        PARTS[part](programs, arguments)


if __name__ == "__main__":
    main()
