# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""fix wall/gran/sdf against the exact analytic walls of stock LAMMPS, and against what it must conserve.

Every case runs on the host with stock pair styles ("host": plain verlet) and resident in both precisions.
"""
import unittest
from dataclasses import dataclass, field

import numpy as np

import scenes
import surfaces
from compare import _say, compare_dumps
from lammps import GPUDEM, StylesTest, make_tests
from tolerance import DOUBLE, DOUBLE_LONG, DRUM_FACETS, MIXED, ROLLING_MIXED, SERVO, WALL_SUMS, WALL_WEIGHT

NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 10.0 vector 1.0 2.0 -9.0\n"
HOOKE = "hooke 2.0e4 NULL 50.0 20.0 0.5 1"
HISTORY = "hooke/history 2.0e4 NULL 50.0 20.0 0.5 1"
HERTZ = "hertz/history 2.0e5 NULL 200.0 100.0 0.5 1"
LIMITED = "hooke/history 2.0e4 5.0e3 300.0 20.0 0.5 1 limit_damping"
GRANULAR = "granular hertz 2.0e5 20.0 tangential mindlin_rescale/force 1.5e5 0.5 0.4 rolling sds 1.0e4 30.0 0.2 " \
           "twisting marshall"
CONTACTS = " ".join(f"f_w[{k}]" for k in range(1, 9))
BOXED = dict(margin=(3.0, 3.0, 3.0))
# where single precision has the coordinates exactly, no grain deeper than a quarter of its radius
LO, HI = (0.03125, 0.015625, -0.03125), (7.1875, 7.21875, 7.234375)


class SurfaceTest(StylesTest):
    modes = ("host", "double", "mixed")

    def run_mode(self, mode, text, files, name=None, **kw):
        name = f"{name or 'run'}-{mode}"
        if mode == "host":
            return self.run_lammps(text, files, executable=GPUDEM, name=name, **kw)
        run = self.run_lammps(text, files, gpudem=mode, name=name, **kw)
        if run.status == 0:
            self.assertResident(run)
            self.assertNotIn("(wall/gran/sdf) on the host", run.everything)
        return run


@dataclass
class Case:
    wall: str                       # of stock LAMMPS: words after the law
    triangles: object
    words: str = ""                 # after surface FILE
    law: str = HISTORY
    region: str = ""
    fix: str = "wall/gran"
    group: str = "all"
    columns: str = CONTACTS
    commands: str = ""
    cloud: dict = field(default_factory=lambda: BOXED)


def block(law, words="", side="in", lo=LO, hi=HI, n=5, columns="", **kw):
    corners = " ".join(f"{float(a)!r} {float(b)!r}" for a, b in zip(lo, hi))
    sides = {"in": "inside", "out": "outside"}
    return Case("region r", surfaces.box(lo, hi, n), f"side {sides[side]} {words}", law, fix="wall/gran/region",
                region=f"region r block {corners} side {side} units box\n", columns=columns, **kw)


def floor(z, n, size=20.0):
    return surfaces.sheet((-5.0, -5.0, z), (size, 0, 0), (0, size, 0), n)


def beside(x):
    return not all(2.1 < x[d] < 5.0 for d in range(3))


SHAKE = ("variable dz equal 0.0625*(1-cos(2*PI/0.05*step*dt))\n"
         "variable vz equal 0.0625*2*PI/0.05*sin(2*PI/0.05*step*dt)\n")


def _analytic():
    for name, law in (("hooke", HOOKE), ("history", HISTORY), ("hertz", HERTZ), ("limited", LIMITED),
                      ("granular", GRANULAR)):
        yield f"plane_{name}", Case("zplane 0.03125 NULL", floor(0.03125, 9), law=law)
        yield f"box_{name}", block(law)
        yield f"post_{name}", block(law, side="out", lo=(2.5, 2.5, 2.5), hi=(4.5, 4.625, 4.75), n=3,
                                    cloud=dict(keep=beside, **BOXED))
    yield "group", Case("zplane 0.03125 NULL", floor(0.03125, 3), group="one", commands="group one type 1\n")
    yield "box_of_both_sides", block(HISTORY, n=1)
    yield "conveyor", Case("zplane 0.03125 NULL shear x 3.0", floor(0.03125, 8, 40.0), "move linear 3.0 0 0")
    yield "shaken_floor", Case("zplane 0.03125 NULL wiggle z 0.0625 0.05", floor(0.03125, 8),
                               "move variable NULL NULL v_dz NULL NULL v_vz", commands=SHAKE)
    yield "two_moves_in_one", Case("zplane 0.03125 NULL shear y -2.0", floor(0.03125, 8, 40.0),
                                   "move linear 5.0 -2.0 0 move linear -5.0 0 0")


class AnalyticCases(SurfaceTest):
    """Clouds that fall onto exact walls: every grain, every contact."""

    def check(self, case):
        data = ("cloud.data", scenes.cloud(**case.cloud))
        kw = dict(boundary="f f f", columns=case.columns)
        contacts = " contacts" if case.columns else ""
        stock = self.run_lammps(scenes.scene(case.commands + case.region + NVE + DOWN +
                                             f"fix w {case.group} {case.fix} {case.law} {case.wall}{contacts}\n", **kw), [data])
        ours = scenes.scene(case.commands + NVE + DOWN + f"fix w {case.group} wall/gran/sdf {case.law} surface s.stl "
                            f"{case.words}{contacts}\n", **kw)
        for mode in self.modes:
            run = self.run_mode(mode, ours, [data, ("s.stl", surfaces.binary_stl(case.triangles))])
            compare_dumps(self, stock.dump(), run.dump(), MIXED if mode == "mixed" else DOUBLE, scenes.DIAMETER, what=mode)


make_tests(AnalyticCases, {"Analytic": dict(_analytic())}, globals())


def single(x, v=(0, 0, 0), w=(0, 0, 0), diameter=1.0, lo=-10.0, hi=10.0):
    """Data file of single grains of density 2."""
    x, v, w = np.atleast_2d(x), np.atleast_2d(v), np.atleast_2d(w)
    lines = ["grains", "", f"{len(x)} atoms", "1 atom types", ""]
    lines += [f"{lo} {hi} {a}lo {a}hi" for a in "xyz"]
    lines += ["", "Atoms # sphere", ""] + [f"{k + 1} 1 {diameter} 2.0 " + " ".join(map(repr, map(float, p)))
                                           for k, p in enumerate(x)]
    lines += ["", "Velocities", ""] + [f"{k + 1} " + " ".join(map(repr, map(float, (*v[k % len(v)], *w[k % len(w)]))))
                                       for k in range(len(x))]
    return "\n".join(lines) + "\n"


class Rolling(SurfaceTest):
    def test_over_ten_thousand_facets(self):
        """Spinning, sliding, then rolling askew over facets of 0.4 of a radius: as on a plane."""
        data = ("cloud.data", single((-7.9, -7.7, 0.4995), (8.0, 7.0, 0), (0, 3.0, 20.0)))
        files = [data, ("s.stl", surfaces.binary_stl(surfaces.sheet((-10, -10, 0), (20, 0, 0), (0, 20, 0), 100, 50)))]
        for law in (HISTORY, GRANULAR):
            kw = dict(boundary="f f f", steps=20000, every=1000, pair=scenes.HOOKE_HISTORY)
            fall = NVE + "fix down all gravity 10.0 vector 0 0 -1\n"
            stock = self.run_lammps(scenes.scene(fall + f"fix w all wall/gran {law} zplane 0 NULL\n", **kw), [data])
            ours = scenes.scene(fall + f"fix w all wall/gran/sdf {law} surface s.stl\n", **kw)
            for mode in self.modes:
                run = self.run_mode(mode, ours, files, name=law.split("/")[0].split()[0])
                a, b = stock.dump()[20000][1], run.dump()[20000][1]
                away = np.abs(a[:, 2:11] - b[:, 2:11]).max() / np.abs(a[:, 2:11]).max()
                _say(f"rolling {law.split()[0]} {mode}", dict(away=away))
                self.assertGreater(a[0, 2], 3.0)
                self.assertLess(away, ROLLING_MIXED if mode == "mixed" else DOUBLE.position)

    def test_drum_of_facets(self):
        """A grain in a turning drum against the round one: the error falls with the square of the facets' length."""
        data = ("cloud.data", single((0.3, -3.48, 0.0)))
        soft = "hooke/history 4.0e3 NULL 50.0 20.0 0.5 1"
        kw = dict(boundary="f f f", steps=20000, every=5000, pair=scenes.HOOKE_HISTORY)
        fall = NVE + "fix down all gravity 10.0 vector 0 -1 0\n"
        stock = self.run_lammps(scenes.scene(fall + f"fix w all wall/gran {soft} zcylinder 4.0 shear x 2.0\n", **kw), [data], gpudem="double")
        period = 2.0 * np.pi * 4.0 / 2.0
        away = []
        for facets in (256, 1024):
            triangles = surfaces.tube((0, 0), 4.0, -2.0, 2.0, facets, 2)
            ours = scenes.scene(fall + f"fix w all wall/gran/sdf {soft} surface s.stl move rotate 0 0 0 0 0 -1 "
                                f"{period!r}\n", **kw)
            a = stock.dump()[20000][1][:, 2:5]
            for mode in ("host", "double") if facets == 1024 else ("double",):
                b = self.run_mode(mode, ours, [data, ("s.stl", surfaces.binary_stl(triangles))], name=str(facets))
                away.append(np.abs(a - b.dump()[20000][1][:, 2:5]).max())
        _say("drum", dict(coarse=away[0], fine=away[-1]))
        self.assertLess(away[-1], DRUM_FACETS)
        self.assertLess(away[-1], away[0])


class Sums(SurfaceTest):
    """The fix vector."""
    thermo = "step " + " ".join(f"f_w[{k}]" for k in range(1, 12))

    def test_forces_of_isolated_grains(self):
        """Nothing but the wall acts: its force and torque are those of the grains, its power follows from them."""
        rng = np.random.default_rng(4)
        grid = np.stack(np.meshgrid(*[np.arange(-2, 3) * 1.5] * 3, indexing="ij"), -1).reshape(-1, 3)
        data = ("cloud.data", single(grid + rng.uniform(-0.1, 0.1, grid.shape), rng.uniform(-4, 4, grid.shape),
                                     rng.uniform(-9, 9, grid.shape)))
        files = [data, ("s.stl", surfaces.binary_stl(surfaces.box((-3.5,) * 3, (3.5,) * 3, 4)))]
        text = scenes.scene(NVE + f"fix w all wall/gran/sdf {HISTORY} surface s.stl side inside move linear 1 2 3 "
                            "move rotate 0.5 0 0 0 0.6 0.8 7.0\nneigh_modify exclude group all all\n", boundary="f f f", steps=600, every=100,
                            thermo=self.thermo)
        for mode in self.modes:
            run = self.run_mode(mode, text, files)
            names, table = run.thermo()[0]
            touched = 0
            for row in table:
                columns, atoms = run.dump()[int(row[0])]
                x, f, t = (atoms[:, [columns.index(c) for c in names]] for names in
                           (("xu", "yu", "zu"), ("fx", "fy", "fz"), ("tqx", "tqy", "tqz")))
                force, torque = -f.sum(0), -(np.cross(x - row[9:12], f) + t).sum(0)
                scale = np.abs(f).max() + 1e-300
                self.assertLess(np.abs(row[1:4] - force).max(), WALL_SUMS[mode] * 100 * scale, mode)
                self.assertLess(np.abs(row[4:7] - torque).max(), WALL_SUMS[mode] * 1000 * scale, mode)
                spin = 2 * np.pi / 7.0 * np.array([0, 0.6, 0.8])
                # the axis stays where it is while the box is displaced first: both velocities at the reference point
                speed = velocity_of_reference(row[0] * 1e-4)
                power = -(row[1:4] @ speed + row[4:7] @ spin)
                self.assertLess(abs(row[7] - power), WALL_SUMS[mode] * 1e4 * scale, mode)
                touched += row[8]
            self.assertGreater(touched, 50)

    def test_weight_of_a_bed(self):
        """Rolling and twisting friction: without, a grain in a bowl of others spins for ever."""
        rng = np.random.default_rng(5)
        grid = np.stack(np.meshgrid(*[np.arange(4) * 1.02 - 1.5] * 2, np.arange(4) * 1.02 - 1.4, indexing="ij"), -1)
        grid = grid.reshape(-1, 3) + rng.uniform(-0.01, 0.01, (64, 3))
        files = [("cloud.data", single(grid)),
                 ("s.stl", surfaces.binary_stl(surfaces.box((-2.2, -2.1, -2.0), (2.1, 2.2, 4.0), 6)))]
        law = "hooke 2.0e4 100.0 tangential linear_history 1.5e4 0.5 0.5 rolling sds 5.0e3 100.0 0.2 " \
              "twisting sds 5.0e3 100.0 0.2"
        text = scenes.scene(NVE + "fix down all gravity 10.0 vector 0 0 -1\nfix slow all viscous 2.0\n"
                            f"fix w all wall/gran/sdf granular {law} surface s.stl side inside\n", boundary="f f f",
                            pair="granular", coeff=("* * " + law,), steps=18000, every=18000, timestep=5.0e-4,
                            thermo=self.thermo)
        weight = 64 * np.pi / 6.0 * 2.0 * 10.0
        for mode in self.modes:
            row = self.run_mode(mode, text, files).thermo()[0][1][-1]
            error = np.abs(row[1:4] - [0, 0, -weight]).max() / weight
            _say(f"weight {mode}", dict(error=error))
            self.assertLess(error, WALL_WEIGHT[mode])


def read_vtk(text):
    """Points, triangles, and the data of the triangles by name."""
    words = text.split()
    def numbers(name, count, skip):
        at = words.index(name) + skip
        return np.array(words[at:at + count], dtype=float)
    n = int(words[words.index("POINTS") + 1])
    m = int(words[words.index("POLYGONS") + 1])
    data = {name: numbers(name, m, 5) for name in ("pressure", "contacts", "wear", "zone")}
    data["shear_stress"] = numbers("shear_stress", 3 * m, 2).reshape(-1, 3)
    return numbers("POINTS", 3 * n, 3).reshape(-1, 3), numbers("POLYGONS", 4 * m, 3).reshape(-1, 4)[:, 1:].astype(int), data


class Faces(SurfaceTest):
    """Sums for zones, and pressure, shear stress and wear of triangles."""
    law = "hooke 2.0e4 NULL 200.0 20.0 0.5 1"

    def test_zones(self):
        """A grain on each of two plates: weights by zone; the sum of zones is the vector."""
        plates = (surfaces.ascii_stl(surfaces.sheet((-4, -4, 0), (3, 0, 0), (0, 3, 0), 2), "left") +
                  surfaces.ascii_stl(surfaces.sheet((1, 1, 0.5), (3, 0, 0), (0, 3, 0), 2), "right"))
        data = ("cloud.data", single([(-3, -3, 0.499), (2.5, 2.5, 0.999)]))
        columns = [f"f_w[{z}][{k}]" for z in (1, 2) for k in range(1, 8)]
        text = scenes.scene(NVE + "fix down all gravity 10.0 vector 0 0 -1\n"
                            f"fix w all wall/gran/sdf {self.law} surface s.stl zones\n", boundary="f f f", steps=20000,
                            every=20000, thermo="step " + " ".join(columns + [f"f_w[{k}]" for k in range(1, 9)]))
        weight = np.pi / 6.0 * 2.0 * 10.0
        for mode in self.modes:
            row = self.run_mode(mode, text, [data, ("s.stl", plates)]).thermo()[0][1][-1][1:]
            zones, whole = row[:14].reshape(2, 7), row[14:]
            self.assertTrue(np.allclose(zones[:, 2], -weight, rtol=WALL_WEIGHT[mode], atol=0), mode)
            self.assertTrue((zones[:, 6] == 1).all())
            # torque about the origin: x cross (0 0 -m g)
            for zone, (x, y) in zip(zones, ((-3, -3), (2.5, 2.5))):
                self.assertTrue(np.allclose(zone[3:5], (-y * weight, x * weight), rtol=10 * WALL_WEIGHT[mode], atol=0))
            self.assertTrue(np.allclose(zones[:, :6].sum(0), whole[:6], rtol=WALL_SUMS[mode] * 10,
                                        atol=weight * WALL_SUMS[mode] * 10))

    def test_pressure_and_wear(self):
        """A grain at rest on a belt that runs below it at speed 2: its weight, mu m g of shear, k m g 2 t of wear."""
        belt = surfaces.sheet((-4, -4, 0), (8, 0, 0), (0, 8, 0), 8)
        data = ("cloud.data", single((0.3, 0.2, 0.5 - np.pi / 3.0 * 10 / 2e4)))
        hold = "fix hold all setforce 0.0 0.0 NULL\nvelocity all set 0 0 0\n"
        text = scenes.scene("fix move all nve\nfix down all gravity 10.0 vector 0 0 -1\n"
                            f"fix w all wall/gran/sdf {self.law} surface s.stl move linear 0 2.0 0 "
                            "faces 10 1000 faces.*.vtk wear 1.0e-3\n" + hold, boundary="f f f", steps=2000, every=2000)
        weight = np.pi / 6.0 * 2.0 * 10.0
        for mode in self.modes:
            run = self.run_mode(mode, text, [data, ("s.stl", surfaces.binary_stl(belt))])
            for step in (1000, 2000):
                x, triangles, d = read_vtk(run.path(f"faces.{step}.vtk").read_text())
                area = 0.5 * np.linalg.norm(np.cross(x[triangles[:, 1]] - x[triangles[:, 0]],
                                                     x[triangles[:, 2]] - x[triangles[:, 0]]), axis=1)
                worn = 1.0e-3 * weight * 2.0 * step * 1e-4
                for name, got, expected in (("pressure", (d["pressure"] * area).sum(), weight),
                                            ("shear", (d["shear_stress"][:, 1] * area).sum(), -0.5 * weight),
                                            ("wear", (d["wear"] * area).sum(), worn),
                                            ("contacts", d["contacts"].sum(), 1.0),
                                            ("belt", x[:, 1].min(), -4.0 + 2.0 * step * 1e-4)):
                    self.assertLess(abs(got - expected), WALL_SUMS["mixed"] * 10 * abs(expected), (mode, step, name))


class Servo(SurfaceTest):
    def test_lid_on_a_spring(self):
        """A lid pressed on a grain with force 30: overlaps on both sides carry it, and the lid stands still."""
        kn = 2.0e4
        data = ("cloud.data", single((0.1, 0.2, 0.5)))
        law = f"hooke {kn} NULL 400.0 20.0 0.5 1"
        text = scenes.scene(NVE + f"fix floor all wall/gran {law} zplane 0 NULL\n"
                            f"fix w all wall/gran/sdf {law} surface s.stl servo force 0 0 -1 30.0 0.5 5\n",
                            boundary="f f f", steps=12000, every=12000, thermo="step f_w[3] f_w[12] f_w[13]")
        lid = surfaces.binary_stl(surfaces.sheet((-2, -2, 1.0625), (4, 0, 0), (0, 4, 0), 2))
        for mode in self.modes:
            row = self.run_mode(mode, text, [data, ("s.stl", lid)]).thermo()[0][1][-1]
            self.assertLess(abs(row[1] - 30.0), 30.0 * SERVO, mode)
            self.assertLess(abs(row[2] - (0.0625 + 2 * 30.0 / kn)), SERVO * 0.1, mode)
            self.assertLess(abs(row[3]), SERVO, mode)

    def test_torque_on_a_lever(self):
        """A vertical plate turned by a torque of 6 against a grain fixed at a distance of 2: force 3."""
        data = ("cloud.data", single((2.0, 0.53125, 0.0)))
        law = "hooke 2.0e4 NULL 0.0 0.0 0.0 0"
        text = scenes.scene(f"fix w all wall/gran/sdf {law} surface s.stl servo torque 0 0 0 0 0 1 6.0 0.05 2\n",
                            boundary="f f f", steps=12000, every=12000, thermo="step f_w[6] f_w[12]")
        plate = surfaces.binary_stl(surfaces.sheet((0, 0, -2), (4, 0, 0), (0, 0, 4), 2))
        for mode in self.modes:
            row = self.run_mode(mode, text, [data, ("s.stl", plate)]).thermo()[0][1][-1]
            self.assertLess(abs(row[1] + 6.0), 6.0 * SERVO, mode)
            self.assertGreater(row[2], 0.01)


def velocity_of_reference(t):
    """Body displaced by (1 2 3) t, then turned about the axis through (0.5 0 0); reference (0.5 0 0) of the body."""
    axis, point, rate = np.array([0, 0.6, 0.8]), np.array([0.5, 0, 0]), 2 * np.pi / 7.0
    v, move = np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0, 3.0]) * t

    def turn(a):
        c, s = np.cos(rate * t), np.sin(rate * t)
        return a * c + np.cross(axis, a) * s + axis * (axis @ a) * (1 - c)
    return turn(v) + np.cross(axis * rate, turn(point + move - point))


class Containers(SurfaceTest):
    def test_closed_box_holds_its_grains(self):
        """A box that turns and shakes fast: after 3000 steps every centre is inside."""
        rate, amplitude, period = 2 * np.pi / 1.0, 1.0, 0.5
        grid = np.stack(np.meshgrid(*[np.arange(5) * 1.1 - 2.2] * 3, indexing="ij"), -1).reshape(-1, 3)
        rng = np.random.default_rng(6)
        for n, modes in ((1, self.modes), (12, ("double",))):
            files = [("cloud.data", single(grid, rng.uniform(-30, 30, grid.shape))),
                     ("s.stl", surfaces.binary_stl(surfaces.box((-2.8,) * 3, (2.8,) * 3, n)))]
            text = scenes.scene(NVE + "fix w all wall/gran/sdf hooke/history 2.0e5 NULL 50.0 20.0 0.5 1 surface s.stl "
                                f"side inside move rotate 0 0 0 0 0.6 0.8 1.0 move wiggle {amplitude} 0 0 {period}\n",
                                boundary="f f f", steps=3000, every=3000)
            for mode in modes:
                run = self.run_mode(mode, text, files, name=str(n))
                columns, atoms = run.dump()[3000]
                x = atoms[:, [columns.index(c) for c in ("xu", "yu", "zu")]]
                t = 0.3
                x = x - np.array([amplitude * np.sin(2 * np.pi / period * t), 0, 0])
                axis, angle = np.array([0, 0.6, 0.8]), -rate * t
                x = (x * np.cos(angle) + np.cross(axis, x) * np.sin(angle) +
                     np.outer(x @ axis, axis) * (1 - np.cos(angle)))
                self.assertEqual(len(x), 125)
                self.assertLess(np.abs(x).max(), 2.8)

    def test_tunnelling_is_reported(self):
        """A grain that a soft sheet cannot stop."""
        files = [("cloud.data", single((0, 0, 0.45), (0, 0, -30.0))), ("s.stl", surfaces.binary_stl(floor(0.0, 3)))]
        text = scenes.scene(NVE + "fix w all wall/gran/sdf hooke 100.0 NULL 0 0 0.5 0 surface s.stl\n", boundary="f f f",
                            steps=1000)
        for mode in self.modes:
            run = self.run_mode(mode, text, files, succeed=False)
            self.assertNotEqual(run.status, 0)
            self.assertRegex(run.everything, "centre of atom 1 went through a wall of triangles")


class Files(SurfaceTest):
    def test_formats_and_placement(self):
        """STL, OBJ and PLY of a unit box, scaled, turned and moved to where stock has its region."""
        lo, hi = (0.0, 0.0, 0.0), (7.1875, 7.1875, 7.1875)
        data = ("cloud.data", scenes.cloud(**BOXED))
        corners = " ".join(f"{a!r} {b!r}" for a, b in zip(lo, hi))
        kw = dict(boundary="f f f", steps=100)
        stock = self.run_lammps(scenes.scene(f"region r block {corners} side in units box\n" + NVE + DOWN +
                                             f"fix w all wall/gran/region {HISTORY} region r\n", **kw), [data])
        t = surfaces.box((-1,) * 3, (1,) * 3, 2)
        for name, content in (("b.stl", surfaces.binary_stl(t)), ("a.stl", surfaces.ascii_stl(t)), ("s.obj", surfaces.obj(t)),
                              ("s.ply", surfaces.ply(t))):
            text = scenes.scene(NVE + DOWN + f"fix w all wall/gran/sdf {HISTORY} surface {name} side inside rotate 0 0 1 90 "
                                "scale 3.59375 translate 3.59375 3.59375 3.59375\n", **kw)
            run = self.run_mode("double", text, [data, (name, content)], name=name)
            compare_dumps(self, stock.dump(), run.dump(), DOUBLE, scenes.DIAMETER, what=name)
            self.assertRegex(run.everything, r"surface   : \d+ triangles, search tables of [\d.e+-]+ MB made in [\d.e+-]+ s")

    def test_shapes(self):
        """A box by its name is stock's region, whole or cut; a cylinder, as fine as its grains ask for, holds them."""
        data = ("cloud.data", scenes.cloud(**BOXED))
        kw = dict(boundary="f f f", steps=100)
        stock = self.run_lammps(scenes.scene("region r block 0 7.1875 0 7.1875 0 7.1875 side in units box\n" + NVE + DOWN +
                                             f"fix w all wall/gran/region {HISTORY} region r\n", **kw), [data])
        for spacing in ("", "spacing 1.0"):
            text = scenes.scene(NVE + DOWN + f"fix w all wall/gran/sdf {HISTORY} surface box(0,7.1875,0,7.1875,0,7.1875) {spacing} "
                                "side inside\n", **kw)
            run = self.run_mode("double", text, [data], name="box" + spacing[:3])
            compare_dumps(self, stock.dump(), run.dump(), DOUBLE, scenes.DIAMETER, what=f"box {spacing}")
        files = [("cloud.data", single(np.array([[0.3 * k - 0.6, 0.0, 1.1 * k - 2.2] for k in range(5)]), np.zeros((5, 3))))]
        text = scenes.scene(NVE + DOWN + f"fix w all wall/gran/sdf {HISTORY} surface cylinder(x,0,0,2.8,-3,3) side inside\n",
                            boundary="f f f", steps=2000, every=2000)
        run = self.run_mode("double", text, files, name="cylinder")
        self.assertRegex(run.everything, r"1 bodies, 1 closed")
        columns, atoms = run.dump()[2000]
        x = atoms[:, [columns.index(c) for c in ("xu", "yu", "zu")]]
        self.assertLess(np.hypot(x[:, 1], x[:, 2]).max(), 2.8)
        self.assertLess(np.abs(x[:, 0]).max(), 3.0)


    def test_combined_shapes(self):
        """A trough, two boxes without a third, is stock's region without a lid; left to right is the same as in brackets."""
        data = ("cloud.data", scenes.cloud(**BOXED))
        kw = dict(boundary="f f f", steps=100)
        stock = self.run_lammps(scenes.scene("region r block 0 7.1875 0 7.1875 0 13 side in units box\n" + NVE + DOWN +
                                             f"fix w all wall/gran/region {HISTORY} region r\n", **kw), [data])
        left, right, hole = "box(-1,8.1875,-1,3,-1,12)", "box(-1,8.1875,3,8.1875,-1,12)", "box(0,7.1875,0,7.1875,0,13)"
        for n, words in enumerate((f"{left} union {right} difference {hole}", f"difference(union({left},{right}),{hole})")):
            text = scenes.scene(NVE + DOWN + f"fix w all wall/gran/sdf {HISTORY} surface {words} spacing 0.45 side outside\n", **kw)
            for mode in self.modes:
                run = self.run_mode(mode, text, [data], name=str(n))
                compare_dumps(self, stock.dump(), run.dump(), MIXED if mode == "mixed" else DOUBLE, scenes.DIAMETER,
                              what=f"{words}, {mode}")
                self.assertRegex(run.everything, r"1 bodies, 1 closed; area [\d.]+, volume of the closed 477\.41\D")


class Continuation(SurfaceTest):
    fixes = NVE + DOWN + f"fix w all wall/gran/sdf {HISTORY} surface s.stl side inside move wiggle 0.2 0.1 0.3 0.02\n"
    stl = ("s.stl", surfaces.binary_stl(surfaces.box(LO, HI, 4)))

    def second(self, state):
        return ("read_restart state\npair_style " + scenes.HOOKE_HISTORY + "\npair_coeff * *\nneighbor 0.05 bin\n"
                "neigh_modify delay 0 every 1 check yes\ntimestep 1.0e-4\n" + self.fixes + scenes.output(50) + "run 100\n",
                [("state", state), self.stl])

    def test_restart(self):
        """Springs and the phase of the motion go on, also from the host to the device and back."""
        first = scenes.scene(self.fixes, boundary="f f f", after="run 100\nwrite_restart state\nrun 100\n")
        data = ("cloud.data", scenes.cloud(**BOXED))
        for writer, reader in (("host", "host"), ("double", "double"), ("host", "double"), ("double", "host")):
            whole = self.run_mode(writer, first, [data, self.stl], name=f"whole-{writer}-{reader}")
            text, files = self.second(whole.path("state").read_bytes())
            ours = self.run_mode(reader, text, files, name=f"second-{writer}-{reader}").dump()
            a = whole.dump()
            compare_dumps(self, {s: a[s] for s in a if s > 100}, {s: ours[s] for s in ours if s > 100}, DOUBLE,
                          what=f"{writer} to {reader}")


class Ranks(SurfaceTest):
    """Several ranks, each with its part of the grains: the answer of one, on the host and resident."""
    modes = ("host", "double")
    fall = NVE + "fix down all gravity 10.0 vector 0 0 -1\n"
    sheet = surfaces.binary_stl(surfaces.sheet((-20.0, -20.0, 0.0), (40.0, 0, 0), (0, 40.0, 0), 9))

    def check(self, text, files, ranks=(2, 4), look=None):
        """Dumps, output of the fix, and what \\p look finds in the directory of a run."""
        for mode in self.modes:
            one = self.run_mode(mode, text, files)
            for n in ranks:
                many = self.run_mode(mode, text, files, name=f"{n}-ranks", ranks=n)
                what = f"{mode}, {n} ranks"
                compare_dumps(self, one.dump(), many.dump(), DOUBLE_LONG, what=what)
                for (names, a), (_, b) in zip(one.thermo(), many.thermo()):
                    scale = np.abs(a).max()
                    self.assertLess(np.abs(a - b).max(), DOUBLE_LONG.thermo * scale, what)
                for x, y in zip(look(one), look(many)) if look else ():
                    self.assertLessEqual(np.abs(x - y).max(), DOUBLE_LONG.other * np.abs(x).max(), what)
        return one

    def belt(self):
        """Grains on a belt that carries them over the borders of the ranks, each grain alone."""
        x = [(-8.5 + 1.1 * k, y, 0.499) for k in range(15) for y in (-3.1, -0.9, 1.3, 3.5)]
        return ("cloud.data", single(x, [(0.3, 0.4, 0), (-0.2, 0.1, 0)]))

    def test_box_that_moves(self):
        """Sums, and the contact of every grain, of a cloud in a box."""
        fixes = NVE + DOWN + f"fix w all wall/gran/sdf {HISTORY} surface s.stl side inside move wiggle 0.2 0.1 0.3 0.02 " \
                             "zones contacts\n"
        parts = surfaces.box(LO, HI, 2).reshape(6, -1, 3, 3)
        stl = ("s.stl", "".join(surfaces.ascii_stl(t, f"side{k}") for k, t in enumerate(parts)))
        zones = " ".join(f"f_w[{z}][{k}]" for z in range(1, 7) for k in (1, 2, 3, 6, 7))
        text = scenes.scene(fixes, boundary="f f f", columns=CONTACTS, thermo=Sums.thermo + " " + zones)
        self.check(text, [("cloud.data", scenes.cloud(**BOXED)), stl])

    def test_springs_go_along(self):
        """Springs cross the borders with their grains: sticking, then sliding, on a belt that swings."""
        text = scenes.scene(self.fall + f"fix w all wall/gran/sdf {HISTORY} surface s.stl move linear 4.0 0 0 "
                            "move wiggle 0 0.05 0 0.1\n", boundary="f f f", steps=4000, every=2000, thermo=Sums.thermo)
        one = self.check("processors * 1 1\n" + text, [self.belt(), ("s.stl", self.sheet)])
        columns, atoms = one.dump()[4000]
        moved = atoms[:, columns.index("xu")] - one.dump()[0][1][:, columns.index("xu")]
        self.assertGreater(moved.min(), 0.15)

    def test_servo(self):
        """A lid on grains of all ranks: every rank moves it alike."""
        law = "hooke 2.0e4 NULL 400.0 20.0 0.5 1"
        data = ("cloud.data", single([(x, y, 0.5) for x in (-6, -2, 2, 6) for y in (-4.5, 4.5)]))
        text = scenes.scene(NVE + f"fix floor all wall/gran {law} zplane 0 NULL\n"
                            f"fix w all wall/gran/sdf {law} surface s.stl servo force 0 0 -1 30.0 0.5 5 gain 2.0e-4\n",
                            boundary="f f f", steps=4000, every=1000, thermo="step f_w[3] f_w[12] f_w[13]")
        lid = surfaces.binary_stl(surfaces.sheet((-8, -8, 1.0), (16, 0, 0), (0, 16, 0), 2))
        one = self.check(text, [data, ("s.stl", lid)])
        self.assertGreater(one.thermo()[0][1][-1][1], 20.0)

    def test_faces_wear_and_restart(self):
        """Files of faces; springs, wear and phase of a restart that other ranks go on with."""
        fixes = self.fall + f"fix w all wall/gran/sdf {HISTORY} surface s.stl move linear 4.0 0 0 " \
                            "faces 10 500 faces.*.vtk wear 1.0e-3\n"

        def faces(run):
            x, _, d = read_vtk(run.path("faces.1000.vtk").read_text())
            return [x] + [d[name] for name in sorted(d)]
        stl = ("s.stl", self.sheet)
        text = scenes.scene(fixes, boundary="f f f", every=500, after="run 500\nwrite_restart state\nrun 500\n")
        one = self.check(text, [self.belt(), stl], look=faces)
        self.assertGreater(faces(one)[-2].max(), 0.0)
        for mode in self.modes:
            state = self.run_mode(mode, text, [self.belt(), stl], name="writer", ranks=4).path("state").read_bytes()
            then = ("read_restart state\npair_style " + scenes.HOOKE_HISTORY + "\npair_coeff * *\nneighbor 0.05 bin\n"
                    "neigh_modify delay 0 every 1 check yes\ntimestep 1.0e-4\n" + fixes + scenes.output(500) + "run 500\n")
            ours = self.run_mode(mode, then, [("state", state), stl], name="reader", ranks=2)
            compare_dumps(self, {1000: one.dump()[1000]}, {1000: ours.dump()[1000]}, DOUBLE_LONG, what=mode)
            for x, y in zip(faces(one), faces(ours)):
                self.assertLessEqual(np.abs(x - y).max(), DOUBLE_LONG.other * np.abs(x).max(), mode)

    def test_ranks_without_grains(self):
        """All grains on one rank of four, and a surface that most ranks never touch."""
        data = ("cloud.data", single([(-8.0 + 0.3 * k, 1.2 * k - 6.0, 0.499) for k in range(8)], (0.5, 0.2, 0)))
        text = scenes.scene(self.fall + f"fix w all wall/gran/sdf {HISTORY} surface s.stl zones move linear 1.0 0 0\n",
                            boundary="f f f", steps=300, thermo=Sums.thermo + " f_w[1][3] f_w[1][7]")
        one = self.check("processors * 1 1\n" + text, [data, ("s.stl", self.sheet)], ranks=(4,))
        self.assertGreater(np.abs(one.thermo()[0][1][:, -1]).max(), 0.0, "no grain touches the surface")

    def test_tunnelling_ends_every_rank(self):
        files = [("cloud.data", single((0.3, 0.2, 0.45), (0, 0, -30.0))), ("s.stl", surfaces.binary_stl(floor(0.0, 3)))]
        text = scenes.scene(NVE + "fix w all wall/gran/sdf hooke 100.0 NULL 0 0 0.5 0 surface s.stl\n", boundary="f f f",
                            steps=1000)
        for mode in self.modes:
            run = self.run_mode(mode, text, files, ranks=4, succeed=False, timeout=60)
            self.assertNotEqual(run.status, 0)
            self.assertRegex(run.everything, "centre of atom 1 went through a wall of triangles")


class Mistakes(SurfaceTest):
    def fails(self, words, *phrases, triangles=None, content=None):
        stl = content if content is not None else surfaces.binary_stl(triangles if triangles is not None else floor(0, 2))
        run = self.run_lammps(scenes.scene(NVE + f"fix w all wall/gran/sdf {words}\n", boundary="f f f", steps=1),
                              [("cloud.data", scenes.cloud(cells=(3, 3, 3), **BOXED)), ("s.stl", stl)], gpudem="double",
                              succeed=False)
        self.assertNotEqual(run.status, 0)
        for phrase in ("ERROR", *phrases):
            self.assertIn(phrase, run.everything)

    def test_words(self):
        self.fails("hook 1 1 1 1 1 1 surface s.stl", "'hook'", "hooke/history")
        self.fails("hooke 1 1 x 1 1 1 surface s.stl", "'x'", "gamma_n")
        self.fails("hooke 1 1 1 1 1 2 surface s.stl", "dampflag is 0 or 1, not 2")
        self.fails("hooke 1 1 1 1 1 1 zplane s.stl", "'zplane'", "surface")
        self.fails(f"{HISTORY} surface s.stl colour red", "'colour'", "translate")
        self.fails(f"{HISTORY} surface s.stl spacing 0.1", "spacing is for shapes", "s.stl")
        self.fails(f"{HISTORY} surface box(0,1,0,1,0,1) scale 2 spacing 0.1", "spacing stands right behind the shape")
        self.fails(f"{HISTORY} surface ball(0,0,0,1)", "'ball' is no shape", "sphere")
        self.fails(f"{HISTORY} surface sphere(0,0,0,1) spacing 0", "the spacing is 0")
        box = "box(0,1,0,1,0,1)"
        self.fails(f"{HISTORY} surface {box} minus {box}", "'minus' is no operation", "union, intersection and difference")
        self.fails(f"{HISTORY} surface {box} {box}", "'box(0,1,0,1,0,1)' is no operation")
        self.fails(f"{HISTORY} surface {box} union", "the shape behind union is missing")
        self.fails(f"{HISTORY} surface {box} union spacing 0.1", "union combines shapes, but 'spacing'")
        self.fails(f"{HISTORY} surface s.stl union {box} spacing 0.1", "union combines shapes, but 's.stl'")
        self.fails(f"{HISTORY} surface {box} spacing 0.1 union {box}", "union stands between two shapes")
        self.fails(f"{HISTORY} surface {box} union {box}", "keyword spacing")
        self.fails(f"{HISTORY} surface {box} difference plane(0,0,0,0,0,1,1) spacing 0.1", "plane(0,0,0,0,0,1,1)", "closed shapes")
        self.fails(f"{HISTORY} surface {box} difference sphere(0,0,0,2) spacing 0.1", "nothing is left of it")
        self.fails(f"{HISTORY} surface s.stl side left", "'left'", "both, inside or outside")
        self.fails(f"{HISTORY} surface s.stl move spin 1", "'spin'", "rotate, nutate")
        self.fails(f"{HISTORY} surface s.stl move rotate 0 0 0 0 0 0 1", "axis", "no length")
        self.fails(f"{HISTORY} surface s.stl move rotate 0 0 0 0 0 1", "the period is missing")
        self.fails(f"{HISTORY} surface s.stl scale -1", "the scale is -1")
        self.fails(f"{HISTORY} surface s.stl max/contacts 99", "max/contacts is 99", "1 to 16")
        self.fails(f"{HISTORY} surface s.stl move variable NULL NULL v_no NULL NULL NULL", "variable no does not exist")
        self.fails("granular hertz 1e5 1.0 surface s.stl", "tangential")
        self.fails(f"{HISTORY} surface s.stl faces 10 15 f.vtk", "every 15 steps", "no multiple of the 10")
        self.fails(f"{HISTORY} surface s.stl wear 1e-3", "keyword faces", "missing")
        self.fails(f"{HISTORY} surface s.stl servo speed 0 0 1 1 1 1", "'speed'", "force or torque")
        self.fails(f"{HISTORY} surface s.stl servo force 0 0 1 0 1 1", "target 0 needs a gain")

    def test_files(self):
        self.fails(f"{HISTORY} surface none.stl", "none.stl")
        self.fails(f"{HISTORY} surface s.stl", "s.stl", content=b"solid nothing\nendsolid\n")
        t = surfaces.box((0, 0, 0), (1, 1, 1), 2)
        self.fails(f"{HISTORY} surface s.stl side inside", "0 of 1 bodies closed", "open edge", triangles=t[1:])


if __name__ == "__main__":
    unittest.main()
