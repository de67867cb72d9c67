# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Pile, drum, hopper and compaction with some hundred grains of 5 mm: scenes for a seed, and the numbers read off their states.

Both programs start from the same loose lattice, of random radii (+-10 %) and places; they then go apart as chaos has it, so only
means over seeds compare.
"""
import math
import pathlib
import statistics
import sys

import numpy as np

from collisions import G
from scene import Drum, Law, Plane, Scene, Surface

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "examples"))
from surfaces import revolved  # noqa: E402

D = 5.0e-3
LAW = Law(young=2.0e6, friction=0.5)
ROLLS = Law(young=2.0e6, friction=0.5, rolling="epsd", rolling_friction=0.2, rolling_viscosity=0.3)
DT = 4.0e-5      # 1/25 of a collision at 0.5 m/s


def lattice(seed, lo, hi, inside=None, count=None):
    """Loose grains in a block: places and radii."""
    random = np.random.default_rng(seed)
    gap = 1.14 * D
    axes = [a + gap * (np.arange(max(1, int((b - a) / gap + 1e-9))) + 0.5) for a, b in zip(lo, hi)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    x = x[np.argsort(x[:, 2], kind="stable")]
    x = x[inside(x)] if inside else x
    x = x[:count]
    return x + random.uniform(-0.015 * D, 0.015 * D, x.shape), random.uniform(0.45 * D, 0.55 * D, len(x))


def pile(seed):
    """A column in a slot, periodic across, whose sides are taken away: the slope of the heap that is left (degrees)."""
    half, width = 5.5 * D, 5.7 * D
    x, r = lattice(seed, (-half, 0.0, 0.0), (half, width, 24.0 * D), count=700)
    floor, left, right = Plane("z", 0.0), Plane("x", -half), Plane("x", half, below=False)
    return Scene("pile", ROLLS, x, r, DT, 7500, walls=(floor, left, right), then=(((floor,), 25000),), gravity=G, every=32500,
                 boundary="f p f", box=((-80.0 * D, 0.0, -D), (80.0 * D, width, 30.0 * D)), skin=0.2 * D)


def slope(scene, run):
    """Angle of the flanks between a fifth and four fifths of the height, from the highest grain of each two diameters; mean height."""
    x, z = run.rows[-1][:, 0], run.rows[-1][:, 2]
    bins = np.floor(x / (2.0 * D)).astype(int)
    top = {b: z[bins == b].max() for b in np.unique(bins)}
    at, height = 2.0 * D * (np.array(list(top)) + 0.5), np.array(list(top.values()))
    summit = at[height.argmax()]
    use = (height > 0.2 * height.max()) & (height < 0.8 * height.max())
    angles = []
    for side in (-1, 1):
        chosen = use & (np.sign(at - summit) == side)
        angles.append(-side * math.degrees(math.atan(np.polyfit(at[chosen], height[chosen], 1)[0])))
    return {"slope of the flanks (degrees)": float(np.mean(angles)), "mean height (diameters)": float(z.mean() / D)}


def drum(seed):
    """A drum half full, periodic along its axis, 1.4 rad/s: Froude number 0.01."""
    radius, width = 10.0 * D, 4.56 * D
    x, r = lattice(seed, (-0.5 * width, -radius, -radius), (0.5 * width, radius, 0.45 * radius),
                   lambda x: np.hypot(x[:, 1], x[:, 2]) < radius - 0.6 * D)
    return Scene("drum", ROLLS, x, r, DT, 50000, walls=(Drum(radius, width, 1.4, 0.5 * D),), gravity=G, every=500, boundary="p f f",
                 box=((-0.5 * width, -1.1 * radius, -1.1 * radius), (0.5 * width, 1.1 * radius, 1.1 * radius)), skin=0.2 * D)


def lean(scene, run):
    """Angle by which the bed's centre of mass is turned from below the axis, mean over the second half of the run."""
    x = np.array([(r[:, 1:3] * scene.mass[:, None]).sum(0) / scene.mass.sum() for r in run.rows[len(run.rows) // 2:]])
    angle = np.degrees(np.arctan2(x[:, 0], -x[:, 1]))
    return {"angle of the centre of mass (degrees)": float(angle.mean()),
            "its depth (radii of the drum)": float(np.hypot(x[:, 0], x[:, 1]).mean() / (10.0 * D))}


def hopper(seed):
    """A cone of triangles, orifice 5.6 diameters wide, filled and then opened."""
    def inside(x):
        return np.hypot(x[:, 0], x[:, 1]) < 5.4 * D
    x, r = lattice(seed, (-6.0 * D, -6.0 * D, 6.0 * D), (6.0 * D, 6.0 * D, 22.0 * D), inside)
    profile = [(2.8 * D, 0.0), (6.0 * D, 5.0 * D), (6.0 * D, 15.0 * D), (6.0 * D, 25.0 * D)]
    shell = Surface(tuple(revolved(profile, 48)))
    return Scene("hopper", LAW, x, r, DT, 10000, walls=(shell, Plane("z", 0.0)), then=(((shell,), 30000),), gravity=G, every=250,
                 boundary="f f f", box=((-7.0 * D, -7.0 * D, -4.0 * D), (7.0 * D, 7.0 * D, 26.0 * D)), skin=0.2 * D)


def discharge(scene, run):
    """Grains per second that pass the orifice while between a tenth and seven tenths of them have left."""
    inside = np.array([(r[:, 2] > 0.0).sum() for r in run.rows])
    time = run.steps * scene.dt
    use = (inside < 0.9 * len(scene.x)) & (inside > 0.3 * len(scene.x))
    return {"discharge rate (grains/s)": float(-np.polyfit(time[use], inside[use], 1)[0])}


def compaction(seed):
    """A box with rough sides and a plate of triangles that comes down at 0.06 m/s."""
    side, top, speed = 10.26 * D, 12.0 * D, 0.06
    x, r = lattice(seed, (0.0, 0.0, 0.0), (side, side, 11.4 * D), count=810)
    a, b = -D, side + D
    corners = [(a, a, top), (b, a, top), (b, b, top), (a, b, top)]
    plate = Surface(((corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])), (0.0, 0.0, -speed))
    walls = (Plane("z", 0.0), Plane("x", 0.0), Plane("x", side, below=False), Plane("y", 0.0), Plane("y", side, below=False), plate)
    return Scene("compaction", LAW, x, r, DT, 13500, walls=walls, gravity=G, every=50, boundary="f f f",
                 box=((-2.0 * D, -2.0 * D, -D), (side + 2.0 * D, side + 2.0 * D, top + 2.0 * D)), skin=0.2 * D)


def stiffness(scene, run):
    """Height of the bed under the plate at two loads on the floor; loads from the overlaps with the floor (Hertz, at rest)."""
    side = 10.26 * D
    effective = 0.5 * scene.law.young / (1.0 - scene.law.nu ** 2)
    depth = [np.maximum(scene.radius - r[:, 2], 0.0) for r in run.rows]
    load = np.array([(4.0 / 3.0 * effective * np.sqrt(scene.radius) * d ** 1.5).sum() for d in depth]) / side ** 2
    height = (12.0 * D - 0.06 * run.steps * scene.dt) / D
    result = {}
    for p in (5.0e3, 2.0e4):
        k = np.flatnonzero(load < p)[-1]
        result[f"height at {p / 1e3:g} kPa (diameters)"] = float(np.interp(p, load[k:k + 2], height[k:k + 2]))
    return result


# scene, what is read off it, and how many times the seeds: slopes of so few grains scatter
SCENES = {"pile": (pile, slope, 3), "drum": (drum, lean, 1), "hopper": (hopper, discharge, 1), "compaction": (compaction, stiffness, 1)}


def mean(values):
    """Mean and its standard error."""
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))


def apart(a, b):
    """Difference of two means in its standard errors."""
    (p, u), (q, v) = mean(a), mean(b)
    return (p - q) / math.hypot(u, v)


def compare(programs, names, seeds):
    """For each scene: its name, the scene of the last seed, {quantity: {program: values over seeds}}, {program: seconds}."""
    for name, (make, measure, times) in SCENES.items():
        values, seconds = {}, {p: [] for p in names}
        for seed in range(1, times * seeds + 1):
            scene = make(seed)
            for program in names[seed % len(names):] + names[:seed % len(names)]:   # in turns
                run = programs.run(scene, program)
                seconds[program].append(run.seconds)
                for quantity, value in measure(scene, run).items():
                    values.setdefault(quantity, {p: [] for p in names})[program].append(value)
        yield name, scene, values, seconds
