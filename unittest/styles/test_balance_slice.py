# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""fix and command balance/slice under stock styles: any number of ranks gives the answer of one, and even loads."""
import os
import re
import unittest
from dataclasses import dataclass, field

import numpy as np

import scenes
from compare import _say, compare_dumps, compare_thermo
from lammps import GPUDEM, StylesTest, make_tests
from tolerance import DOUBLE, DOUBLE_LONG, PARTICLE_SHARE, SLICE_IMBALANCE

FULL = bool(os.environ.get("GPUDEM_LONG"))
RANKS = (2, 3, 4, 5, 7, 8) if FULL else (3, 7)
NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 30.0 vector 0.3 0 -1\n"
WALLS = "fix floor all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 zplane 0.0 NULL\n"
EVEN = "fix even all balance/slice {every} {threshold} {keywords}\n"
STEPS = 800   # with a million migrations
EMPTY_ABOVE = dict(margin=(0.0, 0.0, 0.3), keep=lambda x: x[0] + x[2] < 8.0)


def even(keywords="", every=20, threshold=1.0):
    return EVEN.format(every=every, threshold=threshold, keywords=keywords)


def half_as_large(atoms, velocities):
    for atom in atoms[::2]:
        atom[2] *= 0.5


class SliceTest(StylesTest):
    def slices(self, text, files, ranks, **more):
        """Stock styles and loop, in the executable that knows balance/slice."""
        return self.run_lammps(text, files, ranks=ranks, executable=GPUDEM, arguments=[], name=f"{self.runs + 1:02d}-{ranks}-ranks",
                               **more)

    def counted(self, run, step, ranks, name="dump.out"):
        """Largest number of grains on a rank over the mean, and how many grains there are."""
        names, a = run.dump(name)[step]
        count = np.bincount(a[:, names.index("proc")].astype(int), minlength=ranks)
        return count.max() * ranks / len(a), len(a)


@dataclass
class Case:
    cloud: dict = field(default_factory=lambda: EMPTY_ABOVE)
    fixes: str = NVE + DOWN + WALLS
    keywords: str = ""
    scene: dict = field(default_factory=lambda: dict(boundary="p p f"))
    before: str = ""
    ranks: tuple = RANKS
    every: int = 20
    thermo: str = ""


class SliceBase(SliceTest):
    """100 steps on each number of ranks against one rank without the fix."""

    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]

        def text(balance):
            return scenes.scene(case.fixes + balance, steps=100, before=case.before, thermo=scenes.THERMO + case.thermo,
                                **case.scene)
        # one rank meets the fix too: it reneighbours at given steps, at which a shrink-wrapped box is fitted
        reference = self.slices(text(even(case.keywords, case.every)), files, 1)
        for ranks in case.ranks if FULL else case.ranks[-1:]:
            ours = self.slices(text(even(case.keywords, case.every) + "variable load equal f_even\n"), files, ranks)
            compare_dumps(self, reference.dump(), ours.dump(), DOUBLE, scenes.DIAMETER, what=f"{ranks} ranks")
            compare_thermo(self, reference.thermo(), ours.thermo(), DOUBLE, what=f"{ranks} ranks")


OPEN = dict(boundary="s s s")
GROUPS = {
    "SameAnswer": {
        "hooke_history": Case(ranks=(*RANKS, 16)),
        "hooke": Case(scene=dict(boundary="p p f", pair=scenes.HOOKE), ranks=(3, 8)),
        "hertz_history": Case(scene=dict(boundary="p p f", pair=scenes.HERTZ_HISTORY), ranks=(2, 5)),
        "granular": Case(scene=dict(boundary="p p f", pair="granular", coeff=(
            "* * hertz/material 2.0e5 20.0 0.3 tangential mindlin NULL 0.5 0.4",)), ranks=(4, 7)),
        "periodic": Case(cloud={}, fixes=NVE, scene={}, ranks=(2, 3, 7, 8)),
        "shrink_wrapped": Case(fixes=NVE, scene=OPEN, ranks=(2, 5, 8)),
        "two_dimensions": Case(cloud=dict(cells=(16, 16, 1), dimension=2, keep=lambda x: x[0] + x[1] < 16.0),
                               fixes=NVE + "fix flat all enforce2d\n", scene=dict(dimension=2, boundary="p p p"), ranks=(2, 5, 8)),
        "tilted_box": Case(before="change_box all triclinic\nchange_box all xy final 1.0 yz final 0.0 xz final 0.5 remap\n",
                           cloud={}, fixes=NVE, scene={}, ranks=(3, 4)),
        "every_step": Case(every=1, ranks=(3, 5)),
        "chute": Case(cloud=dict(cells=(12, 8, 5), frozen_layer=True, margin=(0, 0, 2.0)), ranks=(2, 7),
                      fixes="group base type 2\ngroup active subtract all base\nneigh_modify exclude group base base\n"
                      "fix move active nve/sphere\nfix down all gravity 30.0 chute 26.0\nfix ice base freeze\n"),
        "drum": Case(cloud=dict(margin=(0.05, 0.05, 0.8)), scene=dict(boundary="f f f"), ranks=(3, 8),
                     fixes=NVE + DOWN + "variable turn equal 2.0*dt*step\n"
                     "region can cylinder y 3.6 3.6 6.0 0.05 7.15 side in units box rotate v_turn 3.6 0 3.6 0 1 0\n"
                     "fix can all wall/gran/region hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 region can\n"),
        "two_sizes": Case(cloud=dict(cells=(9, 9, 7), margin=(0, 0, 1.0), edit=half_as_large), ranks=(4, 5)),
    },
    "Keywords": {
        "one_level": Case(keywords="levels 1 axes x", ranks=(2, 5)),
        "three_levels": Case(keywords="levels 3", ranks=(7, 8)),
        "given_axes": Case(keywords="axes z x", ranks=(4, 7)),
        "near_moves": Case(keywords="moves near aim 1.0", ranks=(4, 7)),
        "width": Case(keywords="width 1.5", ranks=(4,)),
        "weight_group": Case(keywords="weight group 1 heavy 3.0", before="group heavy type 2\n", ranks=(4,)),
        "weight_contact": Case(keywords="weight contact 0.5", ranks=(4, 5)),
        "weight_neigh": Case(keywords="weight neigh 0.8", ranks=(4,)),
        "weight_time": Case(keywords="weight time 1.0", ranks=(4,)),
        "weight_variable": Case(keywords="weight var w", before="variable w atom 1.0+mass\n", ranks=(4, 5)),
        "weight_store": Case(keywords="weight var w weight store kept",
                             before="variable w atom 1.0+id%3\nfix kept all property/atom d_kept\n", ranks=(3,)),
        "several_weights": Case(keywords="weight count weight contact 0.5 weight group 1 heavy 3.0",
                                before="group heavy type 2\n", ranks=(5,)),
    },
}
make_tests(SliceBase, GROUPS, globals())


class Loads(SliceTest):
    """What the fix says about loads is what a dump of the ranks of grains shows."""
    OUTPUT = ("fix say all print 20 \"even $(f_even) $(f_even[1]) $(f_even[2]) $(f_even[3]) $(f_even[4])\" file even.out screen no\n"
              "dump ranks all custom 20 ranks.out id proc\ndump_modify ranks sort id\n")

    def loads(self, ranks, keywords="", threshold=1.0, cloud=EMPTY_ABOVE, before="", boundary="p p f"):
        text = scenes.scene(NVE + DOWN + WALLS + even(keywords, threshold=threshold) + self.OUTPUT, steps=100, boundary=boundary,
                            before=before)
        run = self.slices(text, [("cloud.data", scenes.cloud(**cloud))], ranks)
        rows = [[float(w) for w in line.split()[1:]] for line in run.path("even.out").read_text().split("\n")[1:] if line]
        return run, np.array(rows)

    def test_said_and_counted(self):
        compared = 0
        for ranks in RANKS:
            run, rows = self.loads(ranks)
            for k, step in enumerate(range(0, 101, 20)):
                counted, grains = self.counted(run, step, ranks, "ranks.out")
                if rows[k][0] == rows[k][3]:
                    continue   # nothing moved: the fix counted grains before those that had left were handed on
                compared += 1
                self.assertLessEqual(abs(rows[k][0] - counted), PARTICLE_SHARE * ranks / grains, f"{ranks} ranks, step {step}")
                self.assertLessEqual(counted, SLICE_IMBALANCE + 2 * ranks / grains)
            _say(self.id(), {f"{ranks} ranks": rows[:, 0].max()})
        self.assertGreater(compared, 3 * len(RANKS))

    def test_nothing_happens_below_the_threshold(self):
        run, rows = self.loads(4, threshold=4.0)
        self.assertTrue((rows[:, 2] == 0).all() and (rows[:, 4] == 0).all(), rows)
        np.testing.assert_array_equal(rows[:, 0], rows[:, 3])

    def test_rank_without_grains(self):
        """Three grains on seven ranks."""
        few = dict(cells=(8, 8, 8), keep=lambda x: max(x) < 1.9 and x[2] < 0.9 and x[1] + x[0] < 2.5)
        run, rows = self.loads(7, cloud=few)
        self.assertEqual(rows[-1][1], 1.0)

    def test_group_weights_are_even(self):
        """Grains of type 2 weigh five times the others."""
        run, rows = self.loads(5, "weight group 1 heavy 5.0", before="group heavy type 2\ndump types all custom 20 types.out id type\n"
                               "dump_modify types sort id\n")
        names, a = run.dump("ranks.out")[80]
        _, types = run.dump("types.out")[80]
        load = np.bincount(a[:, names.index("proc")].astype(int), weights=np.where(types[:, 1] == 2, 5.0, 1.0), minlength=5)
        self.assertLessEqual(load.max() / load.mean(), SLICE_IMBALANCE + 2 * 5 * 5.0 / load.sum())
        self.assertLessEqual(abs(load.max() / load.mean() - rows[4][0]), 2 * 5 * 5.0 / load.sum())

    def test_slabs_follow_the_shape(self):
        """A column is cut into layers; laid down along x, into lengths."""
        text = (scenes.head("p p f") + scenes.middle() + NVE + even("levels 1", every=10) +
                "dump ranks all custom 1 ranks.out id proc x z\nrun 0\n"
                "displace_atoms all ramp x 0 40 z 0 18 units box\ndisplace_atoms all ramp z 0 -16 z 0 18 units box\n"
                "reset_timestep 100\ndump ranks all custom 1 later.out id proc x z\nrun 0\n")
        text = text.replace("reset_timestep", "undump ranks\nreset_timestep")
        column = dict(cells=(4, 4, 20), margin=(20.0, 0.0, 0.5))
        run = self.slices(text, [("cloud.data", scenes.cloud(**column))], 4)
        for name, step, cut in (("ranks.out", 0, "z"), ("later.out", 100, "x")):
            names, a = run.dump(name)[step]
            proc = a[:, names.index("proc")]
            for axis in "xz":
                ranges = sorted((a[proc == r, names.index(axis)].min(), a[proc == r, names.index(axis)].max()) for r in range(4))
                apart = all(ranges[k][1] <= ranges[k + 1][0] for k in range(3))
                self.assertEqual(apart, axis == cut, f"{name}, {axis}: {ranges}")

    def test_against_stock_balancing(self):
        """A heap in a corner of a box: LAMMPS' shift and rcb beside slices, each free to converge."""
        heap = dict(cells=(12, 12, 12), keep=lambda x: x[0] + x[1] + x[2] < 11.0)
        text = (scenes.head("p p f") + scenes.middle() + "{}\ndump ranks all custom 1 ranks.out id proc\nrun 0\n")
        files = [("cloud.data", scenes.cloud(**heap))]
        for ranks in RANKS:
            reached = {}
            for name, command in (("none", ""), ("shift", "balance 1.0 shift xyz 50 1.0"),
                                  ("rcb", "comm_style tiled\nbalance 1.0 rcb"), ("slice", "balance/slice 1.0 levels 2"),
                                  ("slice_3", "balance/slice 1.0 levels 3")):
                run = self.slices(text.format(NVE + command), files, ranks)
                reached[name], grains = self.counted(run, 0, ranks, "ranks.out")
            _say(f"{self.id()} {ranks} ranks", {name: value - 1 for name, value in reached.items()})
            self.assertLessEqual(reached["slice"], min(reached["shift"], reached["rcb"]) + 3 * ranks / grains)
            self.assertLessEqual(reached["slice"], SLICE_IMBALANCE + 2 * ranks / grains)


class Commands(SliceTest):
    def compare(self, text, files, ranks=(2, 5, 8) if FULL else (5,), tolerance=DOUBLE, **more):
        reference = self.slices(text, files, 1, **more)
        for n in ranks:
            ours = self.slices(text, files, n, **more)
            compare_dumps(self, reference.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=f"{n} ranks")
            compare_thermo(self, reference.thermo(), ours.thermo(), tolerance, what=f"{n} ranks")
        return ours

    def test_command_between_runs(self):
        text = scenes.scene(NVE + DOWN + WALLS, boundary="p p f",
                            after="run 50\nbalance/slice 1.0\nrun 50\nbalance/slice 1.0 axes y z weight contact 0.5\nrun 50\n")
        run = self.compare(text, [("cloud.data", scenes.cloud(**EMPTY_ABOVE))])
        self.assertEqual(len(re.findall(r"initial/final imbalance factor", run.log)), 2)

    def test_command_says_what_it_did(self):
        text = scenes.scene(NVE, boundary="p p f", after="balance/slice 1.1 out cuts.txt\nbalance/slice 1.1\nrun 0\n")
        run = self.slices(text, [("cloud.data", scenes.cloud(**EMPTY_ABOVE))], 4)
        self.assertRegex(run.log, r"Balance/slice: 2 parts along [xyz], 4 parts along [xyz], ")
        self.assertIn("switching to comm_style tiled", run.log)
        self.assertIn("is not above 1.1, sub-domains stay", run.log)
        self.assertIn("ITEM: NUMBER OF CUBES\n4\n", run.path("cuts.txt").read_text())

    def test_restart_on_other_numbers_of_ranks(self):
        """Written on P ranks, read on Q: the same continuation, springs included."""
        first = scenes.scene(NVE + DOWN + WALLS + even(), boundary="p p f", after="restart 50 state.*\nrun 100\n")
        then = ("newton off\ncomm_modify vel yes\nread_restart state\n" + scenes.middle() + NVE + DOWN + WALLS + even() +
                scenes.output(50) + "run 100\n")
        files = [("cloud.data", scenes.cloud(**EMPTY_ABOVE))]
        reference = None
        for writers, readers in ((1, 1), (5, 3)) + (((1, 4), (4, 1), (2, 7)) if FULL else ()):
            state = self.slices(first, files, writers).path("state.50").read_bytes()
            ours = self.slices(then, [("state", state)], readers).dump()
            reference = reference or ours
            compare_dumps(self, reference, ours, DOUBLE_LONG, scenes.DIAMETER, what=f"{writers} to {readers} ranks")

    def test_delete_atoms(self):
        text = scenes.scene(NVE + DOWN + WALLS + even(), boundary="p p f",
                            after="run 50\nregion hole block 2 5 INF INF 0 3 units box\ndelete_atoms region hole compress no\nrun 100\n")
        self.compare(text, [("cloud.data", scenes.cloud(**EMPTY_ABOVE))])

    def test_pour(self):
        """Insertion: the same grains at the same places, and none is lost."""
        text = ("units lj\natom_style sphere\nboundary p p f\nnewton off\ncomm_modify vel yes\n"
                "region box block 0 8 0 8 0 16 units box\ncreate_box 1 box\n" + scenes.middle(timestep=1e-3) +
                "region top cylinder z 4 4 3.5 10 15 units box\n" + NVE +
                "fix down all gravity 1.0 vector 0 0 -1\n" + WALLS +
                "fix rain all pour 300 1 4711 region top diam range 0.7 1.0 vol 0.3 50 dens 1.0 1.0\n" + even(every=50) +
                scenes.output(200) + "thermo_modify lost error\n"
                "run 4000\n")
        reference = self.slices(text, (), 1)
        for ranks in (2, 5, 8) if FULL else (5,):
            ours = self.slices(text, (), ranks)
            for (names, a), (_, b) in zip(reference.thermo(), ours.thermo()):
                np.testing.assert_array_equal(a[:, names.index("Atoms")], b[:, names.index("Atoms")])
            early = [s for s in reference.dump() if s <= 1000]
            compare_dumps(self, {s: reference.dump()[s] for s in early}, {s: ours.dump()[s] for s in early}, DOUBLE,
                          scenes.DIAMETER, what=f"{ranks} ranks")
        self.assertGreater(reference.thermo()[-1][1][-1, 1], 150)

    def test_count_is_kept_over_many_migrations(self):
        """Weights that swing through the box at every step, so that most grains change rank: a million times."""
        sweep = "variable w atom 1.0+1000*(abs(x/lx-0.5-0.4*sin(step*1.3))<0.1)\n"
        text = scenes.scene(NVE + even("weight var w axes x y", every=1) + "variable sum equal f_even[4]\n"
                            "fix total all vector 1 v_sum\nvariable total equal sum(f_total)\nthermo_modify lost error\n",
                            before=sweep, steps=STEPS, every=STEPS, boundary="p p p")
        run = self.slices(text + "print \"migrations ${total}\"\n", [("cloud.data", scenes.cloud(cells=(16, 16, 16)))], 6)
        migrations = float(re.findall(r"^migrations ([0-9.e+]+)", run.log, re.M)[-1])
        _say(self.id(), {"migrations": migrations})
        self.assertGreater(migrations, 1e6)
        self.assertEqual(len(run.dump()[STEPS][1]), 4096)

    def test_thin_sub_domains(self):
        """Slabs thinner than a grain, so that ghosts come from ranks that do not touch."""
        text = scenes.scene(NVE + DOWN + WALLS + even("levels 1 axes x width 0.2"), boundary="p p f", steps=100)
        cloud = dict(cells=(8, 8, 8), margin=(0.0, 0.0, 0.3), keep=lambda x: x[0] < 2.6)
        self.compare(text, [("cloud.data", scenes.cloud(**cloud))], ranks=(7, 8))


class Resident(SliceTest):
    def test_one_rank_stays_resident(self):
        files = [("cloud.data", scenes.cloud())]
        stock = self.run_lammps(scenes.scene(steps=100), files)
        ours = self.run_lammps(scenes.scene(NVE + even(every=50), steps=100), files, gpudem="double")
        self.assertResident(ours)
        self.assertIn("fix even (balance/slice), on one rank", ours.everything)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)


class Messages(SliceTest):
    def fails(self, line, *phrases, ranks=1, cloud=None, before="", after="run 1\n"):
        text = scenes.scene(NVE + before + line + "\n", boundary="p p p", after=after)
        run = self.slices(text, [("cloud.data", cloud or scenes.cloud(cells=(5, 5, 5)))], ranks, succeed=False, timeout=60)
        self.assertNotEqual(run.status, 0, run.screen[-1500:])
        for phrase in phrases:
            self.assertIn(phrase, run.everything)

    def fix(self, words, *phrases, **more):
        self.fails("fix even all balance/slice " + words, "ERROR: Fix balance/slice", *phrases, **more)

    def test_arguments(self):
        self.fix("", "needs Nfreq and a threshold")
        self.fix("10", "needs Nfreq and a threshold")
        self.fix("-1 1.1", "Nfreq -1 must be")
        self.fix("10 0.9", "threshold 0.9 is below 1", "such as 1.1")
        self.fix("10 1.1 shift x 5 1.1", "unknown keyword 'shift'", "axes, levels, weight, aim, width, moves, out")
        self.fix("10 1.1 aim", "keyword aim has no value")
        self.fix("10 1.1 aim 0.9", "aim 0.9 must be from 1 to the threshold, 1.1")
        self.fix("10 1.1 aim 1.2", "aim 1.2 must be from 1 to the threshold, 1.1")
        self.fix("10 1.1 width 0", "width 0 must be a distance above 0")
        self.fix("10 1.1 moves far", "moves 'far' must be free or near")
        self.fix("10 1.1 levels 4", "levels 4 must be 1 to 3 in 3 dimensions")
        self.fix("10 1.1 axes w", "axes 'w' must be auto, or axes in the order of the cuts")
        self.fix("10 1.1 axes x x", "axes names x twice")
        self.fix("10 1.1 axes x levels 2", "axes names 1 axes, but levels is 2")

    def test_command(self):
        self.fails("balance/slice", "ERROR: Balance/slice needs a threshold")
        self.fails("balance/slice 0.5", "ERROR: Balance/slice: threshold 0.5 is below 1")
        run = self.slices("balance/slice 1.1\n", (), 1, succeed=False)
        self.assertIn("before there is a box", run.everything)

    def test_weights(self):
        self.fix("10 1.1 weight mass", "unknown weight 'mass'", "count, contact, group, neigh, time, var, store")
        self.fix("10 1.1 weight", "keyword weight has no value")
        self.fix("10 1.1 weight contact", "weight contact ends where the weight of a contact should follow")
        self.fix("10 1.1 weight contact 0", "weight contact 0: the weight of a contact must be above 0")
        self.fix("10 1.1 weight time -1", "weight time -1: the factor must be above 0")
        self.fix("10 1.1 weight neigh 0.0", "weight neigh 0.0: the factor must be above 0")
        self.fix("10 1.1 weight group 0", "weight group 0: at least one group is needed")
        self.fix("10 1.1 weight group 1 stones 2.0", "there is no group 'stones'")
        self.fix("10 1.1 weight group 1 all -2.0", "weight group 1 all -2.0: the weight of the group must be above 0")
        self.fix("10 1.1 weight group 2 all 2.0", "weight group 2 all 2.0 ends where a group-ID should follow")
        self.fix("10 1.1 weight var w", "there is no variable 'w'")
        self.fix("10 1.1 weight var w", "variable 'w' must be of style atom", before="variable w equal 1.0\n")
        self.fix("0 1.1 weight var w", "weight var needs Nfreq above 0", before="variable w atom 1.0\n")
        self.fix("10 1.1 weight store w", "weight store w: there is no such vector", "fix property/atom d_w")

    def test_weights_of_atoms(self):
        for formula in ("1.0-(id==3)", "1.0-2*(id==3)", "exp(1000*(id==3))"):
            self.fails("fix even all balance/slice 10 1.1 weight var w", "ERROR", "weight var w gives atom 3 the weight",
                       "must be a number above 0", before=f"variable w atom {formula}\n", ranks=2)

    def test_box_too_small(self):
        """Eight slabs as wide as the skin do not fit."""
        self.fails("neighbor 1.0 bin\nfix even all balance/slice 10 1.0 levels 1 axes x", "ERROR", "box is too small for 8 ranks",
                   ranks=8)
        self.fails("fix even all balance/slice 10 1.0 width 3.0", "ERROR", "box is too small for 8 ranks", ranks=8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
