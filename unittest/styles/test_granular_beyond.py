# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Words of pair_style granular that LAMMPS does not have, given by a script: forces of two spheres by closed form."""
import math
import unittest

from lammps import StylesTest
from test_granular_corrections import GAP, OVERLAP, RADIUS, two
from tolerance import CLOSED_FORM, RUN_IN_PARTS

STIFFNESS = 1.0e5
HOOKE = f"hooke {STIFFNESS} 0.0 damping velocity"
SMOOTH = "tangential linear_nohistory 0.0 0.0"
BOTH = ("double", "mixed")


class Beyond(StylesTest):
    def value(self, text, precision, column, atom=1):
        run = self.run_lammps(text, gpudem=precision)
        self.assertResident(run)
        dump = run.dump()
        names, table = dump[max(dump)]
        return table[atom - 1, names.index(column)]

    def check(self, text, column, expected):
        """The first sphere gets what is expected; mixed precision feels the rounding of the overlap."""
        for precision, tolerance in (("double", CLOSED_FORM), ("mixed", 1.0e-5)):
            value = self.value(text, precision, column)
            self.assertLessEqual(abs(value - expected), tolerance * abs(expected), f"{precision}: {value} for {expected}")

    def law(self, words, **settings):
        return two((f"* * {words}",), types=(1, 1), **settings)

    def test_van_der_waals_before_touch(self):
        hamaker, s = 2.0, 0.01
        text = self.law(f"{HOOKE} {SMOOTH} cohesion vdw {hamaker} 0.001 0.1", distance=1.0 + s)
        self.check(text, "fx", hamaker * RADIUS / (6.0 * s * s))

    def test_van_der_waals_ends_at_its_cutoff(self):
        text = self.law(f"{HOOKE} {SMOOTH} cohesion vdw 2.0 0.001 0.1", distance=1.11)
        for precision in BOTH:
            self.assertEqual(self.value(text, precision, "fx"), 0.0)

    def test_area_of_the_lens(self):
        """sjkr: for equal spheres the circle of radius^2 = R^2 - d^2/4."""
        energy = 3.0e3
        area = math.pi * (0.25 - 0.25 * GAP * GAP)
        self.check(self.law(f"{HOOKE} {SMOOTH} cohesion sjkr {energy}"), "fx", energy * area - STIFFNESS * OVERLAP)

    def test_bridge_in_touch(self):
        gamma, angle = 50.0, 30.0
        pull = 4.0 * math.pi * gamma * RADIUS * math.cos(math.radians(angle))
        self.check(self.law(f"{HOOKE} {SMOOTH} cohesion capillary {gamma} {angle} 1.0e-4"), "fx", pull - STIFFNESS * OVERLAP)

    def test_bridge_forms_at_touch_only(self):
        text = self.law(f"{HOOKE} {SMOOTH} cohesion capillary 50.0 30.0 1.0e-4", distance=1.001)
        for precision in BOTH:
            self.assertEqual(self.value(text, precision, "fx"), 0.0)

    def test_bridge_breaks(self):
        """Pulled apart after touch: the closed form up to the rupture distance, nothing beyond."""
        gamma, angle, volume, speed, start = 50.0, 30.0, 1.0e-4, 10.0, 0.9999
        rupture = (1.0 + 0.5 * math.radians(angle)) * volume ** (1.0 / 3.0)
        pull = 4.0 * math.pi * gamma * RADIUS * math.cos(math.radians(angle))
        for part in (0.5, 1.05):
            steps = round((1.0 + part * rupture - start) / speed / 1.0e-5)
            text = self.law(f"{HOOKE} {SMOOTH} cohesion capillary {gamma} {angle} {volume}", distance=start, steps=steps,
                            every=steps)
            text = text.replace("fix move all nve/sphere\n", f"group two id 2\nfix pull two move linear {speed} 0 0\n")
            s = start + speed * 1.0e-5 * steps - 1.0
            wet = s * math.sqrt(2.0 * RADIUS / volume)
            self.check(text, "fx", pull / (1.0 + wet * (1.05 + 2.5 * wet)) if part < 1.0 else 0.0)

    def test_coulomb_contact_and_net(self):
        """The friction of a cohesive contact counts from its elastic force, or from what cohesion leaves of it."""
        mu, energy = 0.3, 3.0e3
        area = math.pi * (0.25 - 0.25 * GAP * GAP)
        elastic = STIFFNESS * OVERLAP
        for word, base in (("", elastic), (" coulomb contact", elastic), (" coulomb net", elastic - energy * area)):
            words = f"hooke {STIFFNESS} 1.0 damping velocity tangential linear_nohistory 1.0e9 {mu} cohesion sjkr {energy}{word}"
            self.check(self.law(words, velocity="set atom 1 vy 1.0"), "fy", -mu * base)

    def test_arm_of_the_slip_velocity(self):
        """A spinning sphere at another at rest: its surface moves with omega R, or omega (R - delta/2)."""
        gamma, spin = 7.0, 2.0
        words = f"hooke {STIFFNESS} {gamma} damping velocity tangential linear_nohistory 1.0 1.0e3"
        for word, arm in (("", 0.5), (" arm lammps", 0.5), (" arm contact_point", 0.5 - 0.5 * OVERLAP)):
            text = self.law(words + word, velocity=f"set atom 1 omega 0 0 {spin}")
            self.check(text, "fy", -gamma * spin * arm)
            self.check(text, "tqz", -gamma * spin * arm * (0.5 - 0.5 * OVERLAP))

    def test_rolling_of_constant_torque(self):
        """cdt: mu R* F_n against the relative spin."""
        mu = 0.05
        text = self.law(f"{HOOKE} {SMOOTH} rolling cdt {mu}", velocity="set atom 1 omega 0 0 2.0")
        self.check(text, "tqz", -mu * RADIUS * STIFFNESS * OVERLAP)

    def rolled(self, law, velocity, parts, precision):
        """A sphere on a plane after 1200 steps in so many runs: velocity, and surface speed of the spin."""
        radius, weight, kn = 0.5, math.pi / 6.0, 1.0e4
        text = (f"units lj\natom_style sphere\nboundary p p f\nnewton off\ncomm_modify vel yes\nregion box block -4 4 -4 4 0 4\n"
                f"create_box 1 box\ncreate_atoms 1 single 0 0 {radius - weight / kn:.17g}\nset group all diameter 1.0 density 1.0\n"
                f"{velocity}\npair_style granular\npair_coeff * * {HOOKE} {SMOOTH}\nneighbor 0.3 bin\ntimestep 2.0e-4\n"
                f"fix move all nve/sphere\nfix g all gravity 1.0 vector 0 0 -1\n"
                f"fix w all wall/gran granular hooke {kn} 50.0 damping velocity {law} zplane 0 NULL\n"
                "dump out all custom 1200 dump.out id vx omegay\ndump_modify out sort id format float %.17g\n" + f"run {1200 // parts}\n" * parts)
        return self.value(text, precision, "vx"), radius * self.value(text, precision, "omegay")

    def test_a_run_in_parts(self):
        """A contact that slides or rolls at its limit has no dashpot, also in the forces at the start of a run."""
        slides = "tangential liggghts_linear_history 5000.0 1.0 0.1 arm contact_point"
        rolls = "tangential linear_history 5000.0 1.0 0.9 rolling epsd 0.1 0.3"
        for law, velocity in ((slides, "set atom 1 vx 1.0"), (rolls, "set atom 1 vx 1.0 omega 0 2.0 0")):
            for precision in BOTH:
                whole, parts = (self.rolled(law, velocity, n, precision) for n in (1, 40))
                for a, b in zip(whole, parts):
                    self.assertLessEqual(abs(a - b), RUN_IN_PARTS, f"{precision} {law}: {b} in parts, {a} at once")

    def test_loading_of_the_plastic_spring(self):
        """luding: slope k1 while the overlap grows for the first time, k2 on the way back, the largest overlap kept."""
        k1, k2, speed = 1.0e5, 4.0e5, 10.0
        words = f"luding {k1} 0.0 {k2} 0.0 0.0 damping velocity {SMOOTH}"
        there, back = 100, 20
        text = self.law(words, distance=1.0, steps=there, every=back)
        text = text.replace("fix move all nve/sphere\n", f"group two id 2\nfix pull two move linear -{speed} 0 0\n")
        deepest = there * speed * 1.0e-5
        self.check(text, "fx", -k1 * deepest)
        text += f"unfix pull\nfix pull two move linear {speed} 0 0\nrun {back}\n"
        self.check(text, "fx", -(k1 * deepest - k2 * back * speed * 1.0e-5))


if __name__ == "__main__":
    unittest.main(verbosity=2)
