#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Time per step and per rebuild of settled mixtures of two sizes, against the size ratio and the number of levels.

Large and small grains have half of the volume each (one size at ratio 1); the small ones have a radius of 1 mm. One table on
standard output (Markdown). All programs run the same input (bench/in.sizes) in turn.
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
SMALL = 1.0e-3  # radius (m)
DENSITY = 2500.0
STIR = 0.2  # largest component of a velocity (m/s)


def mixture(ratio, grains, seed=1):
    """Positions, radii and box of a loose mixture: large grains on a lattice, small ones on a finer one between them."""
    random = np.random.default_rng(seed)
    large = ratio * SMALL
    per_large = ratio ** 3 if ratio > 1 else 0
    cells = max(1.0, grains / (1 + per_large))  # large grains
    side = max(1, int(round((cells / 2.0) ** (1.0 / 3.0))))
    layers = max(1, int(round(cells / side ** 2)))
    pitch = 2.0 * large * (1.10 if ratio == 1 else 1.30)
    box = np.array([side * pitch, side * pitch, layers * pitch])
    # the interaction range must fit twice into a periodic box
    if side < 3 and ratio > 1:
        side = 3
        box[:2] = side * pitch
        layers = max(1, int(round(cells / 9)))
        box[2] = layers * pitch
    axes = [(np.arange(n) + 0.5) * pitch for n in (side, side, layers)]
    centres = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    if ratio == 1:
        return centres + random.uniform(-0.04, 0.04, centres.shape) * large, np.full(len(centres), large), box
    fine = 2.08 * SMALL
    count = np.maximum(1, np.floor(box / fine).astype(int))
    free = np.ones(count, bool)
    step = box / count
    reach = large + SMALL
    for centre in centres:
        lo = np.floor((centre - reach) / step - 0.5).astype(int)
        hi = np.ceil((centre + reach) / step + 0.5).astype(int)
        index = [np.arange(a, b + 1) for a, b in zip(lo, hi)]
        away = [(i + 0.5) * s - c for i, s, c in zip(index, step, centre)]
        near = (away[0] ** 2)[:, None, None] + (away[1] ** 2)[None, :, None] + (away[2] ** 2)[None, None, :] < reach ** 2
        keep = [(0 <= i) & (i < n) if d == 2 else np.ones(len(i), bool) for d, (i, n) in enumerate(zip(index, count))]
        where = np.ix_(*[i[k] % n for i, k, n in zip(index, keep, count)])
        free[where] &= ~near[np.ix_(*keep)]
    places = np.argwhere(free)
    wanted = min(len(places), per_large * len(centres))
    places = places[np.sort(random.choice(len(places), wanted, replace=False))]
    small = (places + 0.5) * step
    return (np.concatenate([centres, small]), np.concatenate([np.full(len(centres), large), np.full(wanted, SMALL)]), box)


def write(path, position, radius, box):
    with open(path, "w") as out:
        out.write(f"mixture\n\n{len(radius)} atoms\n1 atom types\n\n0 {box[0]:.17g} xlo xhi\n0 {box[1]:.17g} ylo yhi\n"
                  f"0 {1.05 * box[2]:.17g} zlo zhi\n\nAtoms # sphere\n\n")
        for n, (x, r) in enumerate(zip(position, radius), 1):
            out.write(f"{n} 1 {2 * r:.9g} {DENSITY} {x[0]:.9g} {x[1]:.9g} {x[2]:.9g}\n")
        out.write("\nVelocities\n\n")  # stirred, or there would be no rebuilds to measure
        for n, v in enumerate(np.random.default_rng(2).uniform(-STIR, STIR, (len(radius), 3)), 1):
            out.write(f"{n} {v[0]:.6g} {v[1]:.6g} {v[2]:.6g} 0 0 0\n")


def measure(command, environment):
    """Seconds of the second run, of its rebuilds, their number, levels, kinetic energy, memory of the process (MB)."""
    done = subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True)
    loops = re.findall(r"Loop time of ([0-9.e+-]+)", done.stdout)
    if done.returncode or len(loops) != 2:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    neigh = re.findall(r"^Neigh +\| [^|]*\| ([0-9.e+-]+)", done.stdout, re.M)
    builds = re.findall(r"Neighbor list builds = (\d+)", done.stdout)
    levels = re.findall(r"multigrid of (\d+) levels", done.stdout)
    energy = re.findall(r"^ *\d+ +\d+ +([0-9.eE+-]+)", done.stdout, re.M)[-1]
    return float(loops[-1]), float(neigh[-1]), int(builds[-1]), int(levels[-1]) if levels else 1, float(energy)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "build", "lmp_gpudem"))
    parser.add_argument("--stock", default="", help="stock LAMMPS (neighbor multi) to put beside it")
    parser.add_argument("--ranks", type=int, default=os.cpu_count(), help="MPI ranks of stock, threads of GPUDEM's CPU")
    parser.add_argument("--device", default="cpu", choices=["cpu", "gpu"])
    parser.add_argument("--precision", default="mixed", choices=["double", "mixed"])
    parser.add_argument("--grains", type=int, default=100000)
    parser.add_argument("--ratios", nargs="+", type=int, default=[1, 2, 3, 5, 10, 30])
    parser.add_argument("--levels", nargs="+", default=["auto", "1", "2", "3", "4"], help="auto, or numbers of levels")
    parser.add_argument("--single-limit", type=int, default=10, help="largest ratio for one level and for stock")
    parser.add_argument("--settle", type=int, default=2000)
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()

    root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    print("| ratio | grains | program | levels | us per step | ns per grain and step | ms per rebuild | rebuilds | "
          "kinetic energy |\n|---|---|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for ratio in arguments.ratios:
            data = os.path.join(folder, "data.sizes")
            position, radius, box = mixture(ratio, arguments.grains)
            write(data, position, radius, box)
            listed = []
            for levels in arguments.levels:
                if levels == "1" and ratio > arguments.single_limit:
                    continue
                command = os.path.join(folder, f"levels{levels}")
                with open(command, "w") as out:
                    out.write("" if levels == "auto" else "gpudem neighbor single\n" if levels == "1" else
                              f"gpudem neighbor multigrid levels {levels}\n")
                    out.write(open(os.path.join(HERE, "in.sizes")).read())
                listed.append((f"GPUDEM {arguments.device}, {arguments.precision}, {levels}",
                               [arguments.gpudem, "-sf", "gpudem", "-in", command],
                               {"GPUDEM_DEVICE": arguments.device, "GPUDEM_PRECISION": arguments.precision,
                                "GPUDEM_THREADS": str(arguments.ranks)}))
            if arguments.stock:
                listed.append((f"stock, multi, {arguments.ranks} ranks",
                               ["mpirun", *root, "--oversubscribe", "-np", str(arguments.ranks), arguments.stock, "-in",
                                os.path.join(HERE, "in.sizes"), "-var", "multi", "1"], {}))
            results = {}
            for _ in range(arguments.repeat):
                for name, command, environment in listed:
                    results.setdefault(name, []).append(
                        measure(command + ["-log", "none", "-var", "data", data, "-var", "steps", str(arguments.steps),
                                           "-var", "settle", str(arguments.settle)], environment))
            for name, values in results.items():
                loop, neigh, builds, levels, energy = (statistics.median(v) for v in zip(*values))
                step = loop / arguments.steps
                print(f"| {ratio} | {len(radius)} | {name} | {levels:.0f} | {1e6 * step:.0f} | "
                      f"{1e9 * step / len(radius):.1f} | {1e3 * neigh / max(1.0, builds):.1f} | {builds:.0f} | "
                      f"{energy:.4g} |", flush=True)


if __name__ == "__main__":
    main()
