#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""What each sub-model of a contact law costs, in a settled bed (bench/in.settle, bench/in.bed).

One table on standard output (Markdown): grains and steps per second, the time relative to Hertz-Mindlin, and how often the
neighbour rows were rebuilt, since a law without friction sets a bed in motion. All laws run in turn, several times; the median
is kept.
"""
import argparse
import os
import re
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
NORMAL = "hertz/material 1.0e6 0.3 0.3 damping tsuji"
MINDLIN = "tangential mindlin NULL 1.0 0.5"
ROLLING = "rolling sds 1.0e4 10.0 0.1"
LAWS = {
    "hooke, linear_history": "hooke 1.0e5 50.0 damping mass_velocity tangential linear_history 5.0e4 1.0 0.5",
    "hertz, no friction": f"{NORMAL} tangential none",
    "hertz, linear_nohistory": f"{NORMAL} tangential linear_nohistory 1.0 0.5",
    "hertz, mindlin": f"{NORMAL} {MINDLIN}",
    "+ rescale": f"{NORMAL} tangential mindlin_rescale NULL 1.0 0.5",
    "+ rolling": f"{NORMAL} {MINDLIN} {ROLLING}",
    "+ rolling + twisting": f"{NORMAL} {MINDLIN} {ROLLING} twisting marshall",
    "jkr, mindlin": f"jkr 1.0e6 0.3 0.3 1.0 damping tsuji {MINDLIN}",
    "dmt, mindlin": f"dmt 1.0e6 0.3 0.3 1.0 damping tsuji {MINDLIN}",
}
REFERENCE = "hertz, mindlin"


def seconds(command, environment):
    """Seconds, grains and rebuilds of the last run of the input."""
    done = subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    loops = re.findall(r"Loop time of ([0-9.]+) on .* with ([0-9]+) atoms", done.stdout)
    if done.returncode or len(loops) != 2:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    return float(loops[-1][0]), int(loops[-1][1]), int(re.findall(r"Neighbor list builds = (\d+)", done.stdout)[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "build", "lmp_gpudem"))
    parser.add_argument("--stock", default="", help="stock LAMMPS to put beside it")
    parser.add_argument("--ranks", type=int, default=os.cpu_count(), help="MPI ranks of stock, threads of GPUDEM's CPU")
    parser.add_argument("--data", default="data.bed", help="written by in.settle")
    parser.add_argument("--device", default="cpu", choices=["cpu", "gpu"])
    parser.add_argument("--size", type=int, default=1, help="replication in x and in y; 33: 8.1 million grains")
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--precision", nargs="+", default=["double", "mixed"], choices=["double", "mixed"])
    parser.add_argument("--laws", nargs="+", default=list(LAWS), choices=list(LAWS), metavar="LAW")
    arguments = parser.parse_args()

    root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    listed = [(f"GPUDEM {arguments.device}, {p}", [arguments.gpudem, "-sf", "gpudem"],
               {"GPUDEM_DEVICE": arguments.device, "GPUDEM_PRECISION": p, "GPUDEM_THREADS": str(arguments.ranks)})
              for p in arguments.precision]
    if arguments.stock:
        listed.insert(0, (f"stock, {arguments.ranks} ranks",
                          ["mpirun", *root, "--oversubscribe", "-np", str(arguments.ranks), arguments.stock], {}))
    taken, rebuilds, grains = {}, {}, 0
    for _ in range(arguments.repeat):
        for law in arguments.laws:
            words = LAWS[law]
            for name, prefix, environment in listed:
                if name.startswith("stock"):
                    words = words.replace("tangential none", "tangential linear_nohistory 0.0 0.0")
                time, grains, built = seconds(prefix + ["-in", os.path.join(HERE, "in.bed"), "-log", "none", "-var", "x",
                                                 str(arguments.size), "-var", "y", str(arguments.size), "-var", "data",
                                                 arguments.data, "-var", "steps", str(arguments.steps), "-var", "law",
                                                 words], environment)
                taken.setdefault((law, name), []).append(time / arguments.steps)
                rebuilds[law, name] = built
    print(f"{grains} grains, {arguments.steps} steps\n")
    print("| law | " + " | ".join(name for name, _, _ in listed) + " |")
    print("|---" * (len(listed) + 1) + "|")
    for law in arguments.laws:
        cells = []
        for name, _, _ in listed:
            step = statistics.median(taken[law, name])
            cell = f"{grains / step / 1e9:.3g} G/s"
            if (REFERENCE, name) in taken:
                cell += f", {step / statistics.median(taken[REFERENCE, name]):.2f}"
            cells.append(f"{cell}, {rebuilds[law, name]} rebuilds")
        print(f"| {law} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
