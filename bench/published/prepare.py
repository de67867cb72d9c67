#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Walls and initial states of the benchmark of Dosta et al. (Comput. Phys. Commun. 296 (2024) 109066) as STL and LAMMPS data files.

  prepare.py PUBLISHED FOLDER                      all cases; the states that were not published are settled by in.settle
  prepare.py PUBLISHED FOLDER --cases impact_50k   one case, nothing to settle

PUBLISHED holds the files of the data set: Penetration_walls.txt, Penetration_50KParticles.txt, Silo_walls__large_orifice_.txt.
"""
import argparse
import glob
import os
import re
import subprocess
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "examples"))
import surfaces  # noqa: E402

MATERIALS = os.path.join(HERE, "..", "..", "potentials", "dosta_2024.gran")
ROUGH = 1.0  # friction in which stacked beds settle: with their own they would lose the loose structure of the published one
DENSITY = {"M1": 2500.0, "M2": 2000.0}  # kg/m3
SILO_GRAIN = 4e-3  # m, diameter
SILO_GRAINS = 100_000
CATCH = 0.06  # m, below the lip: a plate on which grains that are out wait to be deleted
CLOSED = 8.0e-5  # m, by which the flat facets of the published silo come inside its circle


def read_table(path, columns):
    """Rows of numbers below the line of titles that have the wanted number of columns."""
    with open(path) as file:
        rows = [line.split() for line in file.readlines()[1:]]
    return numpy.array([row for row in rows if len(row) == columns], dtype=float)


def write_walls(source, target, catch=None):
    """Corners (x, y, z three times a line) as binary STL, with a plate below by catch; returns all corners but the plate's (m)."""
    corners = read_table(source, 9).reshape(-1, 3, 3)
    plate = []
    if catch:
        z = float(corners[:, :, 2].min()) - catch
        plate = surfaces.grid(lambda u, v: (0.26 * (u - 0.5), 0.26 * (v - 0.5), z), 1, 1)
    surfaces.write(target, corners.tolist() + plate)
    return corners.reshape(-1, 3)


def write_state(path, title, box, diameter, density, centres):
    """Data file of grains of one size at rest, type 1 of 2; positions to 1e-12 m."""
    with open(path, "w") as file:
        file.write(f"{title}\n\n{len(centres)} atoms\n2 atom types\n\n")
        for (low, high), d in zip(box, "xyz"):
            file.write(f"{low} {high} {d}lo {d}hi\n")
        file.write("\nAtoms # sphere\n\n")
        for k, (x, y, z) in enumerate(centres):
            file.write(f"{k + 1} 1 {diameter:g} {density:g} {x:.12f} {y:.12f} {z:.12f}\n")
    print(f"{path}: {len(centres)} grains, centres from {min(centres[:, 2]):.6f} to {max(centres[:, 2]):.6f} m")


def read_state(path):
    """Centres (m) in the order of the IDs of a data file."""
    with open(path) as file:
        text = file.read()
    body = re.split(r"\n(?:Velocities|Bonds)", text.split("\nAtoms", 1)[1].split("\n", 1)[1])[0]
    rows = numpy.array([line.split()[:7] for line in body.splitlines() if line.strip()], dtype=float)
    return rows[numpy.argsort(rows[:, 0]), 4:7]


def stacked_bed(centres, diameter, count):
    """The lowest grains of a settled bed, or of copies of it on top of one another, every other one turned by 180 degrees: the
    lowest centre of each is a diameter above the highest one below."""
    order = centres[numpy.argsort(centres[:, 2])]
    parts = []
    for copy in range(-(-count // len(order))):
        part = order * ([1.0, 1.0, 1.0] if copy % 2 == 0 else [-1.0, -1.0, 1.0])
        if parts:
            part[:, 2] += parts[-1][:, 2].max() + diameter - part[:, 2].min()
        parts.append(part)
    return numpy.concatenate(parts)[:count]


def rough_materials(path, friction):
    """The benchmark's material file with another friction."""
    with open(MATERIALS) as source, open(path, "w") as target:
        target.write(re.sub(r"(?m)^(pair .* friction) \S+", rf"\1 {friction}", source.read()))


def silo_lattice(corners, diameter, count):
    """Lowest centres of a simple cubic lattice in the silo, spacing 1.06 diameters, a little out of place."""
    radii = numpy.hypot(corners[:, 0], corners[:, 1])
    lip, orifice = corners[:, 2].min(), radii.min()
    inner = radii[corners[:, 2] > corners[:, 2].max() - 1e-6].min()
    clear = 0.55 * diameter + CLOSED
    spacing = 1.06 * diameter
    n = int(inner / spacing) + 1
    rows = numpy.arange(-n, n + 1) * spacing
    z = numpy.arange(lip + clear, corners[:, 2].max() - diameter, spacing)
    x, y, z = (a.ravel() for a in numpy.meshgrid(rows, rows, z, indexing="ij"))
    cone = orifice + (z - lip) - numpy.sqrt(2.0) * clear  # its sides lean by 45 degrees
    inside = numpy.hypot(x, y) < numpy.minimum(inner - clear, cone)
    points = numpy.stack((x, y, z), axis=1)[inside]
    if len(points) < count:
        sys.exit(f"the silo holds {len(points)} grains of the lattice, not {count}")
    points = points[numpy.argsort(points[:, 2], kind="stable")[:count]]
    return points + numpy.random.default_rng(4711).uniform(-0.02, 0.02, points.shape) * diameter


def settle(lmp, folder, name, state, values):
    """Run in.settle from the state (box, diameter, density, centres); replaces name.data by what settled."""
    box, diameter, density, centres = state
    start, out = os.path.join(folder, f"{name}.start"), os.path.join(folder, f"{name}.settled")
    write_state(start, f"{name}: to settle", box, diameter, density, centres)
    command = [*lmp.split(), "-sf", "gpudem", "-in", os.path.join(HERE, "in.settle"), "-log", os.path.join(folder, f"log.settle.{name}"),
               "-screen", "none", "-var", "start", start, "-var", "out", out, "-var", "diameter", str(diameter), "-var", "density", str(density)]
    for key, value in values.items():
        command += ["-var", key, str(value)]
    if subprocess.run(command).returncode:
        sys.exit(f"{' '.join(command)} failed: see its log")
    with open(os.path.join(folder, f"log.settle.{name}")) as file:
        print("\n".join(line.strip() for line in file if line.startswith("settled:")))
    write_state(os.path.join(folder, f"{name}.data"), f"{name}: settled, at rest", box, diameter, density, read_state(out))
    os.remove(start)
    os.remove(out)


def impact(arguments, count):
    """The box, and a bed of count grains: the published one of 50 000, or made of it."""
    walls = os.path.join(arguments.folder, "impact_walls.stl")
    write_walls(os.path.join(arguments.published, "Penetration_walls.txt"), walls)
    grains = read_table(os.path.join(arguments.published, "Penetration_50KParticles.txt"), 4)
    box, diameter, centres = ((-0.07, 0.07), (-0.05, 0.05), (-0.12, 0.5)), 2.0 * grains[0, 0], grains[:, 1:]
    name = f"impact_{count // 1000}k"
    if count == len(centres):
        write_state(os.path.join(arguments.folder, f"{name}.data"), f"{name}: published state", box, diameter, DENSITY["M1"], centres)
        return
    state = (box, diameter, DENSITY["M1"], stacked_bed(centres, diameter, count))
    rough = os.path.join(arguments.folder, "rough.gran")
    rough_materials(rough, ROUGH)
    settle(arguments.lmp, arguments.folder, name, state, {
        "walls": walls, "material": "M1", "file": rough, "step": 2e-6, "fall": arguments.fall or 15000, "rest": arguments.rest or 8000})


def silo(arguments, orifice, material):
    """The silo and its fill, settled on a plane that closes the outlet."""
    source = glob.glob(os.path.join(arguments.published, f"Silo_walls__{orifice}_orifice_*.txt"))
    if not source:
        sys.exit(f"{arguments.published} has no Silo_walls__{orifice}_orifice_.txt")
    walls = os.path.join(arguments.folder, f"silo_{orifice}.stl")
    corners = write_walls(source[0], walls, CATCH)
    lip = corners[:, 2].min()
    box = ((-0.14, 0.14), (-0.14, 0.14), (lip - 0.1, corners[:, 2].max() + 0.02))
    state = (box, SILO_GRAIN, DENSITY[material], silo_lattice(corners, SILO_GRAIN, SILO_GRAINS))
    settle(arguments.lmp, arguments.folder, f"silo_{orifice}_{material}", state, {
        "walls": walls, "material": material, "lid": lip, "soft": arguments.soft or 9000, "file": MATERIALS, "step": 4e-6,
        "fall": arguments.fall or 17000, "rest": arguments.rest or 5000})


CASES = {"impact_50k": (impact, 50_000), "impact_25k": (impact, 25_000), "impact_100k": (impact, 100_000),
         **{f"silo_{orifice}_{material}": (silo, orifice, material) for orifice in ("large", "small") for material in ("M1", "M2")}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("published", help="folder of the published files")
    parser.add_argument("folder", help="for the results")
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "..", "build", "lmp_gpudem"), help="with its own options")
    parser.add_argument("--cases", nargs="+", default=["impact_50k", "impact_100k", "silo_large_M1"], choices=sorted(CASES))
    parser.add_argument("--soft", type=int, help="steps of soft grains")
    parser.add_argument("--fall", type=int, help="steps of the true material with little drag")
    parser.add_argument("--rest", type=int, help="steps of the true material with much drag")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    for name in arguments.cases:
        make, *of = CASES[name]
        make(arguments, *of)


if __name__ == "__main__":
    main()
