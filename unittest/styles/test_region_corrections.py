# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Where fix wall/gran/region and the regions of LAMMPS 29 Sep 2021 are wrong.

Each scene is given to GPUDEM as it is and to stock LAMMPS in other words for which stock is right; that stock is wrong
in the first words is asserted too. One grain, so that round-off has nothing to grow on.
"""
import unittest

import numpy as np

import scenes
from compare import compare_dumps
from lammps import StylesTest
from tolerance import DOUBLE, MIXED

HISTORY = "hooke/history 2.0e4 NULL 50.0 20.0 0.5 1"
HERTZ = "hertz/history 2.0e5 NULL 200.0 100.0 0.5 1"


def grain(walls, at, velocity, spin=(0.3, -0.2, 0.1), steps=160, before=""):
    """A sphere of radius 0.5 and mass 1 within walls. Touch must not begin at a whole step, where round-off would decide."""
    speeds = " ".join(f"v{d} {c:.17g}" for d, c in zip("xyz", velocity))
    return ("units lj\natom_style sphere\nboundary f f f\nnewton off\ncomm_modify vel yes\n"
            "region world block -6 6 -6 6 -6 6 units box\ncreate_box 1 world\n"
            f"create_atoms 1 single {at[0]:.17g} {at[1]:.17g} {at[2]:.17g} units box\n"
            f"set group all diameter 1.0 density 1.9098593171027440 {speeds} "
            f"omega {spin[0]:.17g} {spin[1]:.17g} {spin[2]:.17g}\n"
            f"pair_style {scenes.HOOKE_HISTORY}\npair_coeff * *\nneighbor 0.3 bin\ntimestep 1.0e-4\n"
            f"fix move all nve/sphere\n{before}{walls}\n"
            "dump out all custom 10 dump.out id xu yu zu vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz\n"
            f"dump_modify out sort id format float %.17g\nrun {steps}\n")


def region(shape, law=HISTORY, name="r", fix="w"):
    return f"region {name} {shape} units box\nfix {fix} all wall/gran/region {law} region {name}\n"


class Corrections(StylesTest):
    def right(self, ours, stock, stock_fails=True, rtol=1e-3):
        """GPUDEM gives for 'ours' what stock LAMMPS gives for 'stock', and stock gives something else for 'ours'."""
        reference = self.run_lammps(stock).dump()
        self.assertTrue(any(np.abs(a[:, n.index("fx"):]).max() > 1.0 for n, a in reference.values()), "nothing touches")
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            run = self.run_lammps(ours, gpudem=precision)
            self.assertResident(run)
            self.assertNotIn("wall/gran/region) on the host", run.everything)
            compare_dumps(self, reference, run.dump(), tolerance, scenes.DIAMETER, what=precision)
        if not stock_fails:
            return
        run = self.run_lammps(ours, succeed=False)
        if run.status == 0:
            names, last = list(reference.values())[-1]
            wrong = list(run.dump().values())[-1][1]
            off = 0.0 if wrong.shape == last.shape and np.isfinite(wrong).all() else np.inf
            if off == 0.0:
                off = np.abs(wrong - last).max() / np.abs(last).max()
            self.assertGreater(off, rtol, "stock is right now: say so in the page")

    def test_three_faces_keep_their_own_springs(self):
        """Stock takes the spring of another face when three are touched in another order than they are listed."""
        at, v, w = (1.46, 1.4953, 1.4803), (3.0, 3.0, 3.0), (7.0, -5.0, 2.0)
        planes = "".join(region(f"plane {p} {n}", name=f"r{k}", fix=f"w{k}")
                         for k, (p, n) in enumerate((("2 0 0", "-1 0 0"), ("0 2 0", "0 -1 0"), ("0 0 2", "0 0 -1"))))
        self.right(grain(region("block -2 2 -2 2 -2 2"), at, v, w), grain(planes, at, v, w))

    def test_ends_of_a_cone_along_y(self):
        """Stock lets them push along z."""
        at, v = (0.3, -1.4903, 0.1), (1.0, -2.0, 0.5)
        self.right(grain(region("cone y 0 0 3 2 -2 2"), at, v), grain(region("plane 0 -2 0 0 1 0"), at, v))

    def test_cone_from_outside_is_not_hollow(self):
        at, v = (1.4953, 0.0, 0.2), (-2.0, 1.0, 0.0)
        self.right(grain(region("cone z 0 0 1 1 -2 2 side out", HERTZ), at, v),
                   grain(region("cylinder z 0 0 1 -2 2 side out", HERTZ), at, v))

    def test_open_cylinder_is_round_from_outside(self):
        """Stock takes it for flat."""
        at, v = (1.4953, 0.0, 0.2), (-2.0, 1.0, 0.0)
        self.right(grain(region("cylinder z 0 0 1 -2 2 side out open 1", HERTZ), at, v),
                   grain(region("cylinder z 0 0 1 -2 2 side out", HERTZ), at, v))

    def test_union_from_outside(self):
        """Stock overwrites the distance with a flag."""
        at, v = (0.0, 0.1, 1.4953), (1.0, 0.5, -2.0)
        first, second = "block -1 0.2 -1 1 -1 1 units box", "sphere 0.6 0 0.2 0.9 units box"
        ours = f"region a {first}\nregion b {second}\n" + region("union 2 a b side out")
        stock = f"region a {first} side out\nregion b {second} side out\n" + region("intersect 2 a b")
        self.right(grain(ours, at, v), grain(stock, at, v))

    def test_members_of_a_union_drag(self):
        """Stock moves the surfaces of members, but takes the velocity of the union, which is not set."""
        at, v = (0.0, 0.0, -1.4903), (0.0, 0.0, -2.0)
        plane = "plane 0 0 -2 0 0 1 units box move v_dx NULL v_dz"
        moving = "variable dx equal 2.0*time\nvariable dz equal -0.5*time\n"
        for whole in ("union", "intersect"):
            far = "sphere 0 0 -9 1 units box" if whole == "union" else "sphere 0 0 0 9 units box"
            ours = f"{moving}region a {plane}\nregion b {far}\n" + region(f"{whole} 2 a b")
            self.right(grain(ours, at, v), grain(moving + region(plane.replace(" units box", "")), at, v))

    def test_length_of_the_axis(self):
        """Stock multiplies the angular velocity by it."""
        at, v = (1.0, 0.0, -1.4903), (0.0, 0.0, -2.0)
        turn = "variable turn equal 0.001*step\n"
        self.right(grain(turn + region("plane 0 0 -2 0 0 1 rotate v_turn 0 0 0 0 0 3"), at, v),
                   grain(turn + region("plane 0 0 -2 0 0 1 rotate v_turn 0 0 0 0 0 1"), at, v))

    def test_a_run_begins_without_a_jump(self):
        """Stock takes a region that is defined later for one that has just come from its place without displacement."""
        at, v = (0.0, 0.0, -1.4903), (0.5, 0.0, -1.0)
        place = "variable up equal 0.02\nrun 10\n"
        self.right(grain(place + region("plane 0 0 -2 0 0 1 move NULL NULL v_up"), at, v, steps=40),
                   grain(place + region("plane 0 0 -1.98 0 0 1"), at, v, steps=40))

    def test_a_face_without_neighbours(self):
        """The rim of the end of a cylinder whose curved face is open: stock takes a point that was never set."""
        at, v = (1.1, 0.0, 1.4803), (0.0, 0.5, -2.0)
        # nearest to the rim (1, 0, 1), as a block's edge is
        self.right(grain(region("cylinder z 0 0 1 -2 1 side out open 3", "hooke 2.0e4 NULL 50.0 20.0 0.0 1"), at,
                         (0.0, 0.0, -2.0)),
                   grain(region("block -3 1 -3 3 -2 1 side out", "hooke 2.0e4 NULL 50.0 20.0 0.0 1"), at, (0.0, 0.0, -2.0)))

    def test_necks_reach_beyond_touch(self):
        """Adhesion at a region is that at a plane of fix wall/gran; stock ends the contact early at both."""
        law = "granular jkr 2.0e5 5.0 0.3 30.0 tangential mindlin_rescale/force NULL 0.5 0.4 rolling sds 1.0e4 30.0 0.2"
        at, v, w = (0.0, 0.0, -1.499), (0.2, 0.0, -1.0), (0.0, 3.0, 1.0)
        box = region("block -5 5 -5 5 -2 5", law)
        for precision in ("double", "mixed"):
            ours = self.run_lammps(grain(box, at, v, w, 600), gpudem=precision)
            plane = self.run_lammps(grain(f"fix w all wall/gran {law} zplane -2 NULL", at, v, w, 600), gpudem=precision)
            self.assertResident(ours)
            tolerance = DOUBLE if precision == "double" else MIXED
            compare_dumps(self, plane.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)
            names, _ = ours.dump()[0]
            z, fz = names.index("zu"), names.index("fz")
            beyond = [a[0, fz] for _, a in ours.dump().values() if a[0, z] > -1.5 and a[0, fz] != 0.0]
            self.assertGreater(len(beyond), 2, "a neck holds the grain for a while after touch")
            self.assertTrue(all(f < 0.0 for f in beyond), "and pulls")


if __name__ == "__main__":
    unittest.main(verbosity=2)
