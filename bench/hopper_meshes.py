#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""The hopper of examples/hopper_stl, discharged from one state by GPUDEM (triangles, exact region) and LIGGGHTS (the same STL).

One table on standard output (Markdown): normal force on the wall in the first state, without friction and damping; grains per
unit of time between steps 10000 and 55000; seconds of the run on one core.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(HERE, "..", "examples", "hopper_stl")
ROW = re.compile(r"^ +(\d+) +(\d+) +\S+ +(\S+)", re.M)

GPUDEM = """units lj
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data filled.data
reset_timestep 0
pair_style gran/{law}
pair_coeff * *
neighbor 0.15 bin
neigh_modify every 1 delay 0
timestep 0.0005
fix move all nve/sphere
fix pull all gravity 1.0 vector 0 0 -1
region cone cone z 0 0 2.5 6 0 5 open 1 open 2
region tube cylinder z 0 0 6 5 25 open 1 open 2
region exact union 2 cone tube
fix w all wall/gran/{wall}
thermo_style custom step atoms ke {force}
thermo 5000
thermo_modify lost ignore norm no format float %.10g
run {steps}
"""

LIGGGHTS = """atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
read_data filled.liggghts
neighbor 0.15 bin
neigh_modify delay 0
hard_particles yes
fix p1 all property/global kn peratomtypepair 1 {kn}
fix p2 all property/global kt peratomtypepair 1 {kt}
fix p3 all property/global gamman peratomtypepair 1 {gamman}
fix p4 all property/global gammat peratomtypepair 1 {gammat}
fix p5 all property/global coefficientFriction peratomtypepair 1 {friction}
fix p6 all property/global youngsModulus peratomtype 1.0e6
fix p7 all property/global poissonsRatio peratomtype 0.3
fix p8 all property/global coefficientRestitution peratomtypepair 1 0.5
fix p9 all property/global characteristicVelocity scalar 1.0
pair_style gran model hooke/stiffness tangential history
pair_coeff * *
timestep 0.0005
fix pull all gravity 1.0 vector 0.0 0.0 -1.0
fix shell all mesh/surface/stress file hopper.stl type 1
fix wall all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 meshes shell
fix move all nve/sphere
compute ke all ke
thermo_style custom step atoms c_ke f_shell[3]
thermo {every}
thermo_modify lost ignore norm no format float %.10g
run {steps}
"""


def run(command, folder, text, environment=None):
    with open(os.path.join(folder, "in.run"), "w") as f:
        f.write(text)
    done = subprocess.run(command + ["-in", "in.run"], cwd=folder, env={**os.environ, **(environment or {})},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode or "Loop time" not in done.stdout:
        sys.exit(f"{command[0]} failed:\n{done.stdout[-2000:]}")
    rows = {int(s): (int(n), float(f)) for s, n, f in ROW.findall(done.stdout)}
    return rows, float(re.findall(r"Loop time of ([0-9.]+)", done.stdout)[-1])


def for_liggghts(text):
    """Rows of atoms without image flags."""
    lines, atoms = [], False
    for line in text.split("\n"):
        if line and line[0].isalpha():
            atoms = line.startswith("Atoms")
            line = line.split(" #")[0]
        elif atoms:
            line = " ".join(line.split()[:7])
        lines.append(line)
    return "\n".join(lines)


def report(name, static, rows, seconds):
    rate = (rows[10000][0] - rows[55000][0]) / 22.5
    print(f"| {name} | {static} | {rate:.1f} | {seconds:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gpudem", default=os.path.join(HERE, "..", "build", "lmp_gpudem"))
    parser.add_argument("--liggghts", default="liggghts")
    parser.add_argument("--seed", default="300719")
    arguments = parser.parse_args()
    program = [os.path.abspath(arguments.gpudem), "-sf", "gpudem", "-log", "none"]
    double = {"GPUDEM_DEVICE": "cpu", "GPUDEM_PRECISION": "double", "GPUDEM_THREADS": "1"}
    mixed = {**double, "GPUDEM_PRECISION": "mixed"}
    real, still = "hooke/history 5000.0 NULL 50.0 NULL 0.5 1", "hooke/history 5000.0 0.0 0.0 0.0 0.0 0"

    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, os.path.abspath(os.path.join(EXAMPLE, "surface.py"))], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        with open(os.path.join(EXAMPLE, "in.hopper_stl")) as f:
            fill = f.read().split("# 2. ")[0]
        run(program + ["-var", "seed", arguments.seed], folder, fill + "write_data filled.data\n", double)
        with open(os.path.join(folder, "filled.data")) as f, open(os.path.join(folder, "filled.liggghts"), "w") as g:
            g.write(for_liggghts(f.read()))

        print("| walls | normal force | grains per unit of time | seconds |\n|---|---|---|---|")
        shell = "sdf {} surface hopper.stl"
        rows, _ = run(program, folder, GPUDEM.format(law=still, wall=shell.format(still), force="f_w[3]", steps=1), double)
        for name, environment in (("GPUDEM triangles, double", double), ("GPUDEM triangles, mixed", mixed)):
            text = GPUDEM.format(law=real, wall=shell.format(real), force="f_w[3]", steps=60000)
            report(name, f"{rows[1][1]:.2f}", *run(program, folder, text, environment))
        text = GPUDEM.format(law=real, wall=f"region {real} region exact", force="vol", steps=60000)
        report("GPUDEM exact region, double", "", *run(program, folder, text, double))
        command = [arguments.liggghts, "-log", "none"]
        text = LIGGGHTS.format(kn=5000.0, kt=0.0, gamman=0.0, gammat=0.0, friction=0.0, every=1, steps=1)
        rows, _ = run(command, folder, text)
        text = LIGGGHTS.format(kn=5000.0, kt=5000.0 * 2 / 7, gamman=50.0, gammat=25.0, friction=0.5, every=5000, steps=60000)
        report("LIGGGHTS mesh/surface/stress", f"{rows[1][1]:.2f}", *run(command, folder, text))


if __name__ == "__main__":
    main()
