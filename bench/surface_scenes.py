# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Scenes of surfaces.py: shapes as STL files, and any number of grains of diameter 1 on a lattice inside them.

The shapes are those of examples/, enlarged so that the grains fill them to the same level.
"""
import importlib.util
import math
import os
import sys

import numpy as np

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples")
PITCH = 1.0     # of the lattice: the grains touch six others (diameters)
CLEAR = 0.53    # of centres from walls (diameters)
MISS = 0.02     # largest distance of triangles from the exact screw or slide (diameters)
SHAKE = 0.004   # largest displacement from the lattice in each direction


def example(folder):
    """The module that makes the triangles of an example."""
    path = os.path.join(EXAMPLES, folder, "surface.py")
    spec = importlib.util.spec_from_file_location(folder, path)
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, EXAMPLES)  # where it finds surfaces.py
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(EXAMPLES)
    return module


def write_stl(path, triangles):
    """A binary STL file of triangles [n][3][3]. Returns their number."""
    record = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("spare", "<u2")])
    record["corner"] = triangles
    with open(path, "wb") as f:
        f.write(bytes(80) + np.uint32(len(record)).tobytes())
        record.tofile(f)
    return len(record)


def write_data(path, position, lo, hi, seed=1):
    """A LAMMPS data file of grains at [n][3], shaken, in the box from lo to hi."""
    position = position + np.random.default_rng(seed).uniform(-SHAKE, SHAKE, position.shape)
    with open(path, "w") as f:
        f.write(f"grains\n\n{len(position)} atoms\n1 atom types\n\n")
        for d, axis in enumerate("xyz"):
            f.write(f"{lo[d]:.9g} {hi[d]:.9g} {axis}lo {axis}hi\n")
        f.write("\nAtoms # sphere\n\n")
        for first in range(0, len(position), 100_000):
            part = position[first:first + 100_000]
            rows = np.column_stack([np.arange(first + 1, first + len(part) + 1), part])
            f.write("%d 1 1 1 %.5f %.5f %.5f\n" * len(part) % tuple(rows.ravel().tolist()))


def filled(columns, bottom, top, inside, most):
    """The lowest lattice points of columns at (a, b) between two heights of which inside(height) is true: [n][3] a, b, height."""
    layers, found = [], 0
    for height in np.arange(bottom + 0.5 * PITCH, top, PITCH):
        chosen = columns[inside(height)]
        layers.append(np.column_stack([chosen, np.full(len(chosen), height)]))
        found += len(chosen)
        if found >= most:
            break
    return np.concatenate(layers)[:most]


def lattice(*ranges):
    """Points [n][2] of a square lattice whose cells lie within two ranges."""
    axes = [a + PITCH * (0.5 + np.arange(math.floor((b - a) / PITCH + 1e-9))) for a, b in ranges]
    return np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 2)


def enlarged(scale, points, grains):
    """points(scale) of a scale that has room for all grains, and that scale."""
    while True:
        position = points(scale)
        if len(position) == grains:
            return position, scale
        scale *= 1.03


def divisions(inner, outer, pitch):
    """How many quads a helicoid between two radii needs, along a turn and from radius to radius, to be within MISS."""
    turn = math.ceil(math.pi * math.sqrt(outer / (2.0 * MISS)))
    # a diagonal from r to r + d leads its height by d/(4 r) of the quad's angle
    across = (outer - inner) / (4.0 * inner) * pitch / turn / MISS
    return turn, max(1, math.ceil(across))


class Box:
    """No wall of triangles: the same number of grains, as deep as those of another scene."""

    def __init__(self, grains, depth):
        layers = max(2, round(depth / PITCH))
        side = max(4, math.ceil(math.sqrt(grains / layers)))
        self.lo, self.hi = (0.0, 0.0, 0.0), (side * PITCH, side * PITCH, depth + 5.0)
        columns = lattice((0.0, side * PITCH), (0.0, side * PITCH))
        self.position = filled(columns, 0.05, self.hi[2] + depth, lambda height: slice(None), grains)


class Drum:
    """As long as its radius, half full, around z; gravity along -y. Bars as in in.drum."""
    BARS, HEIGHT, THICKNESS = 8, 0.15, 0.05  # parts of the radius

    def __init__(self, grains, bars=True):
        self.bars = bars
        self.position, self.radius = enlarged(1.02 * (grains / (math.pi / 2.0)) ** (1.0 / 3.0),
                                              lambda radius: self.points(radius, grains), grains)
        edge = self.radius + 2.0
        self.length = self.radius
        self.lo, self.hi = (-edge, -edge, -1.0), (edge, edge, self.length + 1.0)

    def points(self, radius, grains):
        columns = lattice((-radius, radius), (0.01, radius - 0.01))  # x, z
        x = columns[:, 0]

        def inside(y):
            free = x * x + y * y < (radius - CLEAR) ** 2
            for k in range(self.BARS if self.bars else 0):
                c, s = math.cos(2.0 * math.pi * k / self.BARS), math.sin(2.0 * math.pi * k / self.BARS)
                out, side = c * x + s * y, c * y - s * x
                free &= (out < radius * (1.0 - self.HEIGHT) - CLEAR) | (np.abs(side) > 0.5 * self.THICKNESS * radius + CLEAR)
            return free
        return filled(columns, -radius, 0.0, inside, grains)[:, [0, 2, 1]]

    def write(self, path, count):
        """The shell in about count triangles as broad as long, the middles of its facets on the radius, with its bars."""
        height = self.length + 2.0
        side = math.sqrt(2.0 * math.pi * self.radius * height * 2.0 / count)
        facets = max(12, round(2.0 * math.pi * self.radius / side))
        rings = max(1, round(count / (2.0 * facets)))
        corner = self.radius / math.cos(math.pi / facets)
        phi = 2.0 * math.pi * np.arange(facets + 1) / facets
        x, y = corner * np.cos(phi), corner * np.sin(phi)
        x[-1], y[-1] = x[0], y[0]
        z = np.linspace(-1.0, self.length + 1.0, rings + 1)
        k, r = (a.ravel() for a in np.meshgrid(np.arange(facets), np.arange(rings), indexing="ij"))
        quads = [np.stack([x[k + a], y[k + a], z[r + b]], -1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        triangles = [np.stack([quads[0], quads[1], quads[2]], 1), np.stack([quads[0], quads[2], quads[3]], 1)]
        brick = example("drum_lifters").brick
        for n in range(self.BARS if self.bars else 0):
            out = np.array([math.cos(2.0 * math.pi * n / self.BARS), math.sin(2.0 * math.pi * n / self.BARS), 0.0])
            across = self.THICKNESS * self.radius * np.array([-out[1], out[0], 0.0])
            foot = self.HEIGHT * self.radius * out + (corner - self.radius + 1.0) * out  # stands in the shell
            low = (1.0 - self.HEIGHT) * self.radius * out - 0.5 * across + np.array([0.0, 0.0, -1.0])
            triangles.append(np.array(brick(low, (foot, across, (0.0, 0.0, height)))))
        return write_stl(path, np.concatenate(triangles))


class Screw:
    """The trough of examples/screw_conveyor filled to above the shaft."""
    LEVEL = 1.0  # of the grains above the axis, in the example's units

    def __init__(self, grains):
        self.shape = example("screw_conveyor")
        self.position, self.scale = enlarged(1.02 * (grains / 193.0) ** (1.0 / 3.0),
                                             lambda scale: self.points(scale, grains), grains)
        s = self.scale
        self.lo, self.hi = (0.0, -3.5 * s, -3.5 * s), (10.0 * s, 3.5 * s, 4.0 * s)
        self.depth = (self.LEVEL + self.shape.TROUGH) * s

    def points(self, s, grains):
        shape = self.shape
        columns = lattice((0.0, 10.0 * s), (-shape.TROUGH * s, shape.TROUGH * s))
        x, y = columns.T

        def inside(z):
            r = np.hypot(y, z)
            free = (r if z < 0.0 else np.abs(y)) < shape.TROUGH * s - CLEAR
            free &= r > shape.SHAFT * s + CLEAR
            turns = x / (shape.PITCH * s) - np.arctan2(z, y) / (2.0 * math.pi)
            along = np.abs(turns - np.round(turns)) * shape.PITCH * s  # from the blade, along x
            steep = shape.PITCH * s / (2.0 * math.pi * np.maximum(r, 1e-9))
            return free & ((along > 1.15 * CLEAR * np.sqrt(1.0 + steep * steep)) | (r > shape.BLADE * s + CLEAR))
        return filled(columns, -shape.TROUGH * s, self.LEVEL * s, inside, grains)

    def write(self, screw, trough):
        """Screw and trough in the example's units. Returns the number of their triangles."""
        m = self.shape
        turn, across = divisions(m.SHAFT * self.scale, m.BLADE * self.scale, m.PITCH * self.scale)
        along = math.ceil(turn * (m.TO - m.FROM) / m.PITCH)

        def wall(u, v):
            k = round(v * (turn + 2))  # straight, half a turn, straight
            if k in (0, turn + 2):
                return (m.FROM + (m.TO - m.FROM) * u, math.copysign(m.TROUGH, k - 1), m.TOP)
            phi = math.pi * (k - 1) / turn
            return (m.FROM + (m.TO - m.FROM) * u, -m.TROUGH * math.cos(phi), -m.TROUGH * math.sin(phi))
        return (write_stl(screw, np.array(m.grid(m.blade, along, across) + m.grid(m.shaft, along, turn))) +
                write_stl(trough, np.array(m.grid(wall, 6, turn + 2))))


class Slide:
    """The slide of examples/spiral_slide, grains on its whole length."""
    DEPTH = 0.75  # of the grains on the floor, in the example's units

    def __init__(self, grains):
        self.shape = example("spiral_slide")
        self.position, self.scale = enlarged(1.02 * (grains / 93.0) ** (1.0 / 3.0),
                                             lambda scale: self.points(scale, grains), grains)
        s = self.scale
        self.lo, self.hi = (-6.0 * s, -6.0 * s, -2.0 * s), (6.0 * s, 6.0 * s, 17.5 * s)
        self.depth = self.DEPTH * s

    def points(self, s, grains):
        m = self.shape
        columns = lattice((-m.OUTER * s, m.OUTER * s), (-m.OUTER * s, m.OUTER * s))
        r = np.hypot(*columns.T)
        keep = (r > m.INNER * s + CLEAR) & (r < m.OUTER * s - CLEAR)
        columns, r = columns[keep], r[keep]
        turn = np.arctan2(columns[:, 1], columns[:, 0]) / (2.0 * math.pi) % 1.0
        low = 1.15 * CLEAR * np.hypot(1.0, m.PITCH * s / (2.0 * math.pi * r))
        floor = m.PITCH * s * (m.TURNS - turn)
        margin = 2.0 / (2.0 * math.pi * r)  # from both ends (turns)
        runs = [(floor - k * m.PITCH * s, (turn + k > margin) & (turn + k < m.TURNS - margin)) for k in range(math.ceil(m.TURNS))]

        def inside(z):
            free = np.zeros(len(columns), bool)
            for bed, there in runs:
                free |= there & (z - bed > low) & (z - bed < self.DEPTH * s)
            return free
        return filled(columns, 0.0, (m.PITCH * m.TURNS + self.DEPTH) * s, inside, grains)

    def write(self, path):
        """The slide in the example's units. Returns the number of its triangles."""
        m = self.shape
        turn, across = divisions(m.INNER * self.scale, m.OUTER * self.scale, m.PITCH * self.scale)
        radii = np.linspace(m.INNER, m.OUTER, across + 1)
        profile = [m.PROFILE[0], *((float(radius), 0.0) for radius in radii), m.PROFILE[-1]]

        def place(u, v):
            radius, height = profile[round(v * (len(profile) - 1))]
            phi = 2.0 * math.pi * m.TURNS * u
            return (radius * math.cos(phi), radius * math.sin(phi), height + m.PITCH * m.TURNS * (1.0 - u))
        return write_stl(path, np.array(m.grid(place, math.ceil(turn * m.TURNS), len(profile) - 1)))
