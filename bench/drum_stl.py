#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Time per step of a turning drum whose shell is made of triangles, against their number, beside LAMMPS' exact cylinder.

One table on standard output (Markdown). All programs run the same input (bench/in.drum_stl) in turn; the median is kept.
"""
import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def write_shell(path, radius, length, count):
    """A tube past both ends of the drum, of about count triangles as broad as long. Returns their number."""
    height = length + 2.0
    side = np.sqrt(2.0 * np.pi * radius * height * 2.0 / count)
    facets = max(12, round(2.0 * np.pi * radius / side))
    rings = max(1, round(count / (2.0 * facets)))
    phi = 2.0 * np.pi * np.arange(facets + 1) / facets
    x, y = radius * np.cos(phi), radius * np.sin(phi)
    x[-1], y[-1] = x[0], y[0]
    z = np.linspace(-1.0, length + 1.0, rings + 1)
    k, r = (a.ravel() for a in np.meshgrid(np.arange(facets), np.arange(rings), indexing="ij"))

    def corner(a, b):
        return np.stack([x[k + a], y[k + a], z[r + b]], -1)
    quads = [corner(*c) for c in ((0, 0), (1, 0), (1, 1), (0, 1))]
    record = np.zeros(2 * len(k), dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("spare", "<u2")])
    record["corner"][0::2] = np.stack([quads[0], quads[1], quads[2]], 1)
    record["corner"][1::2] = np.stack([quads[0], quads[2], quads[3]], 1)
    with open(path, "wb") as f:
        f.write(bytes(80) + np.uint32(len(record)).tobytes())
        record.tofile(f)
    return len(record)


def run(command, environment):
    """Seconds of the last run of the input, its grains and kinetic energy."""
    done = subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    times = re.findall(r"Loop time of ([0-9.]+) on .* with ([0-9]+) atoms", done.stdout)
    if done.returncode or len(times) != 2:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    energy = re.findall(r"^ *\d+ +\d+ +([0-9.eE+-]+)", done.stdout, re.M)[-1]
    return float(times[-1][0]), int(times[-1][1]), float(energy)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "build", "lmp_gpudem"))
    parser.add_argument("--device", default="cpu", choices=["cpu", "gpu"])
    parser.add_argument("--precision", default="mixed", choices=["mixed", "double"])
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--triangles", nargs="+", type=int, default=[1000, 100_000, 2_000_000])
    parser.add_argument("--radius", type=float, default=20.0, help="of the drum, in diameters")
    parser.add_argument("--length", type=float, default=20.0)
    parser.add_argument("--warm", type=int, default=2000)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()

    environment = {"GPUDEM_DEVICE": arguments.device, "GPUDEM_PRECISION": arguments.precision,
                   "GPUDEM_THREADS": str(arguments.threads)}
    base = [arguments.gpudem, "-sf", "gpudem", "-in", os.path.join(HERE, "in.drum_stl"), "-log", "none",
            "-var", "radius", str(arguments.radius), "-var", "length", str(arguments.length), "-var", "warm",
            str(arguments.warm), "-var", "steps", str(arguments.steps)]
    with tempfile.TemporaryDirectory() as folder:
        walls = [("exact cylinder", ["-var", "wall", "cylinder"])]
        for count in arguments.triangles:
            path = os.path.join(folder, f"{count}.stl")
            made = write_shell(path, arguments.radius, arguments.length, count)
            walls.append((f"{made} triangles", ["-var", "wall", "stl", "-var", "stl", path]))
        results = {name: [] for name, _ in walls}
        for _ in range(arguments.repeat):
            for name, words in walls:
                results[name].append(run(base + words, environment))
    print("| wall | grains | us/step | against the cylinder | kinetic energy |\n|---|---|---|---|---|")
    exact = statistics.median(r[0] for r in results["exact cylinder"])
    for name, _ in walls:
        seconds = statistics.median(r[0] for r in results[name])
        print(f"| {name} | {results[name][0][1]} | {seconds / arguments.steps * 1e6:.4g} | {seconds / exact:.3f} | "
              f"{results[name][0][2]:.6g} |", flush=True)


if __name__ == "__main__":
    main()
