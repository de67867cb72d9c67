# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Thermodynamic output at every line, in double precision; also that reading the device needs no particle copies."""
import unittest

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest
from tolerance import DOUBLE, MIXED

KEYWORDS = "step atoms ke c_spin temp press pxx pyy pzz pxy pxz pyz vol pe etotal"
NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 10.0 chute 26.0\n"


class Thermo(StylesTest):
    def check(self, text, cloud=None, precisions=(("double", DOUBLE),), log=()):
        files = [("cloud.data", scenes.cloud(**(cloud or {})))]
        stock = self.run_lammps(text, files)
        for precision, tolerance in precisions:
            ours = self.run_lammps(text, files, gpudem=precision)
            self.assertResident(ours)
            for phrase in log:
                self.assertIn(phrase, ours.log)
            compare_thermo(self, stock.thermo(), ours.thermo(), tolerance, what=precision)
        return ours

    def test_all_keywords(self):
        ours = self.check(scenes.scene(NVE + DOWN, thermo=KEYWORDS, every=20),
                          precisions=(("double", DOUBLE), ("mixed", MIXED)))
        self.assertIn("on host   : nothing but output", ours.log)

    def test_energy_of_gravity(self):
        self.check(scenes.scene(NVE + DOWN + "fix_modify down energy yes", thermo=KEYWORDS + " f_down", every=20))

    def test_energy_of_gravity_between_runs(self):
        """The scalar is asked for while the particles are on the host again."""
        self.check(scenes.scene(NVE + DOWN, thermo=KEYWORDS + " f_down", every=20, after="run 40\nrun 40 pre no\n"))

    def test_pressure_of_history_free_style(self):
        self.check(scenes.scene(NVE, thermo=KEYWORDS, pair=scenes.HOOKE, every=20))

    def test_pressure_with_walls(self):
        walls = "fix w all wall/gran hertz/history 2.0e5 NULL 200.0 NULL 0.5 1 zplane 0.05 7.1\n"
        self.check(scenes.scene(NVE + walls, thermo=KEYWORDS, every=20, boundary="p p f", pair=scenes.HERTZ_HISTORY),
                   cloud=dict(margin=(0, 0, 0.1)))

    def test_pressure_in_two_dimensions(self):
        self.check(scenes.scene("fix move all nve/sphere disc\nfix flat all enforce2d", thermo=KEYWORDS, every=20,
                                dimension=2), cloud=dict(dimension=2, cells=(20, 20, 1)))

    def test_normalised(self):
        self.check(scenes.scene(NVE, thermo=KEYWORDS, every=20).replace("norm no", "norm yes"))

    def test_groups_and_dynamic_freedoms(self):
        text = scenes.scene(NVE, before="group one type 1\ncompute one one ke\ncompute hot one temp\n"
                            "compute turn one erotate/sphere\n", thermo="step c_one c_hot c_hot[1] c_hot[4] c_turn temp",
                            every=20)
        self.check(text + "compute_modify thermo_temp dynamic/dof yes\ncompute_modify hot extra/dof 0\nrun 40\n")

    def test_every_step(self):
        self.check(scenes.scene(NVE + DOWN, thermo=KEYWORDS, every=1, steps=60))

    def test_uneven_output(self):
        text = scenes.scene(NVE, thermo=KEYWORDS, after="variable s equal stagger(50,7)\nthermo v_s\nrun 200\n")
        self.check(text)

    def test_variables(self):
        """A formula of thermo keywords stays on the device; one that reads atoms brings them to the host."""
        text = scenes.scene(NVE, before="variable e equal ke+c_spin*0\nvariable far equal xcm(all,x)\n"
                            "variable some equal count(all)\n", thermo="step ke v_far v_some", every=20)
        self.check(text.replace("ke+c_spin*0", "2.0*step"), log=["variable far"])

    def test_dump_every_step_of_pressure(self):
        """Pressure asked for by a fix between thermo lines."""
        text = scenes.scene(NVE + "fix mean all ave/time 5 4 20 c_thermo_press c_thermo_temp file mean.out format \" %.17g\"\n",
                            thermo="step f_mean[1] f_mean[2] press", every=20)
        self.check(text)


class Forces(StylesTest):
    def test_step_zero(self):
        """Forces of the set-up itself, and after a run of no steps."""
        files = [("cloud.data", scenes.cloud())]
        for pair in (scenes.HOOKE, scenes.HOOKE_HISTORY, scenes.HERTZ_HISTORY):
            text = scenes.scene(NVE, pair=pair, steps=0, thermo=KEYWORDS)
            stock, ours = self.run_lammps(text, files), self.run_lammps(text, files, gpudem="double")
            compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER, what=pair)
            compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE, what=pair)


if __name__ == "__main__":
    unittest.main(verbosity=2)
