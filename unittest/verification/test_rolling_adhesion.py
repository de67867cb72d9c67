# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Rolling friction on a plane, pull-off of adhesive spheres, and what stock LAMMPS gets wrong of both and of restitution."""
import math
import unittest

import numpy as np

from verification import CODES, F, V, W, Sphere, Verification, hertz_time, scene
from tolerance import DECAY, FIRST_ORDER, PULL, STOCK_KNOWN

G, RADIUS, DENSITY = 9.81, 5.0e-3, 2500.0
GRAVITY = f"fix g all gravity {G} vector 0 0 -1\n"
YOUNG, NU, GAMMA = 1.0e7, 0.3, 0.5      # soft spheres; gamma in LAMMPS is half of the work of adhesion
EFFECTIVE = RADIUS * 0.6 * RADIUS / (1.6 * RADIUS)
E_STAR = 0.5 * YOUNG / (1.0 - NU * NU)


class Rolling(Verification):
    def decay(self, code, tangential, velocity, spin, mu, at):
        """A sphere at rest on its overlap, with a limit mu of rolling friction; states at the two times."""
        kn = 2.0e4
        sphere = Sphere((0, 0, 0), RADIUS, DENSITY, (velocity, 0, 0), (0, spin, 0))
        sphere.position = (0.0, 0.0, RADIUS - sphere.mass * G / kn)
        dt = math.pi * math.sqrt(sphere.mass / kn) / 50.0
        law = f"granular hooke {kn} 2.0 damping velocity tangential {tangential} rolling sds {kn} 0.0 {mu}"
        every = round((at[1] - at[0]) / dt)
        begin = max(1, round(at[0] / dt / every)) * every
        text = scene([sphere], "pair_style gran/hooke 1.0 0.0 0.0 0.0 0.0 0\npair_coeff * *", dt, begin + every, every,
                     boundary="p p f", fixes=f"{GRAVITY}fix w all wall/gran {law} zplane 0.0 NULL")
        rows, _ = self.rows(text, code)
        return rows[-2, 0], rows[-1, 0], every * dt

    def test_spin_on_a_smooth_plane(self):
        """No friction along the plane: the spin alone decays, 5 mu_r g/(2 R)."""
        for mu in (0.01, 0.1):
            spin = 400.0
            for code in CODES:
                expected = 2.5 * mu * G / RADIUS
                a, b, time = self.decay(code, "linear_nohistory 0.0 0.0", 0.0, spin, mu, (0.02, 0.06))
                self.check(code, f"mu_r {mu}: spin lost per time", (a[W][1] - b[W][1]) / time, expected, DECAY)
                self.check(code, f"mu_r {mu}: velocity", b[V][0], 0.0, DECAY)

    def test_rolling_on_a_rough_plane(self):
        """Rolling without slip: translation and spin share the couple, 5/7 mu_r g."""
        for mu in (0.01, 0.1):
            for code in CODES:
                a, b, time = self.decay(code, "linear_history 1.0e4 0.5 0.9", 1.0, 1.0 / RADIUS, mu, (0.05, 0.15))
                self.check(code, f"mu_r {mu}: speed lost per time", (a[V][0] - b[V][0]) / time, 5.0 / 7.0 * mu * G, DECAY)
                self.check(code, f"mu_r {mu}: still rolling", b[W][1] * RADIUS, b[V][0], DECAY)


class Adhesion(Verification):
    def pulls(self, code, model, skin=None, every_step=False):
        """Force on the second sphere while it is drawn away from the first at a constant speed, and the gap at each step."""
        gap = (9.0 * math.pi * GAMMA / (4.0 * E_STAR)) ** (2.0 / 3.0) * EFFECTIVE ** (1.0 / 3.0) / 3.0
        start, end = -gap, 1.2 * gap
        dt, steps = 5.0e-7, 1761   # no step falls on a parting
        speed = (end - start) / (steps * dt)
        spheres = [Sphere((0, 0, 0), RADIUS, DENSITY), Sphere((1.6 * RADIUS + start, 0, 0), 0.6 * RADIUS, DENSITY)]
        # a spring of no stiffness: stock ends with "Neighbor history overflow" where a jkr pair keeps no numbers
        law = (f"pair_style granular\npair_coeff * * {model} {YOUNG} 0.0 {NU} {GAMMA} damping velocity "
               "tangential linear_history 1.0 0.0 0.0")
        fixes = (("neigh_modify delay 0 every 1 check no\n" if every_step else "") +
                 f"group two id 2\nunfix move\nfix pull two move linear {speed:.17g} 0.0 0.0")
        rows, _ = self.rows(scene(spheres, law, dt, steps, 1, fixes=fixes, skin=skin), code)
        return rows[:, 1, F][:, 0], rows[:, 1, 0] - rows[:, 0, 0] - 1.6 * RADIUS, gap

    def test_jkr_pull_off(self):
        """Largest pull 3 pi gamma R*, parting at the gap (9 pi gamma/(4 E*))^(2/3) R*^(1/3)/3 (Johnson, Kendall, Roberts 1971)."""
        for code in CODES:
            force, at, gap = self.pulls(code, "jkr", skin=RADIUS)
            self.check(code, "largest pull", -force.min(), 3.0 * math.pi * GAMMA * EFFECTIVE, PULL)
            self.check(code, "gap at parting", at[np.flatnonzero(force)[-1]], gap, PULL, scale=2.2 * gap)

    def test_jkr_neck_of_stock(self):
        """Stock forgets a neck that is longer than its skin at a rebuild: it sees no more than the pull at that length."""
        largest, skin = 3.0 * math.pi * GAMMA * EFFECTIVE, 1.0e-4 * RADIUS
        low, high = (0.25 * math.pi * GAMMA * EFFECTIVE ** 2 / E_STAR) ** (1.0 / 3.0), RADIUS   # overlap least; stable above
        for _ in range(200):
            a = 0.5 * (low + high)
            overlap = a * a / EFFECTIVE - 2.0 * math.sqrt(math.pi * GAMMA * a / E_STAR)
            low, high = (a, high) if overlap < -skin else (low, a)
        at_skin = 4.0 * math.sqrt(math.pi * GAMMA * E_STAR * a ** 3) - 4.0 / 3.0 * E_STAR * a ** 3 / EFFECTIVE
        for code in CODES:
            force, _, _ = self.pulls(code, "jkr", skin=skin, every_step=True)
            self.check(code, "largest pull" + ("" if code else ", known defect"), -force.min(), largest if code else at_skin,
                       PULL if code else STOCK_KNOWN)

    def test_dmt_pull_off(self):
        """4 pi gamma R* at touch, nothing beyond (Derjaguin, Muller, Toporov 1975)."""
        for code in CODES:
            force, at, gap = self.pulls(code, "dmt")
            inside = at < 0.0
            self.check(code, "largest pull", -force.min(), 4.0 * math.pi * GAMMA * EFFECTIVE, PULL)
            self.check(code, "force beyond touch", np.abs(force[at > 1e-3 * gap]).max(), 0.0, PULL)
            hertz = 4.0 / 3.0 * E_STAR * math.sqrt(EFFECTIVE) * (-at[inside][1]) ** 1.5
            self.check(code, "force in touch", force[inside][1], hertz - 4.0 * math.pi * GAMMA * EFFECTIVE, PULL)


class KnownDefects(Verification):
    """Stock LAMMPS 29 Sep 2021 with the words of the script as they stand; GPUDEM answers what was asked."""

    def rebound(self, code, law, wall, speed=1.0):
        sphere = Sphere((0, 0, 0), RADIUS, DENSITY, (-speed, 0, 0))
        e_star, r, m, v = (2.0 * E_STAR, RADIUS, sphere.mass, speed) if wall else \
            (E_STAR, 0.5 * RADIUS, 0.5 * sphere.mass, 2.0 * speed)
        time = hertz_time(m, r, e_star, v)
        dt = time / 2000.0
        sphere.position = (RADIUS + 0.5 * dt * speed, 0.0, 0.0)
        spheres = [sphere] if wall else [sphere, Sphere((-sphere.position[0], 0, 0), RADIUS, DENSITY, (speed, 0, 0))]
        rows, _ = self.rows(scene(spheres, f"pair_style granular\npair_coeff * * {law}", dt, 4000, 1,
                                  fixes=f"fix w all wall/gran granular {law} xplane 0.0 NULL" if wall else ""), code)
        duration = np.count_nonzero(rows[:, 0, F][:, 0]) * dt
        return rows[-1, 0, V][0] / speed, duration / time

    def test_restitution_of_tsuji(self):
        """Stock's fit is 1/sqrt 2 of the dashpot it should be: 0.928, 0.778, 0.616, 0.440 for 0.9, 0.7, 0.5, 0.3."""
        for e, stock in {0.9: 0.928, 0.7: 0.778, 0.5: 0.616, 0.3: 0.440}.items():
            for code in CODES:
                law = f"hertz/material {YOUNG} {e} {NU} damping tsuji tangential linear_nohistory 0.0 0.0"
                out, _ = self.rebound(code, law, wall=False)
                self.check(code, f"restitution {e}" + ("" if code else ", known defect"), out, e if code else stock,
                           FIRST_ORDER if code else STOCK_KNOWN)

    def test_modulus_of_walls(self):
        """A wall of the grain's material: E* = E/(2(1 - nu^2)); stock takes E/(2(1 - nu)), so the contact is shorter by (1 + nu)^(2/5)."""
        law = f"hertz/material {YOUNG} 0.0 {NU} damping velocity tangential linear_nohistory 0.0 0.0"
        for code in CODES:
            _, duration = self.rebound(code, law, wall=True)
            expected = 2.0 ** 0.4 * (1.0 if code else (1.0 + NU) ** -0.4)   # the time was that of a rigid wall
            self.check(code, "duration of a rebound" + ("" if code else ", known defect"), duration, expected,
                       FIRST_ORDER if code else STOCK_KNOWN)


if __name__ == "__main__":
    unittest.main(verbosity=2)
