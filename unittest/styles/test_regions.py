# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""fix wall/gran/region against stock LAMMPS: every kind of region from both sides, open faces, motion, unions.

The clouds fill a box of 7.2 diameters. Where stock LAMMPS 29 Sep 2021 is wrong (test_region_corrections.py) the cases
here keep away from it.
"""
import unittest
from dataclasses import dataclass, field

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests
from tolerance import DOUBLE, MIXED

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
BOXED = dict(margin=(1.0, 1.0, 1.0))
WITHIN = "0.3 6.9"     # cuts into the outer grains of the cloud


@dataclass
class Case:
    region: str                 # commands; the last region is named r
    law: str = HISTORY
    cloud: dict = field(default_factory=lambda: BOXED)
    pair: str = scenes.HOOKE_HISTORY
    steps: int = 200
    extra: str = ""
    moving: bool = False
    scene: dict = field(default_factory=lambda: dict(boundary="f f f"))


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
    "cone_y": "cone y 3.6 3.5 1.8 0.4 2.0 5.0",
    "cone_z": "cone z 3.6 3.5 0.8 1.8 2.0 5.0",
}


def inside(name, law):
    return Case(f"region r {HOLDING[name]} side in units box\n", law, extra=DOWN)


def hollowed(shape, outside=0.55):
    """Cloud without the grains whose centres are in a standing shape, or less than half a diameter from it."""
    def edit(atoms, velocities):
        words = shape.split()
        kind, n = words[0], [float(w) for w in words[1:] if w not in "xyz"]
        axis = {"x": 0, "y": 1, "z": 2}.get(words[1], 0)
        def free(x):
            if kind in ("block", "prism"):
                lo, hi = n[0:6:2], n[1:6:2]
                wide = outside + (0.8 if kind == "prism" else 0.0)
                return any(not lo[d] - wide < x[d] < hi[d] + wide for d in range(3))
            if kind == "sphere":
                return sum((x[d] - n[d]) ** 2 for d in range(3)) > (n[3] + outside) ** 2
            if kind == "plane":
                return sum((x[d] - n[d]) * n[3 + d] for d in range(3)) < -outside * 1.2
            across = [d for d in range(3) if d != axis]
            rho2 = sum((x[d] - n[k]) ** 2 for k, d in enumerate(across))
            radius = max(n[2:-2])
            return rho2 > (radius + outside) ** 2 or not n[-2] - outside < x[axis] < n[-1] + outside
        keep = [k for k, a in enumerate(atoms) if free(a[4:7])]
        atoms[:] = [[i + 1] + atoms[k][1:] for i, k in enumerate(keep)]
        velocities[:] = [[i + 1] + velocities[k][1:] for i, k in enumerate(keep)]
    return edit


def _inside():
    for name in HOLDING:
        yield f"hooke_{name}", inside(name, HOOKE)
        yield f"hertz_{name}", inside(name, HERTZ)
    for name in ("block", "cylinder_y", "sphere", "cone_x"):
        yield f"history_{name}", inside(name, HISTORY)
        yield f"granular_{name}", inside(name, GRANULAR)
    yield "limited_block", inside("block", LIMITED)


CASES = {"Inside": dict(_inside())}


class RegionsTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        fixes = f"{case.region}{NVE}{case.extra}fix w all wall/gran/region {case.law} region r contacts"
        text = scenes.scene(fixes, columns=CONTACTS, pair=case.pair, steps=case.steps, **case.scene)
        stock = self.run_lammps(text, files)
        self.assertTrue(any(a[:, n.index("f_w[1]")].any() for n, a in stock.dump().values()), "nothing touches")
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            ours = self.run_lammps(text, files, gpudem=precision)
            self.assertResident(ours)
            self.assertNotIn("wall/gran/region) on the host", ours.everything)
            disturbed = compare_dumps(self, stock.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)
            compare_thermo(self, stock.thermo(), ours.thermo(), tolerance, what=precision, disturbed=disturbed)


make_tests(RegionsTest, CASES, globals())

if __name__ == "__main__":
    unittest.main(verbosity=2)
