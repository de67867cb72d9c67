#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Particle-steps per second of the LAMMPS chute benchmark for a ladder of sizes, GPUDEM beside stock LAMMPS.

One table on standard output (Markdown). Every program runs the same input; the median of several runs is kept,
in turn, so that a drift of the machine's speed meets all of them.
"""
import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
GRAINS = 32000  # in data.chute


def loop_time(command, environment):
    """Seconds of the last run of the input, and its kinetic energy."""
    done = subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    times = re.findall(r"Loop time of ([0-9.]+)", done.stdout)
    if done.returncode or len(times) != 2:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    energy = re.findall(r"^ *\d+ +\d+ +([0-9.eE+-]+)", done.stdout, re.M)[-1]
    return float(times[-1]), float(energy)


def programs(arguments):
    """(name, command prefix, environment) of everything that is to be compared."""
    root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    listed = []
    if arguments.stock and shutil.which(arguments.stock):
        listed.append((f"stock, {arguments.ranks} ranks",
                       ["mpirun", *root, "--oversubscribe", "-np", str(arguments.ranks), arguments.stock], {}))
    for device in arguments.devices:
        for precision in ("double", "mixed"):
            listed.append((f"GPUDEM {device}, {precision}", [arguments.gpudem, "-sf", "gpudem"],
                           {"GPUDEM_DEVICE": device, "GPUDEM_PRECISION": precision,
                            "GPUDEM_THREADS": str(arguments.ranks)}))
    return listed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "build", "lmp_gpudem"))
    parser.add_argument("--stock", default="lmp", help="stock LAMMPS; empty to leave it out")
    parser.add_argument("--ranks", type=int, default=os.cpu_count(), help="MPI ranks of stock, threads of GPUDEM's CPU")
    parser.add_argument("--data", default=os.path.join(HERE, "..", "build", "deps", "lammps-source", "bench", "data.chute"))
    parser.add_argument("--devices", nargs="+", default=["cpu"], choices=["cpu", "gpu"])
    parser.add_argument("--sizes", nargs="+", type=int, default=[1, 2, 4], help="replication in x and in y")
    parser.add_argument("--steps", type=int, default=0, help="steps per run, default by size")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--cpu-limit", type=int, default=8, help="largest replication for stock and the CPU backend")
    arguments = parser.parse_args()

    listed = programs(arguments)
    print("| grains | " + " | ".join(name for name, _, _ in listed) + " |")
    print("|---" * (len(listed) + 1) + "|")
    for size in arguments.sizes:
        grains = GRAINS * size * size
        steps = arguments.steps or max(200, min(2000, 400_000_000 // grains // 100 * 100))
        seconds = {name: [] for name, _, _ in listed}
        energies = {}
        for _ in range(arguments.repeat):
            for name, prefix, environment in listed:
                on_cpu = "gpu," not in name
                if on_cpu and size > arguments.cpu_limit:
                    continue
                count = min(steps, 200) if on_cpu and grains > 200_000 else steps
                command = prefix + ["-in", os.path.join(HERE, "in.chute"), "-log", "none", "-var", "x", str(size), "-var",
                                    "y", str(size), "-var", "data", arguments.data, "-var", "steps", str(count)]
                time, energy = loop_time(command, environment)
                seconds[name].append(time / count)
                energies.setdefault(count, []).append(energy)
        for values in energies.values():
            # thousands of steps decorrelate single grains; the bulk must agree
            if max(values) - min(values) > 1e-4 * abs(values[0]):
                sys.exit(f"the programs disagree about the kinetic energy: {values}")
        cells = []
        for name, _, _ in listed:
            if not seconds[name]:
                cells.append("-")
                continue
            step = statistics.median(seconds[name])
            spread = (max(seconds[name]) - min(seconds[name])) / step
            cells.append(f"{grains / step / 1e9:.4g} G/s ({step * 1e6:.4g} us/step, +-{50 * spread:.0f} %)")
        print(f"| {grains} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
