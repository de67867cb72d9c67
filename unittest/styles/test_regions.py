# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""fix wall/gran/region against stock LAMMPS: every kind of region from both sides, open faces, motion, unions.

The clouds fill a box of 7.2 diameters. Where stock LAMMPS 29 Sep 2021 is wrong (test_region_corrections.py) the cases
here keep away from it.
"""
import re
import unittest
from dataclasses import dataclass, field

import numpy as np

import scenes
from compare import _say, compare_dumps, compare_thermo
from lammps import StylesTest, make_tests, source_file
from tolerance import BULK_ENERGY_BAND, BULK_HEIGHT, BULK_LOST, DOUBLE, MIXED

NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 10.0 vector 1.0 2.0 -9.0\n"
HOOKE = "hooke 2.0e4 NULL 50.0 20.0 0.5 1"
HISTORY = "hooke/history 2.0e4 NULL 50.0 20.0 0.5 1"
HERTZ = "hertz/history 2.0e5 NULL 200.0 100.0 0.5 1"
LIMITED = "hooke/history 2.0e4 5.0e3 300.0 20.0 0.5 1 limit_damping"
# stock takes other numbers for materials: here it is given coefficients
GRANULAR = "granular hertz 2.0e5 20.0 tangential mindlin_rescale/force 1.5e5 0.5 0.4 rolling sds 1.0e4 30.0 0.2 " \
           "twisting marshall"
CONTACTS = " ".join(f"f_w[{k}]" for k in range(1, 9))
BOXED = dict(margin=(3.0, 3.0, 3.0))   # nothing leaves the box: GPUDEM and stock would notice at different steps


@dataclass
class Case:
    region: str                 # commands; the last region is named r
    law: str = HISTORY
    group: str = "all"
    extra: str = ""             # fixes before the wall
    before_move: str = ""       # fixes before the integrator
    pair: str = scenes.HOOKE_HISTORY
    cloud: dict = field(default_factory=lambda: BOXED)
    scene: dict = field(default_factory=lambda: dict(boundary="f f f"))
    columns: str = CONTACTS
    host: str = ""              # why the wall stays on the host, as the log says


# shapes that hold the cloud from within, and shapes that stand in it
HOLDING = {
    "block": "block 0.3 6.9 0.25 6.95 0.3 6.9",
    "prism": "prism 0.3 6.9 0.25 6.95 0.3 6.9 0.6 -0.5 0.4",
    "sphere": "sphere 3.6 3.5 3.6 4.9",
    "cylinder_x": "cylinder x 3.6 3.5 3.9 0.3 6.9",
    "cylinder_y": "cylinder y 3.6 3.5 3.9 0.3 6.9",
    "cylinder_z": "cylinder z 3.6 3.5 3.9 0.3 6.9",
    "cone_x": "cone x 3.6 3.5 2.5 4.5 0.3 6.9",
    "cone_z": "cone z 3.6 3.5 4.5 2.5 0.3 6.9",
    "plane": "plane 0.4 0.2 0.3 1.0 0.3 0.5",
}
STANDING = {
    "block": "block 2.2 4.6 2.9 5.1 1.7 4.4",
    "prism": "prism 2.2 4.6 2.9 5.1 1.7 4.4 0.6 -0.5 0.4",
    "sphere": "sphere 3.6 3.5 3.6 1.6",
    "cylinder_x": "cylinder x 3.6 3.5 1.3 2.0 5.0",
    "cylinder_y": "cylinder y 3.6 3.5 1.3 2.0 5.0",
    "cylinder_z": "cylinder z 3.6 3.5 1.3 2.0 5.0",
    "plane": "plane 0.4 0.2 0.3 -1.0 -0.3 -0.5",
    # from outside stock takes a cone for hollow: laws without R_eff
    "cone_x": "cone x 3.6 3.5 0.8 1.8 2.0 5.0",
    "cone_y": "cone y 3.6 3.5 1.8 1.0 2.0 5.0",
    "cone_z": "cone z 3.6 3.5 0.8 1.8 2.0 5.0",
}


def inside(name, law):
    return Case(f"region r {HOLDING[name]} side in units box\n", law, extra=DOWN)


def beside(shape, gap=0.4):
    """keep() for scenes.cloud(): no grain has its centre in a standing shape or too near to it."""
    words = shape.split()
    kind, axis = words[0], "xyz".find(words[1])
    n = [float(w) for w in words[1:] if w not in "xyz"]
    across = [d for d in range(3) if d != axis]

    def free(x):
        if kind in ("block", "prism"):
            wide = gap + (0.25 if kind == "prism" else 0.0)
            return any(not n[2 * d] - wide < x[d] < n[2 * d + 1] + wide for d in range(3))
        if kind == "sphere":
            return sum((x[d] - n[d]) ** 2 for d in range(3)) > (n[3] + gap) ** 2
        if kind == "plane":
            return sum((x[d] - n[d]) * n[3 + d] for d in range(3)) < -gap * 1.2
        rho = sum((x[d] - n[k]) ** 2 for k, d in enumerate(across)) ** 0.5
        return rho > max(n[2:-2]) + gap - (0.2 if kind == "cone" else 0.0) or not n[-2] - gap < x[axis] < n[-1] + gap
    return free


def outside(name, law, words="", region=None):
    shape = STANDING[name]
    return Case(region or f"region r {shape} side out {words} units box\n", law, cloud=dict(keep=beside(shape), **BOXED),
                scene=dict(boundary="f f f"))


def _inside():
    for name in HOLDING:
        yield f"hooke_{name}", inside(name, HOOKE)
        yield f"hertz_{name}", inside(name, HERTZ)
    for name in ("block", "cylinder_y", "sphere", "cone_x"):
        yield f"history_{name}", inside(name, HISTORY)
        yield f"granular_{name}", inside(name, GRANULAR)
    yield "limited_block", inside("block", LIMITED)
    yield "narrow_group", Case("group one type 1\n" + inside("block", HISTORY).region, extra=DOWN, group="one")
    yield "on_hooke_pairs", Case(inside("block", HISTORY).region, pair=scenes.HOOKE)
    yield "two_dimensions", Case("region r block 0.4 20.0 0.3 18.0 INF INF units box\n", before_move="fix flat all enforce2d\n",
                                 cloud=dict(dimension=2, cells=(20, 19, 1), margin=(3.0, 3.0, 0)),
                                 scene=dict(dimension=2, boundary="f f p"),
                                 columns=CONTACTS.replace("f_w[7]", ""))
    yield "periodic", Case("region r block INF INF 0.3 6.9 0.3 6.9 units box\n", cloud=dict(margin=(0, 3.0, 3.0)),
                           scene=dict(boundary="p f f"))


def _outside():
    for name in STANDING:
        yield f"hooke_{name}", outside(name, HOOKE)
        yield f"history_{name}", outside(name, HISTORY)
        if "cone" not in name:
            yield f"hertz_{name}", outside(name, HERTZ)
    yield "granular_block", outside("block", GRANULAR)
    yield "granular_cylinder_z", outside("cylinder_z", GRANULAR)


def _open():
    """Containers without some of their faces, from both sides."""
    for words in ("open 6", "open 1 open 3", "open 2 open 4 open 5"):
        label = words.replace("open ", "").replace(" ", "")
        for name in ("block", "prism"):
            yield f"{name}_{label}", Case(f"region r {HOLDING[name]} units box {words}\n", HERTZ, extra=DOWN)
    for words in ("open 1", "open 2", "open 1 open 2"):
        label = words.replace("open ", "").replace(" ", "")
        for name in ("cylinder_x", "cylinder_y", "cylinder_z", "cone_x", "cone_z"):
            yield f"{name}_{label}", Case(f"region r {HOLDING[name]} units box {words}\n", HISTORY, extra=DOWN)
    yield "cup_in_the_cloud", outside("block", HISTORY, "open 6")
    yield "tube_in_the_cloud", outside("cylinder_x", HISTORY, "open 1 open 2")
    yield "cone_in_the_cloud", outside("cone_z", HISTORY, "open 2")


SHAKE = "variable dx equal 0.04*sin(0.03*step)\nvariable dz equal -0.5*time\n"
TURN = "variable turn equal 0.0001*step\n"
BACK = "variable back equal swiggle(0.0,0.05,0.03)\n"


def _moving():
    for name in ("block", "sphere", "cylinder_y", "cone_z", "prism", "plane"):
        yield f"move_{name}", Case(f"{SHAKE}region r {HOLDING[name]} units box move v_dx NULL v_dz\n", HISTORY)
        yield f"turn_{name}", Case(f"{TURN}region r {HOLDING[name]} units box rotate v_turn 3.0 3.9 3.6 0.0 0.6 0.8\n",
                                   HISTORY)
    yield "move_and_turn", Case(f"{SHAKE}{TURN}region r {HOLDING['block']} units box move NULL v_dz v_dx "
                                "rotate v_turn 3.6 3.6 3.6 0 0 1\n", HERTZ)
    yield "drum", Case(f"{TURN}region r {HOLDING['cylinder_z']} units box rotate v_turn 3.6 3.5 0.0 0 0 1\n", HISTORY,
                       extra=DOWN)
    yield "turntable", Case(f"{TURN}region r plane 3.6 3.6 0.35 0 0 1 units box rotate v_turn 3.6 3.5 0.0 0 0 1\n", GRANULAR,
                            extra=DOWN)
    yield "swiggle", Case(f"{BACK}region r {HOLDING['cylinder_x']} units box move v_back NULL NULL\n", GRANULAR)
    blade = outside("block", HISTORY)
    blade.region = f"{TURN}region r {STANDING['block']} side out units box rotate v_turn 3.4 4.0 3.0 0 0 1\n"
    yield "blade", blade
    pusher = outside("cylinder_x", HOOKE)
    pusher.region = f"{SHAKE}region r {STANDING['cylinder_x']} side out units box move NULL v_dx v_dz open 1\n"
    yield "pusher", pusher
    yield "shared", Case(f"{SHAKE}region r {HOLDING['block']} units box move v_dx NULL v_dz\n"
                         f"fix other all wall/gran/region {HOOKE} region r\n", HISTORY)
    yield "particles_in_the_variable", Case("variable dx equal 0.01*vcm(all,x)\n"
                                            f"region r {HOLDING['block']} units box move v_dx NULL NULL\n", HISTORY,
                                            host="variable dx, which depends on more than the step")
    yield "radius_from_a_variable", Case("variable wide equal 4.9-step*0.0001\nregion r sphere 3.6 3.5 3.6 v_wide units box\n",
                                         HISTORY, host="changes its shape with a variable")


def _trees():
    """Unions and intersections at rest; the velocities of moving members are a matter of test_region_corrections.py."""
    two = "region a block 0.3 6.9 0.3 4.0 0.3 6.9 units box\nregion b cylinder x 3.8 3.6 3.1 0.4 6.8 units box\n"
    yield "union", Case(two + "region r union 2 a b\n", HISTORY)
    yield "union_hertz", Case(two + "region r union 2 b a\n", HERTZ, extra=DOWN)
    yield "intersect", Case("region a cylinder z 3.6 3.5 3.9 0.3 6.9 units box\nregion b sphere 3.4 3.6 3.6 4.2 units box\n"
                            "region c plane 0.5 0.5 0.8 0.1 0.3 1 units box\nregion r intersect 3 a b c\n", GRANULAR)
    post = outside("cylinder_z", HISTORY)
    post.region = (f"region a {STANDING['cylinder_z']} side out units box\nregion b block 0.3 6.9 0.3 6.9 0.3 6.9 units box\n"
                   "region r intersect 2 b a\n")
    yield "post_in_a_box", post
    solid = outside("block", HISTORY)
    solid.region = (f"region a {STANDING['block']} units box\nregion b sphere 3.4 4.0 3.0 1.9 units box\n"
                    "region r intersect 2 a b side out\n")
    yield "intersect_from_outside", solid
    yield "nested", Case(two + "region c sphere 3.6 3.6 3.6 4.4 units box\nregion ab union 2 a b\n"
                         "region r intersect 2 ab c\n", HISTORY)
    yield "nested_deep", Case(two + "region c sphere 3.6 3.6 3.6 4.4 units box\nregion ab union 2 a b\n"
                              "region abc intersect 2 ab c\nregion d block 0.3 3.4 0.3 6.9 0.3 6.9 units box\n"
                              "region r union 2 d abc\n", HISTORY, extra=DOWN)
    yield "funnel", Case("region a cone z 3.6 3.5 1.5 4.2 2.0 6.9 units box open 1 open 2\n"
                         "region b cylinder z 3.6 3.5 1.5 0.3 2.0 units box open 2\nregion r union 2 a b\n", HISTORY,
                         extra=DOWN, cloud=dict(keep=_in_the_funnel, **BOXED))
    # velocities do not act in this law, and displacements are right in stock
    yield "moving_member", Case(f"{SHAKE}region a block 0.3 6.9 0.3 4.0 0.3 6.9 units box move v_dx NULL NULL\n"
                                "region b cylinder x 3.8 3.6 3.1 0.4 6.8 units box\nregion r union 2 a b\n",
                                "hooke 2.0e4 0.0 0.0 0.0 0.0 0")
    yield "eight_faces_of_each", Case("".join(f"region {k} block {lo} {hi} 0.3 6.9 0.3 6.9 units box\n" for k, lo, hi in
                                              (("a", 0.3, 2.0), ("b", 1.9, 4.0), ("c", 3.9, 5.0), ("d", 4.9, 6.9))) +
                                      "region r union 4 a b c d\n", HISTORY)


def _in_the_funnel(x):
    return ((x[0] - 3.6) ** 2 + (x[1] - 3.5) ** 2) ** 0.5 < 1.2 + max(0.0, x[2] - 2.0) * 2.7 / 4.9


CASES = {"Inside": dict(_inside()), "Outside": dict(_outside()), "Open": dict(_open()), "Moving": dict(_moving()),
         "Trees": dict(_trees())}


class RegionsTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        fixes = f"{case.region}{case.before_move}{NVE}{case.extra}fix w {case.group} wall/gran/region {case.law} region r contacts"
        text = scenes.scene(fixes, columns=case.columns, pair=case.pair, **case.scene)
        stock = self.run_lammps(text, files)
        self.assertTrue(any(a[:, n.index("f_w[1]")].any() for n, a in stock.dump().values()), "nothing touches")
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            ours = self.run_lammps(text, files, gpudem=precision)
            self.assertResident(ours)
            if case.host:
                self.assertIn(case.host, ours.everything)
            else:
                self.assertNotIn("wall/gran/region) on the host", ours.everything)
            disturbed = compare_dumps(self, stock.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)
            compare_thermo(self, stock.thermo(), ours.thermo(), tolerance, what=precision, disturbed=disturbed)


HALF = 100


class Restart(StylesTest):
    """Contacts with several faces and the motion of the region travel in restart files of either code."""
    # not time, which a restart file does not carry
    region = ("variable dx equal 0.04*sin(0.03*step)\nvariable dz equal -0.00005*step\n"
              "region a cylinder y 3.6 3.5 3.9 0.3 6.9 units box move v_dx NULL v_dz\n"
              "region b plane 0.4 0.2 0.3 1.0 0.3 0.5 units box\n")
    fixes = NVE + DOWN + f"fix w all wall/gran/region {HISTORY} region a\nfix v all wall/gran/region {GRANULAR} region b\n"

    def first_half(self, gpudem):
        text = (scenes.head("f f f") + scenes.middle() + self.region + self.fixes + scenes.output(HALF) +
                f"restart {HALF} state.*\nrun {HALF}\nwrite_restart state.written\n")
        return self.run_lammps(text, [("cloud.data", scenes.cloud(**BOXED))], gpudem=gpudem)

    def second_half(self, gpudem, state, steps=HALF):
        text = ("newton off\ncomm_modify vel yes\nread_restart state\n" + scenes.middle() + self.region + self.fixes +
                scenes.output(50) + f"run {steps}\n")
        run = self.run_lammps(text, [("state", state.read_bytes())], gpudem=gpudem)
        if gpudem:
            self.assertResident(run)
            self.assertNotIn("wall/gran/region) on the host", run.everything)
        return run

    def check(self, writer, reader, file="state.100"):
        stock = self.second_half(None, self.first_half(None).path(file))
        ours = self.second_half(reader, self.first_half(writer).path(file))
        self.assertIn("Resetting global fix info from restart file", ours.everything)
        self.assertIn("Resetting peratom fix info from restart file", ours.everything)
        self.assertNotIn("resetting its motion", ours.everything)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)

    def test_stock_to_gpudem(self):
        self.check(None, "double")

    def test_gpudem_to_stock(self):
        self.check("double", None)

    def test_gpudem_to_gpudem(self):
        self.check("double", "double")

    def test_write_restart_command(self):
        self.check("double", None, file="state.written")
        self.check(None, "double", file="state.written")

    def test_springs_are_carried(self):
        """Without what the walls keep the run goes another way."""
        state = self.first_half("double").path("state.100")
        kept = self.second_half("double", state).dump()
        renamed = self.fixes.replace("fix w ", "fix other ").replace("fix v ", "fix another ")
        self.fixes = renamed
        lost = self.second_half("double", state).dump()
        names, a = kept[2 * HALF]
        off = np.abs(a - lost[2 * HALF][1])[:, names.index("vx")].max() / np.abs(a[:, names.index("vx")]).max()
        self.assertGreater(off, 1e-4)

    def test_runs_in_pieces(self):
        """The region goes on from where it was, in the next run and without a setup."""
        text = (scenes.head("f f f") + scenes.middle() + self.region + self.fixes + scenes.output(50) +
                "run 50\nrun 50 pre no\nrun 100\n")
        files = [("cloud.data", scenes.cloud(**BOXED))]
        stock, ours = self.run_lammps(text, files), self.run_lammps(text, files, gpudem="double")
        self.assertResident(ours)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)

    def test_from_the_device_to_the_host_and_back(self):
        """A fix that acts on forces on the host takes the wall behind it along."""
        text = (scenes.head("f f f") + scenes.middle() + self.region + NVE + "fix push all addforce 0.1 0.0 0.0\n" +
                self.fixes.replace(NVE, "") + scenes.output(50) + "run 60\nunfix push\nrun 60\n"
                "fix push all addforce 0.1 0.0 0.0\nrun 60\n")
        files = [("cloud.data", scenes.cloud(**BOXED))]
        stock, ours = self.run_lammps(text, files), self.run_lammps(text, files, gpudem="double")
        self.assertIn("wall/gran/region) on the host", ours.everything)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)


class Examples(StylesTest):
    """LAMMPS' own examples of granular regions, from its sources. They are chaotic. Fewer steps, and where grains would
    not have arrived by then more gravity."""

    def each(self, folder, name, changes):
        """Stock's run, and those of both precisions. changes: (pattern, replacement) of the text."""
        text = source_file("examples", folder, name).read_text()
        for pattern, replacement in changes:
            text, found = re.subn(pattern, replacement, text)
            self.assertTrue(found, pattern)
        text += "\nwrite_dump all custom dump.out id x y z radius mass vx vy vz modify sort id format float %.17g\n"
        stock = self.run_lammps(text, timeout=900)
        for precision in ("double", "mixed"):
            ours = self.run_lammps(text, gpudem=precision, threads=2, timeout=900)
            self.assertResident(ours)
            self.assertNotIn("wall/gran/region) on the host", ours.everything)
            yield precision, stock, ours

    def heap(self, run):
        """Mean height over the lowest grain, and kinetic energy."""
        names, a = list(run.dump().values())[-1]
        z, mass, v = a[:, names.index("z")], a[:, names.index("mass")], a[:, [names.index(c) for c in ("vx", "vy", "vz")]]
        return z.mean() - z.min(), 0.5 * (mass[:, None] * v * v).sum()

    def check(self, *arguments):
        for precision, stock, ours in self.each(*arguments):
            self.assertEqual(len(stock.thermo()), len(ours.thermo()))
            for (columns, a), (_, b) in zip(stock.thermo(), ours.thermo()):
                atoms = columns.index("Atoms")
                self.assertLessEqual(np.abs(a[:, atoms] - b[:, atoms]).max(), BULK_LOST * a[:, atoms].max(), precision)
            (height, energy), (height2, energy2) = self.heap(stock), self.heap(ours)
            _say(f"{self.id()} {precision}", {"height": height2 / height - 1, "energy": energy2 / energy - 1})
            self.assertLessEqual(abs(height2 - height), BULK_HEIGHT * max(height, scenes.DIAMETER), precision)
            self.assertLessEqual(abs(energy2 - energy), BULK_ENERGY_BAND * energy, precision)

    def test_funnel(self):
        """Poured into a cone, settled, and let out below: a union of open shapes, redefined between runs."""
        self.check("granregion", "in.granregion.funnel",
                   ((r"(?m)^run\s+\d+", "run 6000"), ("gravity equal 1.0", "gravity equal 100.0"), ("logfreq equal 1000", "logfreq equal 500")))

    def test_mixer(self):
        """Two rotating blades in a cylinder."""
        self.check("granregion", "in.granregion.mixer",
                   ((r"(?m)^run\s+\d+", "run 6000"), ("gravity equal 1.0", "gravity equal 50.0"), ("logfreq equal 1000", "logfreq equal 500")))

    def test_drum(self):
        """It pours two kinds of grains into each other, and what those do at once is a matter of pair style granular, where
        stock is wrong: here it is asked whether the drum and its lids hold what is in them.
        """
        shorter = ((r"(?m)^run\s+\d+", "run 1500"), ("gravity 10 vector", "gravity 40 vector"))
        for _, stock, run in self.each("granular", "in.pour.drum", shorter):
            names, a = list(run.dump().values())[-1]
            x, y, z, radius = (a[:, names.index(c)] for c in ("x", "y", "z", "radius"))
            self.assertGreater(len(a), 1000)
            self.assertEqual(run.thermo()[1][1][0, 1], len(a), "no grain is lost")
            out = np.maximum(np.hypot(x - 15.0, y - 15.0) - 15.0, np.maximum(-z, z - 20.0)) + radius
            self.assertGreater((out > 0.0).sum(), 50, "many touch the drum")
            self.assertLess(out.max(), 0.1, "none is deep in it")


make_tests(RegionsTest, CASES, globals())

if __name__ == "__main__":
    unittest.main(verbosity=2)
