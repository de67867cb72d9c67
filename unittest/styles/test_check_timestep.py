# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""fix check/timestep/gran: its numbers against closed forms, its warnings and errors, every loop and number of ranks."""
import math
import unittest

import scenes
from lammps import StylesTest

RADIUS, DENSITY, YOUNG, NU, KN, GAMMA, DT = 0.45, 2.0, 1.0e7, 0.3, 2.0e4, 50.0, 1.0e-4
MASS = DENSITY * 4.0 / 3.0 * math.pi * RADIUS ** 3
MATERIAL = f"hertz/material {YOUNG} 0.7 {NU} tangential mindlin NULL 1.0 0.4 damping tsuji"


def same_grains(atoms, velocities):
    for a in atoms:
        a[1], a[2], a[3] = 1, 2 * RADIUS, DENSITY
    for v in velocities:
        v[1:] = [0.0] * 6


def scene(pair, words, coeff=("* *",), steps=20, fixes="", speed=2.0, boundary="p p p"):
    return scenes.scene(boundary=boundary, pair=pair, coeff=coeff, steps=steps, every=10, thermo="step atoms f_guard[1] f_guard[2] f_guard[3] f_guard[4] f_guard[5]",
                        fixes=f"fix move all nve/sphere\n{fixes}velocity all set 0 0 {speed}\nfix guard all check/timestep/gran {words}")


FILES = [("cloud.data", scenes.cloud(cells=(4, 4, 4), spacing=1.1, edit=same_grains))]


class Numbers(StylesTest):
    def first(self, *args, ranks=1, **kw):
        """The five numbers at step 0."""
        run = self.run_lammps(scene(*args, **kw), FILES, gpudem="double", ranks=ranks)
        return run.thermo()[0][1][0, 2:], run

    def test_linear_spring(self):
        row, run = self.first(scenes.HOOKE_HISTORY, "10 0.2 0.2")
        omega = math.sqrt(KN / (0.5 * MASS) - 0.25 * GAMMA ** 2)
        self.assertEqual(row[0], 0.0)       # no Rayleigh and no Hertz time without moduli
        self.assertEqual(row[1], 0.0)
        self.assertAlmostEqual(row[2] * (math.pi / omega) / DT, 1.0, delta=2e-3)
        self.assertAlmostEqual(row[3], 2.0 * DT / RADIUS, delta=1e-12)
        self.assertNotIn("WARNING: Fix check", run.everything)

    def test_material_and_wall(self):
        row, _ = self.first("granular", "10 1.0 1.0 speed 3.0", boundary="p p f", coeff=(f"* * {MATERIAL}",),
                            fixes=f"fix floor all wall/gran granular {MATERIAL.replace(str(YOUNG), '4.0e7')} zplane -1 NULL\n")
        shear = YOUNG / (2 * (1 + NU))
        rayleigh = math.pi * RADIUS * math.sqrt(DENSITY / shear) / (0.1631 * NU + 0.8766)
        self.assertAlmostEqual(row[0], DT / rayleigh, delta=1e-6 * row[0])
        # the wall: E*, mass and radius twice those of two grains ... and four times as stiff
        times = [2.87 * (m * m / (r * e * e * 3.0)) ** 0.2 for m, r, e in
                 ((0.5 * MASS, 0.5 * RADIUS, YOUNG / (2 * (1 - NU * NU))), (MASS, RADIUS, 4 * YOUNG / (2 * (1 - NU * NU))))]
        self.assertAlmostEqual(row[1], DT / min(times), delta=1e-6 * row[1])

    def test_every_loop_and_ranks(self):
        words = "10 0.2 0.2 auto 1e-3"
        resident, run = self.first(scenes.HERTZ_HISTORY, words)
        self.assertResident(run)
        self.assertGreater(resident[4], 0.0)
        self.assertLess(resident[4], DT / resident[2] / 10)
        self.assertIn("timestep", next(line for line in run.everything.splitlines() if "error of 0.001" in line))
        row, _ = self.first(scenes.HERTZ_HISTORY, words, ranks=3)
        self.assertEqual(list(row), list(resident))
        text = scene(scenes.HERTZ_HISTORY, words).replace("pair_style gran/hertz/history", "pair_style gran/hertz/history/gpudem")
        plain = self.run_lammps(text, FILES, gpudem="double", arguments=[])
        self.assertNotIn("GPUDEM resident run", plain.everything)
        self.assertEqual(list(plain.thermo()[0][1][0, 2:]), list(resident))

    def test_speeds_change_the_times(self):
        row, run = self.first(scenes.HERTZ_HISTORY, "10 0.2 0.2", steps=20, fixes="fix pull all gravity 1.0e4 vector 0 0 1\n")
        rows = run.thermo()[0][1]
        self.assertGreater(rows[2, 3], rows[0, 3] * 1.2)


class Answers(StylesTest):
    def test_warnings(self):
        for words, what in (("10 1e-4 1.0", "Rayleigh time"), ("10 1.0 1e-4", "Hertz time"), ("10 1 1 contact 1e-4", "shortest contact"),
                            ("10 1 1 move 1e-5", "moves .* of its radius")):
            run = self.run_lammps(scene("granular", words, coeff=(f"* * {MATERIAL}",)), FILES, gpudem="double")
            self.assertRegex(run.everything, "WARNING: Fix check/timestep/gran guard: .*" + what)
            quiet = self.run_lammps(scene("granular", words + " warn no", coeff=(f"* * {MATERIAL}",)), FILES, gpudem="double")
            self.assertNotIn("WARNING: Fix check", quiet.everything)
            stopped = self.run_lammps(scene("granular", words + " error yes", coeff=(f"* * {MATERIAL}",)), FILES, gpudem="double", succeed=False)
            self.assertNotEqual(stopped.status, 0)
            self.assertRegex(stopped.everything, "ERROR: Fix check/timestep/gran guard: .*" + what)

    def test_mistakes(self):
        for words, message in (("10 0.2", "expected N, a fraction"), ("0 0.2 0.2", "N is 0, but must be at least 1"),
                               ("10 -1 0.2", "fraction of the Rayleigh time is -1"), ("10 0.2 0", "fraction of the Hertz time is 0"),
                               ("10 0.2 0.2 warn maybe", "warn is maybe"), ("10 0.2 0.2 color red", "unknown keyword color"),
                               ("10 0.2 0.2 auto", "keyword auto has no value"), ("10 0.2 0.2 auto -0.1", "auto is -0.1")):
            run = self.run_lammps(scene(scenes.HOOKE, words), FILES, gpudem="double", succeed=False)
            self.assertIn("ERROR: Fix check/timestep/gran guard: ", run.everything, words)
            self.assertIn(message, run.everything)

    def test_other_pair_styles_are_named(self):
        run = self.run_lammps(scene(scenes.HOOKE, "10 0.2 0.2"), FILES, gpudem="double", arguments=[], succeed=False)
        self.assertRegex(run.everything, "ERROR: Fix check/timestep/gran guard knows .* not of pair style gran/hooke")


if __name__ == "__main__":
    unittest.main(verbosity=2)
