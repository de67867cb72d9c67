# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Scenes of the accuracy bench: spheres of diameter about 1 and density 1, Hertz-Mindlin, E = 1e5, nu = 0.3 (LAMMPS units lj).

Two spheres that meet with relative speed 1 overlap by 1 % of a diameter and part after one collision time TC; durations and time
steps are counted in it.
"""
import math
from dataclasses import dataclass, field

import numpy as np

YOUNG, POISSON = 1.0e5, 0.3
E_STAR = YOUNG / (2.0 * (1.0 - POISSON ** 2))
PAIR_MASS = math.pi / 12.0
TC = 2.868265 * (PAIR_MASS ** 2 / (0.25 * E_STAR ** 2)) ** 0.2   # Hertz 1882: effective mass pi/12, radius 1/4, speed 1


@dataclass
class Scene:
    name: str
    x: np.ndarray                # [n, 3]
    v: np.ndarray                # [n, 3]
    w: np.ndarray                # [n, 3]
    radius: np.ndarray           # [n]
    duration: int                # collision times
    restitution: float = 1.0
    friction: float = 0.0
    xgt: float = 0.0             # tangential over normal dashpot
    gravity: float = 0.0
    floor: bool = False
    box: tuple = (0.0, 0.0, 0.0)  # lengths, 0: not periodic
    skin: float = 0.1
    note: str = ""
    mass: np.ndarray = field(init=False)

    def __post_init__(self):
        self.mass = 4.0 / 3.0 * np.pi * self.radius ** 3

    def law(self):
        tangential = f"mindlin NULL {self.xgt} {self.friction}" if self.friction else "linear_nohistory 0.0 0.0"
        return f"hertz/material {YOUNG} {self.restitution} {POISSON} damping coeff_restitution tangential {tangential}"

    def data(self):
        """LAMMPS data file, all digits."""
        lo, hi = self.x.min(0) - 6.0, self.x.max(0) + 6.0
        bounds = [(0.0, b) if b else (a, c) for a, b, c in zip(lo, self.box, hi)]
        if self.floor:
            bounds[2] = (0.0, hi[2])
        rows = [f"{self.name}\n\n{len(self.x)} atoms\n1 atom types\n"]
        rows += [f"{a:.17g} {b:.17g} {axis}lo {axis}hi" for axis, (a, b) in zip("xyz", bounds)]
        rows += ["\nAtoms # sphere\n"] + [f"{k} 1 {2.0 * r:.17g} 1.0 " + " ".join(f"{c:.17g}" for c in x)
                                          for k, (r, x) in enumerate(zip(self.radius, self.x), 1)]
        rows += ["\nVelocities\n"] + [f"{k} " + " ".join(f"{c:.17g}" for c in (*v, *w))
                                      for k, (v, w) in enumerate(zip(self.v, self.w), 1)]
        return "\n".join(rows) + "\n"

    def head(self, dt, source="read_data data.scene"):
        """Input up to the run."""
        periodic = " ".join("p" if b else "f" for b in self.box)
        text = (f"units lj\natom_style sphere\nboundary {periodic}\nnewton off\ncomm_modify vel yes\n{source}\n"
                f"pair_style granular\npair_coeff * * {self.law()}\nneighbor {self.skin} bin\nneigh_modify delay 0 every 1\n"
                f"timestep {dt:.17g}\nfix move all nve/sphere\n")
        if self.gravity:
            text += f"fix weight all gravity {self.gravity} vector 0 0 -1\n"
        if self.floor:
            text += f"fix floor all wall/gran granular {self.law()} zplane 0.0 NULL contacts\n"
        return text

    def reference_input(self):
        """What accuracy-reference reads."""
        rows = [f"{YOUNG} {POISSON} {self.restitution} {self.xgt} {self.friction} {self.gravity} {int(self.floor)} "
                + " ".join(f"{b:.17g}" for b in self.box) + f" {len(self.x)}"]
        rows += [" ".join(f"{c:.17g}" for c in (*x, *v, *w, r, m))
                 for x, v, w, r, m in zip(self.x, self.v, self.w, self.radius, self.mass)]
        return "\n".join(rows) + "\n"


def rotations(random, count):
    """Uniformly random rotation matrices (from unit quaternions)."""
    q = random.normal(size=(count, 4))
    a, b, c, d = (q / np.linalg.norm(q, axis=1)[:, None]).T
    return np.stack([np.stack([1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)], -1),
                     np.stack([2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)], -1),
                     np.stack([2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)], -1)], 1)


def collisions(name, restitution, friction, along=0.0, spin=0.0, wall=False, count=64):
    """64 collisions at once, in random directions, beginning anywhere within a step; normal relative speed 1.

    along: largest tangential relative speed; spin: largest surface speed by spin. A wall: the plane z = 0, speed 1."""
    random = np.random.default_rng(3)
    place = 6.0 * np.stack([np.arange(count) % 8, np.arange(count) // 8, np.zeros(count)], -1)
    gap, slide = random.uniform(0.0, 0.2 * TC, count), random.uniform(0.0, along, count)
    zero = np.zeros(count)
    if wall:
        r = np.full(count, 0.5)
        w = np.stack([zero, random.uniform(-spin, spin, count) / 0.5, zero], -1)
        return Scene(name, place + np.stack([zero, zero, 0.5 + gap], -1), np.stack([slide, zero, zero - 1.0], -1), w, r, 2,
                     restitution, friction, 0.0, floor=True, note="64 impacts on a plane")
    turn = rotations(random, count)
    offset = np.einsum("nij,nj->ni", turn, np.stack([0.5 * (1.0 + gap), zero, zero], -1))
    half = np.einsum("nij,nj->ni", turn, np.stack([zero - 0.5, 0.5 * slide, zero], -1))
    spins = [np.einsum("nij,nj->ni", turn, random.uniform(-spin, spin, (count, 3)) / 0.5) for _ in range(2)]
    return Scene(name, np.concatenate([place + offset, place - offset]), np.concatenate([half, -half]), np.concatenate(spins),
                 np.full(2 * count, 0.5), 2, restitution, friction, note="64 pairs")


def lattice(random, spacing, spread, jitter, side=10):
    x = (np.stack(np.meshgrid(*[np.arange(side) + 0.5] * 3, indexing="ij"), -1).reshape(-1, 3)) * spacing
    return x + random.uniform(-jitter, jitter, x.shape), random.uniform(0.5 - spread, 0.5 + spread, len(x))


def cloud(xgt=0.0):
    """10^3 spheres, solid fraction 0.48, friction and normal dashpots; a few collisions each."""
    random = np.random.default_rng(5)
    x, radius = lattice(random, 1.04, 0.01, 0.008)
    v = random.uniform(-1.0, 1.0, x.shape)
    return Scene("cloud", x, v, random.uniform(-2.0, 2.0, x.shape), radius, 4, 0.8, 0.3, xgt, box=(10.4,) * 3,
                 note="10^3 grains, 4 collision times")


def gas(duration, side=10):
    """Elastic, without friction, solid fraction 0.3: nothing takes or gives energy."""
    random = np.random.default_rng(6)
    x, radius = lattice(random, 1.2, 0.025, 0.05, side)
    v = random.uniform(-1.0, 1.0, x.shape)
    return Scene("elastic gas", x, v - v.mean(0), np.zeros_like(x), radius, duration, box=(1.2 * side,) * 3,
                 note="10^3 grains")


def bed():
    """10^3 spheres to be dropped on a floor, periodic to the sides."""
    random = np.random.default_rng(7)
    x, radius = lattice(random, 1.12, 0.05, 0.005)
    return Scene("resting bed", x, np.zeros_like(x), np.zeros_like(x), radius, 0, 0.5, 0.5, 0.9, gravity=1.0, floor=True,
                 box=(11.2, 11.2, 0.0), note="10^3 grains on a floor")


def single_collisions():
    return [collisions("normal, e = 1", 1.0, 0.0), collisions("normal, e = 0.5", 0.5, 0.0),
            collisions("oblique", 0.9, 0.3, along=2.5), collisions("spinning", 0.9, 0.3, spin=2.0),
            collisions("wall", 0.9, 0.3, along=2.5, spin=1.0, wall=True)]
