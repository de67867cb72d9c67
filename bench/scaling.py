#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Resident runs of LAMMPS' chute on several ranks: weak scaling (the same grains on each rank) or strong (in all).

One table on standard output (Markdown): time of a step, throughput, efficiency against the smallest number of ranks,
share of messages and of rebuilds, ghosts. Numbers of ranks are measured in turn, the median of several turns is kept.

  bench/scaling.py --device gpu --ranks 1 2 4 8 --mode weak --size 22      16 M grains on each GPU
  bench/scaling.py --device gpu --ranks 1 2 4 8 --mode strong --size 11    4 M grains in all
"""
import argparse
import os
import re
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
GRAINS = 32000  # in data.chute


def run(command, environment):
    """Seconds of the second run, its table of times, and what the log says of ghosts."""
    done = subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    loops = re.findall(r"Loop time of ([0-9.]+)", done.stdout)
    if done.returncode or len(loops) != 2:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    second = done.stdout[done.stdout.index("Loop time of"):]
    share = {name: float(re.findall(rf"^{name} .*\| *([0-9.]+) *$", second, re.M)[-1]) for name in ("Pair", "Neigh", "Comm")}
    said = re.findall(r"handed on at (\d+) of (\d+) rebuilds; ghosts of a rank at the end (\d+) to (\d+)", done.stdout)
    return float(loops[1]), share, [int(word) for word in said[-1]] if said else [0, 0, 0, 0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "build", "lmp_gpudem"))
    parser.add_argument("--mpirun", default="mpirun", help="with its own options, such as 'mpirun --bind-to none'")
    parser.add_argument("--data", default=os.path.join(HERE, "..", "build", "deps", "lammps-source", "bench", "data.chute"))
    parser.add_argument("--device", default="gpu", choices=["cpu", "gpu"])
    parser.add_argument("--precision", default="mixed", choices=["mixed", "double"])
    parser.add_argument("--threads", type=int, default=1, help="of each rank, on the CPU")
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--mode", default="weak", choices=["weak", "strong"])
    parser.add_argument("--size", type=int, default=1, help="replication of the 32 000 grains in x and in y")
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()

    environment = {"GPUDEM_DEVICE": arguments.device, "GPUDEM_PRECISION": arguments.precision,
                   "GPUDEM_THREADS": str(arguments.threads), "OMP_WAIT_POLICY": "passive"}
    root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    measured = {ranks: [] for ranks in arguments.ranks}
    for _ in range(arguments.repeat):
        for ranks in arguments.ranks:
            x = arguments.size * (ranks if arguments.mode == "weak" else 1)
            command = [*arguments.mpirun.split(), *root, "-np", str(ranks), arguments.gpudem, "-sf", "gpudem", "-in",
                       os.path.join(HERE, "in.chute"), "-log", "none", "-var", "x", str(x), "-var", "y", str(arguments.size),
                       "-var", "data", arguments.data, "-var", "steps", str(arguments.steps)]
            measured[ranks].append((x, *run(command, environment)))

    print("| ranks | grains | us per step | M grain-steps/s | efficiency | messages | rebuilds | ghosts of a rank | handed on |")
    print("|" + "---|" * 9)
    first = None
    for ranks in arguments.ranks:
        x = measured[ranks][0][0]
        step = statistics.median(seconds for _, seconds, _, _ in measured[ranks]) / arguments.steps
        spread = [seconds / arguments.steps / step for _, seconds, _, _ in measured[ranks]]
        rate = GRAINS * x * arguments.size / step
        first = first or rate / ranks
        _, _, share, (handed, rebuilds, least, most) = measured[ranks][-1]
        print(f"| {ranks} | {GRAINS * x * arguments.size} | {1e6 * step:.4g} (+-{50 * (max(spread) - min(spread)):.0f} %) | {rate / 1e6:.4g} | "
              f"{rate / ranks / first:.2f} | {share['Comm']:.1f} % | {share['Neigh']:.1f} % | {least} to {most} | "
              f"{handed} of {rebuilds} rebuilds |")


if __name__ == "__main__":
    main()
