# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Resident runs on several ranks: the answer of one, whatever the ranks, their sub-domains and what happens on the way."""
import os
import re
import unittest
from dataclasses import dataclass, field

import numpy as np

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests
from tolerance import DOUBLE, DOUBLE_LONG, MIXED, ROUND_OFF

FULL = bool(os.environ.get("GPUDEM_LONG"))
RANKS = (2, 3, 4, 5, 7, 8, 16) if FULL else (3, 8)
NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 30.0 vector 0.3 0 -1\n"
WALLS = "fix floor all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 zplane 0.0 NULL\n"
SLICES = "fix even all balance/slice {} 1.0\n"
EMPTY_ABOVE = dict(margin=(0.0, 0.0, 0.3), keep=lambda x: x[0] + x[2] < 8.0)
CHUTE = dict(cells=(12, 8, 5), frozen_layer=True, margin=(0, 0, 2.0))


def half_as_large(atoms, velocities):
    for atom in atoms[::2]:
        atom[2] *= 0.5


def an_eighth_as_large(atoms, velocities):
    for atom in atoms[5:]:
        atom[2] *= 0.15


@dataclass
class Case:
    cloud: dict = field(default_factory=lambda: EMPTY_ABOVE)
    fixes: str = NVE + DOWN + WALLS
    scene: dict = field(default_factory=lambda: dict(boundary="p p f"))
    before: str = ""
    ranks: tuple = RANKS
    steps: int = 100
    thermo: str = scenes.THERMO
    processors: str = ""


class RanksTest(StylesTest):
    def resident(self, text, files, ranks, precision="double", **more):
        run = self.run_lammps(text, files, gpudem=precision, ranks=ranks,
                              name=f"{self.runs + 1:02d}-{ranks}-ranks-{precision}", **more)
        self.assertResident(run)
        return run


class SameAnswerBase(RanksTest):
    """On each number of ranks against one rank, and that against stock LAMMPS."""

    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        text = scenes.scene(case.fixes, steps=case.steps, before=case.before, thermo=case.thermo, **case.scene)
        one = self.resident(text, files, 1)
        if case.processors:
            text = "processors " + case.processors + "\n" + text
        for ranks in case.ranks if FULL else case.ranks[-2:]:
            many = self.resident(text, files, ranks)
            compare_dumps(self, one.dump(), many.dump(), DOUBLE, scenes.DIAMETER, what=f"{ranks} ranks")
            compare_thermo(self, one.thermo(), many.thermo(), DOUBLE, what=f"{ranks} ranks")


OPEN = dict(boundary="s s s")
GROUPS = {
    "SameAnswer": {
        "hooke_history": Case(thermo=scenes.THERMO + " press temp"),
        "hooke": Case(scene=dict(boundary="p p f", pair=scenes.HOOKE), ranks=(4, 7)),
        "hertz_history": Case(scene=dict(boundary="p p f", pair=scenes.HERTZ_HISTORY), ranks=(2, 5)),
        "granular": Case(scene=dict(boundary="p p f", pair="granular", coeff=(
            "* * hertz/material 2.0e5 20.0 0.3 tangential mindlin NULL 0.5 0.4 rolling sds 500 20 0.3 twisting marshall",)),
            ranks=(4, 7)),
        "periodic": Case(cloud={}, fixes=NVE, scene={}, ranks=(2, 3, 7, 8)),
        "shrink_wrapped": Case(fixes=NVE, scene=OPEN, ranks=(2, 5, 8)),
        "two_dimensions": Case(cloud=dict(cells=(16, 16, 1), dimension=2, keep=lambda x: x[0] + x[1] < 16.0),
                               fixes=NVE + "fix flat all enforce2d\n", scene=dict(dimension=2, boundary="p p p"), ranks=(2, 5, 8)),
        "chute": Case(cloud=CHUTE, ranks=(2, 7), fixes="group base type 2\ngroup active subtract all base\n"
                      "neigh_modify exclude group base base\nfix move active nve/sphere\n"
                      "fix down all gravity 30.0 chute 26.0\nfix ice base freeze\n",
                      thermo=scenes.THERMO + " f_ice[1] f_ice[2] f_ice[3]"),
        "drum": Case(cloud=dict(margin=(0.05, 0.05, 0.8)), scene=dict(boundary="f f f"), ranks=(3, 8),
                     fixes=NVE + DOWN + "variable turn equal 2.0*dt*step\n"
                     "region can cylinder y 3.6 3.6 6.0 0.05 7.15 side in units box rotate v_turn 3.6 0 3.6 0 1 0\n"
                     "fix can all wall/gran/region hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 region can\n"),
        "two_sizes": Case(cloud=dict(cells=(9, 9, 7), margin=(0, 0, 1.0), edit=half_as_large), ranks=(4, 5)),
        "few_large_among_small": Case(cloud=dict(cells=(9, 9, 7), margin=(0, 0, 1.0), edit=an_eighth_as_large), ranks=(4, 5),
                                      before="gpudem neighbor multigrid\n"),
        "exclusions": Case(fixes="neigh_modify exclude type 1 2\n" + NVE + DOWN + WALLS, ranks=(5,)),
        "gravity_energy": Case(thermo=scenes.THERMO + " f_down", ranks=(5,)),
        "moving_grains": Case(fixes="group shaker id <= 20\ngroup free subtract all shaker\nfix shake shaker move wiggle 0.1 0 0 0.05\n"
                              "fix move free nve/sphere\n" + DOWN + WALLS, ranks=(3, 5)),
        "common_motion": Case(cloud=dict(edit=lambda atoms, velocities: [v.__setitem__(1, v[1] + 60.0) for v in velocities]),
                              fixes=NVE, scene=dict(boundary="p p p"), ranks=(3, 8)),
        "uneven_grid": Case(processors="1 1 *", ranks=(7, 8)),
    },
    "Layouts": {
        "even_slices_stay": Case(fixes=NVE + DOWN + WALLS + "fix even all balance/slice 20 1.3\n", ranks=(4,),
                                 steps=200),
        "tiled": Case(fixes=NVE + DOWN + WALLS + "comm_style tiled\nbalance 1.0 rcb\n", ranks=(3, 7)),
        "slices": Case(fixes=NVE + DOWN + WALLS + SLICES.format(20), ranks=(5, 8)),
        "slices_by_time": Case(fixes=NVE + DOWN + WALLS + "fix even all balance/slice 20 1.0 weight time 1.0\n", ranks=(4,)),
        "slices_at_the_start": Case(fixes=NVE + DOWN + WALLS + SLICES.format(0), ranks=(5,)),
        "stock_balance": Case(fixes=NVE + DOWN + WALLS + "fix even all balance 20 1.0 shift xyz 5 1.0\n", ranks=(4, 8)),
        "moved_slices_in_an_open_box": Case(fixes=NVE + SLICES.format(10), scene=OPEN, ranks=(3, 8),
                                             thermo="step atoms ke c_spin"),  # the box is fitted when slices are checked
        "thin_slices": Case(cloud=dict(cells=(8, 8, 8), margin=(0.0, 0.0, 0.3), keep=lambda x: x[0] < 2.6), ranks=(7, 8),
                            fixes=NVE + DOWN + WALLS + "fix even all balance/slice 20 1.0 levels 1 axes x width 0.2\n"),
        "ranks_without_grains": Case(cloud=dict(cells=(8, 8, 8), margin=(0.0, 0.0, 0.3), keep=lambda x: x[0] < 2.6),
                                     processors="* 1 1", ranks=(7, 8)),
    },
    "Hosts": {
        "force_fix": Case(fixes=NVE + DOWN + WALLS + "fix push all addforce 0.5 0 0\n", ranks=(3, 5)),
        "neighbour_lists": Case(thermo=scenes.THERMO + " c_most", fixes="compute touch all contact/atom\ncompute most all reduce sum c_touch\n"
                                + NVE + DOWN + WALLS, ranks=(3, 5)),
        "end_of_step_fix": Case(fixes=NVE + DOWN + WALLS + "fix slow all momentum 10 linear 1 1 0\n", ranks=(3, 5)),
        "variable_gravity": Case(fixes=NVE + "variable g equal 20+5*sin(step*0.1)\nfix down all gravity v_g vector 0 0 -1\n" + WALLS,
                                 ranks=(4,)),
        "dynamic_group": Case(fixes=NVE + "region low block INF INF INF INF INF 3 units box\ngroup low dynamic all region low every 10\n"
                              "fix pull low gravity 30.0 vector 0.3 0 -1\n" + WALLS, ranks=(3, 5)),
        "dynamic_group_and_slices": Case(fixes=NVE + "region low block INF INF INF INF INF 3 units box\n"
                                         "group low dynamic all region low every 10\nfix pull low gravity 30.0 vector 0.3 0 -1\n"
                                         + WALLS + SLICES.format(5), ranks=(3, 8)),
    },
}
make_tests(SameAnswerBase, GROUPS, globals())


class Commands(RanksTest):
    FILES = [("cloud.data", scenes.cloud(**EMPTY_ABOVE))]

    def compare(self, text, files, ranks=(2, 5, 8) if FULL else (5,), tolerance=DOUBLE):
        one = self.resident(text, files, 1)
        for n in ranks:
            many = self.resident(text, files, n)
            compare_dumps(self, one.dump(), many.dump(), tolerance, scenes.DIAMETER, what=f"{n} ranks")
            compare_thermo(self, one.thermo(), many.thermo(), tolerance, what=f"{n} ranks")
        return one

    def test_against_stock(self):
        """Stock LAMMPS on as many ranks."""
        text = scenes.scene(NVE + DOWN + WALLS, boundary="p p f", steps=100)
        stock = self.run_lammps(text, self.FILES, ranks=4)
        ours = self.resident(text, self.FILES, 4)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)

    def test_same_bits_again(self):
        text = scenes.scene(NVE + DOWN + WALLS + SLICES.format(20), boundary="p p f", steps=200)
        for precision in ("double", "mixed"):
            one, two = (self.resident(text, self.FILES, 5, precision).path("dump.out").read_bytes() for _ in range(2))
            self.assertEqual(one, two)

    def test_mixed(self):
        text = scenes.scene(NVE + DOWN + WALLS + SLICES.format(20), boundary="p p f", steps=100)
        one = self.resident(text, self.FILES, 1)
        ours = self.resident(text, self.FILES, 5, precision="mixed")
        compare_dumps(self, one.dump(), ours.dump(), MIXED, scenes.DIAMETER)

    def test_runs_in_turn(self):
        """run pre no, a stock command, and a loop of LAMMPS' own between resident runs."""
        after = ("run 40\nrun 30 pre no\nset group all image 0 0 0\nrun 30\nbalance/slice 1.0\nrun 30\n")
        self.compare(scenes.scene(NVE + DOWN + WALLS, boundary="p p f", after=after), self.FILES)

    def test_delete_atoms(self):
        after = "run 50\nregion hole block 2 5 INF INF 0 3 units box\ndelete_atoms region hole compress no\nrun 50\n"
        self.compare(scenes.scene(NVE + DOWN + WALLS, boundary="p p f", after=after), self.FILES)

    def test_restart_on_other_numbers_of_ranks(self):
        """Written on P ranks, read on Q: the same continuation, springs included; stock LAMMPS reads it, too."""
        first = scenes.scene(NVE + DOWN + WALLS, boundary="p p f", after="restart 50 state.*\nrun 100\n")
        then = ("newton off\ncomm_modify vel yes\nread_restart state\n" + scenes.middle() + NVE + DOWN + WALLS +
                scenes.output(50) + "run 100\n")
        reference = None
        for writers, readers in ((1, 1), (5, 3)) + (((1, 4), (4, 1), (2, 7)) if FULL else ()):
            state = self.resident(first, self.FILES, writers).path("state.50").read_bytes()
            ours = self.resident(then, [("state", state)], readers).dump()
            reference = reference or ours
            compare_dumps(self, reference, ours, DOUBLE_LONG, scenes.DIAMETER, what=f"{writers} to {readers} ranks")
        stock = self.run_lammps(then, [("state", state)], ranks=2)
        compare_dumps(self, reference, stock.dump(), DOUBLE_LONG, scenes.DIAMETER, what="stock")

    def test_pour(self):
        """Insertion: the same grains at the same places, and none is lost."""
        text = ("units lj\natom_style sphere\nboundary p p f\nnewton off\ncomm_modify vel yes\n"
                "region box block 0 8 0 8 0 16 units box\ncreate_box 1 box\n" + scenes.middle(timestep=1e-3) +
                "region top cylinder z 4 4 3.5 10 15 units box\n" + NVE +
                "fix down all gravity 1.0 vector 0 0 -1\n" + WALLS +
                "fix rain all pour 300 1 4711 region top diam range 0.7 1.0 vol 0.3 50 dens 1.0 1.0\n" + SLICES.format(100) +
                scenes.output(200) + "thermo_modify lost error\nrun 4000\n")
        one = self.resident(text, (), 1)
        for ranks in (2, 5, 8) if FULL else (5,):
            many = self.resident(text, (), ranks)
            for (names, a), (_, b) in zip(one.thermo(), many.thermo()):
                np.testing.assert_array_equal(a[:, names.index("Atoms")], b[:, names.index("Atoms")])
            early = [s for s in one.dump() if s <= 1000]
            compare_dumps(self, {s: one.dump()[s] for s in early}, {s: many.dump()[s] for s in early}, DOUBLE,
                          scenes.DIAMETER, what=f"{ranks} ranks")
        self.assertGreater(one.thermo()[-1][1][-1, 1], 150)

    def test_lost_grains(self):
        """Grains that leave an open box are lost, and those inside are as on one rank. When they are taken out depends on
        the rebuilds, which one rank on a GPU makes rarer."""
        text = scenes.scene(NVE, boundary="p p f", steps=400)
        files = [("cloud.data", scenes.cloud(margin=(0.0, 0.0, 0.1), speed=12.0))]
        box = (-0.1, 8 * 0.9 + 0.1)

        def inside(run):
            return {step: (names, rows[(rows[:, names.index("zu")] > box[0]) & (rows[:, names.index("zu")] < box[1])])
                    for step, (names, rows) in run.dump().items()}
        one = self.resident(text, files, 1)
        for ranks in (2, 5, 8) if FULL else (5,):
            many = self.resident(text, files, ranks)
            compare_dumps(self, inside(one), inside(many), DOUBLE, scenes.DIAMETER, what=f"{ranks} ranks")
            names, rows = many.thermo()[-1]
            self.assertLess(rows[-1, names.index("Atoms")], rows[0, names.index("Atoms")] - 2)

    def test_momentum_is_kept(self):
        """Nothing acts from outside; forces across borders are opposite to the last bit."""
        text = scenes.scene(NVE + "variable mx equal mass(all)*vcm(all,x)\nvariable my equal mass(all)*vcm(all,y)\n" + SLICES.format(10),
                            thermo="step atoms v_mx v_my", steps=200)
        run = self.resident(text, [("cloud.data", scenes.cloud())], 5)
        names, rows = run.thermo()[-1]
        for column in ("v_mx", "v_my"):
            p = rows[:, names.index(column)]
            self.assertLessEqual(np.abs(p - p[0]).max(), ROUND_OFF.thermo * 512 * 3.0)   # grains, their fastest


    @unittest.skipUnless(FULL, "GPUDEM_LONG")
    def test_a_million_hand_overs(self):
        """Slices that sweep through a dense box at every step: no grain is lost, and no spring."""
        sweep = ("variable w atom 1.0+1000*(abs(x/lx-0.5-0.4*sin(step*1.3))<0.1)\nvariable mx equal mass(all)*vcm(all,x)\n"
                 "variable my equal mass(all)*vcm(all,y)\n")
        text = scenes.scene(NVE + "fix even all balance/slice 1 1.0 weight var w axes x y\nvariable sum equal f_even[4]\n"
                            "fix total all vector 1 v_sum\nvariable total equal sum(f_total)\nthermo_modify lost error\n",
                            before=sweep, steps=800, every=800, thermo="step atoms v_mx v_my", boundary="p p p")
        run = self.resident(text + "print \"hand-overs ${total}\"\n", [("cloud.data", scenes.cloud(cells=(16, 16, 16)))], 6)
        self.assertGreater(float(re.findall(r"^hand-overs ([0-9.e+]+)", run.log, re.M)[-1]), 1e6)
        names, rows = run.thermo()[-1]
        np.testing.assert_array_equal(rows[:, names.index("Atoms")], 4096)
        for column in ("v_mx", "v_my"):
            p = rows[:, names.index(column)]
            self.assertLessEqual(np.abs(p - p[0]).max(), ROUND_OFF.thermo * 4096 * 3.0)   # grains, their fastest


class Messages(RanksTest):
    FILES = [("cloud.data", scenes.cloud(**EMPTY_ABOVE))]

    def test_what_the_log_says(self):
        run = self.resident(scenes.scene(NVE + DOWN + WALLS, boundary="p p f", steps=1), self.FILES, 3)
        self.assertRegex(run.everything, "  ranks     : 3(, .*GPU.*)?; ghosts by MPI through host memory")
        one = self.resident(scenes.scene(NVE + DOWN + WALLS, boundary="p p f", steps=1), self.FILES, 1)
        self.assertNotIn("  ranks  ", one.everything)

    def test_weights_by_neighbours_use_the_stock_loop(self):
        for fix, why in (("balance/slice 10 1.0 weight contact 0.5", "weighs particles by neighbours"),
                         ("balance 10 1.0 shift x 5 1.0 weight group 1 all 2.0", "possible with fix balance/slice only")):
            text = scenes.scene(NVE + DOWN + WALLS + "fix even all " + fix + "\n", boundary="p p f", steps=20)
            run = self.run_lammps(text, self.FILES, gpudem="double", ranks=2)
            self.assertIn("not resident, LAMMPS' own loop runs: fix even", run.everything)
            self.assertIn(why, run.everything)

    def test_an_unstable_rank_ends_the_run(self):
        """With the name of the atom, and without a hang."""
        text = scenes.scene(NVE + DOWN + WALLS + "group one id 5\nvelocity one set 1e9 0 0\n", boundary="p p f")
        run = self.run_lammps(text, self.FILES, gpudem="double", ranks=4, succeed=False, timeout=60)
        self.assertNotEqual(run.status, 0)
        self.assertRegex(run.everything, r"ERROR on proc \d+: GPUDEM: atom \d+ at step \d+")


if __name__ == "__main__":
    unittest.main(verbosity=2)
