# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""What scripts do around and between runs: pre no, every, velocity, set, delete, displace, clear, rerun, insertion."""
import unittest
from dataclasses import dataclass, field

import numpy as np

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests
from tolerance import DOUBLE, MIXED, ROUND_OFF

NVE = "fix move all nve/sphere\n"
REGION = "region corner block INF 3.0 INF 3.0 INF 3.0 units box\n"
SETTLE = """fix down all gravity 10.0 vector 0 0 -1
fix floor all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 zplane 0.0 NULL
"""
TALL = dict(cells=(8, 8, 3), margin=(0.0, 0.0, 0.3), seed=3)


@dataclass
class Case:
    after: str                 # what follows the output commands, runs included
    fixes: str = NVE
    before: str = ""
    cloud: dict = field(default_factory=dict)
    scene: dict = field(default_factory=dict)


CASES = {
    "Runs": {
        "three_runs": Case("run 60\nrun 60\nrun 80\n"),
        "zero_then_run": Case("run 0\nrun 100\nrun 0\n"),
        "pre_no": Case("run 60\nrun 60 pre no post no\nrun 80 pre no\n"),
        "every": Case("run 200 every 50 \"velocity all set 0.0 0.0 1.0 sum yes\"\n"),
        "every_null": Case("run 100 every 20 NULL\n"),
        "upto": Case("run 50\nrun 120 upto\n"),
        "start_stop": Case("run 50 start 0 stop 150\nrun 100 start 0 stop 150\n",
                           fixes=NVE + "variable pull equal ramp(0.0,20.0)\nfix g all gravity v_pull vector 0 0 -1\n"),
        "fix_between": Case("run 60\nfix down all gravity 10.0 vector 0 0 -1\nrun 60\nunfix down\nrun 60\n"),
        "pair_between": Case("run 60\npair_style gran/hertz/history 2.0e5 NULL 200.0 NULL 0.5 1\npair_coeff * *\nrun 60\n"),
        "coefficients_between": Case("run 60\npair_style gran/hooke/history 3.0e4 NULL 20.0 NULL 0.3 0\n"
                                     "pair_coeff * *\nrun 60\n"),
        "timestep_between": Case("run 60\ntimestep 0.5e-4\nrun 60\n"),
        "reset_timestep": Case("run 50\nundump out\nreset_timestep 0\ndump out all custom 50 dump.out " +
                               scenes.DUMP_COLUMNS + "\ndump_modify out sort id format float %.17g\nrun 50\n"),
        "info_and_print": Case("run 50\nvariable e equal ke\nrun 50\nprint \"energy ${e}\"\nrun 50\n",
                               before="variable e equal ke\n"),
    },
    "BetweenRuns": {
        "velocity_scaled": Case("run 60\nvelocity all scale 5.0\nrun 60\n"),
        "velocity_ramp": Case("run 60\nvelocity all ramp vx 0 2 z 0 7 sum yes\nrun 60\n"),
        "velocity_create": Case("run 60\nvelocity all create 3.0 4711 loop all\nrun 60\n"),
        "set_type_and_size": Case("run 60\nset atom 1*40 diameter 0.7\nset atom 41*80 density 5.0\nset atom 10*90 type 1\n"
                                  "set atom 5 omega 1.0 2.0 3.0\nrun 60\n",
                                  fixes=NVE + "fix drag all viscous 1.0 scale 2 4.0\n"),
        "set_position": Case("run 60\nset atom 7 z 3.33\nrun 60\n"),
        "displace": Case("run 60\ndisplace_atoms all move 0.5 0.5 0.5 units box\nrun 60\n"),
        "displace_ramp": Case("run 60\ndisplace_atoms all ramp x 0.0 0.1 z 0.0 7.2 units box\nrun 60\n"),
        "delete_region": Case("run 60\ndelete_atoms region corner compress no\nrun 60\n", before=REGION),
        "delete_compress": Case("run 60\ndelete_atoms region corner\nrun 60\n", before=REGION,
                                scene=dict(pair=scenes.HOOKE)),
        "delete_group": Case("run 60\ngroup one type 1\ndelete_atoms group one compress no\nrun 60\n"),
        "create_atoms": Case("run 60\ncreate_atoms 1 single 3.1 3.1 7.4\nset atom 513 diameter 0.5\nrun 60\n",
                             cloud=dict(margin=(0, 0, 0.8)), scene=dict(boundary="p p f")),
        # at rest while frozen: stock LAMMPS damps a pair of moving frozen grains by the mass of whichever comes first
        # in its list
        "freeze_and_release": Case("run 60\ngroup low id 1:200\nvelocity low set 0 0 0\nset group low omega 0 0 0\n"
                                   "fix hold low freeze\nrun 60\nunfix hold\nrun 60\n"),
        "change_box": Case("run 60\nchange_box all x final 0.0 7.5 units box\nrun 60\n"),
        "change_boundary": Case("run 60\nchange_box all boundary p p s\nrun 60\n"),
    },
    "Insertion": {
        "deposit": Case("run 400\n", before="region above block 1 6 1 6 4.0 7.0 units box\n",
                        fixes=NVE + SETTLE + "fix rain all deposit 20 1 20 1234 region above near 1.0 vz -5 -5\n",
                        cloud=dict(cells=(8, 8, 3), margin=(0, 0, 5), seed=3), scene=dict(boundary="p p f")),
        "deposit_id_next": Case("run 300\n", before="region above block 1 6 1 6 4.0 7.0 units box\n",
                                fixes=NVE + SETTLE + "fix rain all deposit 30 2 10 77 region above near 1.0 id next\n",
                                cloud=dict(cells=(8, 8, 3), margin=(0, 0, 5), seed=3), scene=dict(boundary="p p f")),
        "evaporate": Case("run 200\n", before=REGION, fixes=NVE + "fix gone all evaporate 25 4 corner 4321\n"),
        "evaporate_and_springs": Case("run 200\n", before=REGION,
                                      fixes=NVE + SETTLE + "fix gone all evaporate 10 2 corner 17\n",
                                      scene=dict(boundary="p p f"), cloud=dict(margin=(0, 0, 0.5))),
    },
}


class CommandsTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        text = scenes.scene(case.fixes, before=case.before, after=case.after, **case.scene)
        stock = self.run_lammps(text, files)
        ours = self.run_lammps(text, files, gpudem="double")
        self.assertResident(ours)
        special = {"Volume": 1e-2} if "s" in case.after.split("boundary")[-1] and "boundary" in case.after else None
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE, special=special)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        return stock, ours


make_tests(CommandsTest, CASES, globals())


class Sessions(StylesTest):
    """Scripts that start over or read back."""

    def pair_of_runs(self, text, files=()):
        files = [("cloud.data", scenes.cloud()), *files]
        return self.run_lammps(text, files), self.run_lammps(text, files, gpudem="double")

    def test_clear(self):
        one = scenes.scene(steps=100)
        two = scenes.scene(steps=100, pair=scenes.HERTZ_HISTORY)
        stock, ours = self.pair_of_runs(one + "clear\n" + two.replace("dump.out", "dump.two"))
        self.assertEqual(ours.everything.split("Loop time")[0].count("GPUDEM resident run"),
                         stock.everything.split("Loop time")[0].count("GPUDEM resident run") + 1)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_dumps(self, stock.dump("dump.two"), ours.dump("dump.two"), DOUBLE, scenes.DIAMETER)
        self.assertGreaterEqual(ours.log.count("GPUDEM resident run"), 2)

    def test_rerun(self):
        text = (scenes.head() + scenes.middle() + NVE + scenes.output(50) +
                "dump again all custom 50 dump.again id type x y z vx vy vz\ndump_modify again sort id format float %.17g\n"
                "run 100\nundump out\n"
                "dump later all custom 50 dump.later id fx fy fz\ndump_modify later sort id format float %.17g\n"
                "rerun dump.again dump x y z vx vy vz\n")
        stock, ours = self.pair_of_runs(text)
        self.assertIn("not resident", ours.everything)
        compare_dumps(self, stock.dump("dump.later"), ours.dump("dump.later"), DOUBLE, scenes.DIAMETER)

    def test_run_after_rerun(self):
        text = (scenes.head() + scenes.middle() + NVE +
                "dump again all custom 50 dump.again id type x y z vx vy vz\ndump_modify again sort id format float %.17g\n"
                "run 100\nundump again\nrerun dump.again dump x y z vx vy vz\n" + scenes.output(50) + "run 100\n")
        stock, ours = self.pair_of_runs(text)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)

    def test_lost_through_face(self):
        """Layers of grains leave through a fixed face; counted when no layer is near the face, because LAMMPS and
        GPUDEM delete a grain at their next reneighbouring, which are different steps."""
        def fly(atoms, velocities):
            for v in velocities:
                v[1:] = [0.0, 0.0, 50.0, 0.0, 0.0, 0.0]
        files = [("cloud.data", scenes.cloud(spacing=1.2, speed=0.0, spin=0.0, margin=(0, 0, 0.0), edit=fly))]
        text = scenes.scene(NVE, boundary="p p f", after="run 1920\n", every=240)   # one layer: 1.2 / 50 / 1e-4 steps
        stock, ours = self.run_lammps(text, files), self.run_lammps(text, files, gpudem="double")
        self.assertResident(ours)
        counts = stock.thermo()[0][1][:, 1]
        self.assertEqual(list(counts), [512 - 64 * k for k in range(9)])
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)

    def test_renumbering_keeps_third_law(self):
        """delete_atoms renumbers atoms, but the springs still name the old ones: LAMMPS loses or mixes them up. Whatever
        is kept here, the two grains of a contact must feel opposite forces."""
        text = scenes.scene(NVE, before=REGION, every=20, columns="mass",
                            after="run 60\ndelete_atoms region corner\nrun 100\n")
        ours = self.run_lammps(text, [("cloud.data", scenes.cloud())], gpudem="double")
        self.assertResident(ours)
        momenta = []
        for step, (names, a) in ours.dump().items():
            if step > 60:
                mass, v = a[:, [names.index("mass")]], a[:, [names.index(c) for c in ("vx", "vy", "vz")]]
                momenta.append((mass * v).sum(axis=0))
                scale = np.abs(mass * v).sum()
        self.assertLessEqual(np.abs(np.array(momenta) - momenta[0]).max(), ROUND_OFF.velocity * scale)

    def test_split_run(self):
        """Springs survive the way to the host and back between two runs, in both precisions."""
        files, text = [("cloud.data", scenes.cloud())], scenes.scene(after="run 25\n" * 8)
        stock = self.run_lammps(text, files)
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            ours = self.run_lammps(text, files, gpudem=precision)
            compare_dumps(self, stock.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)

    def test_minimal_script(self):
        """No thermo, no dump, only a final write_dump."""
        text = scenes.head() + scenes.middle() + NVE + "thermo 0\nrun 150\n" + \
            f"write_dump all custom dump.out {scenes.DUMP_COLUMNS} modify sort id format float %.17g\n"
        stock, ours = self.pair_of_runs(text)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)

    def test_suffix_command(self):
        """The suffix may also come from the script, and be switched off."""
        text = scenes.scene(steps=100)
        files = [("cloud.data", scenes.cloud())]
        stock = self.run_lammps(text, files)
        off = self.run_lammps("suffix off\n" + text, files, gpudem="double")
        compare_dumps(self, stock.dump(), off.dump(), DOUBLE, scenes.DIAMETER)
        text = text.replace("pair_style", "run_style verlet\npair_style", 1)
        by_script = self.run_lammps("suffix gpudem\n" + text, files, gpudem="double", arguments=[])
        self.assertResident(by_script)
        compare_dumps(self, stock.dump(), by_script.dump(), DOUBLE, scenes.DIAMETER)


if __name__ == "__main__":
    unittest.main(verbosity=2)
