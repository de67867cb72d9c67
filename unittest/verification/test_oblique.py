# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Oblique impacts of spheres on a rigid plane: Thornton's series, Maw's regimes, the linear spring, grazing, zero slip.

All impacts of a series are one run: spheres side by side, too far apart to meet, and one wall. v_n is the normal speed, v_s the
velocity of the contact point along the plane, psi = v_s/(mu v_n), kappa = 2(1 - nu)/(2 - nu) the ratio of tangential to
normal stiffness.

- Thornton, Cummins, Cleary, Powder Technol. 233 (2013) 30: R 25 mm, 5 m/s, rho 2650, E 70 GPa, nu 0.3, mu 0.1.
- Maw, Barber, Fawcett, Wear 38 (1976) 101: sticking below psi = 1/kappa, sliding throughout above 7 - 1/kappa.
- Di Maio, Di Renzo, Chem. Eng. Sci. 59 (2004) 3461: a linear spring that sticks turns v_s by the angle pi sqrt(3.5 kt/kn).
"""
import math
import unittest

import numpy as np

from reference import LinearContact, hertz_impact
from verification import CODES, GPA, V, W, Sphere, Verification, hertz_mindlin, hertz_time, scene
from tolerance import ENERGY_GAIN, FIRST_ORDER, SAME, SLIDING, SPRING

RADIUS, DENSITY, YOUNG, NU, MU, SPEED = 0.025, 2650.0, 70.0 * GPA, 0.3, 0.1, 5.0
E_STAR = YOUNG / (1.0 - NU * NU)                  # rigid plane
G_STAR = YOUNG / (2.0 * (1.0 + NU) * (2.0 - NU))
KAPPA = 2.0 * (1.0 - NU) / (2.0 - NU)
PER_COLLISION = 4000


class Oblique(Verification):
    def impacts(self, code, velocities, wall, collision_time, spins=None):
        """Spheres with velocities (towards the wall at x = 0, along y) and spins about z; their states after the impact."""
        dt = collision_time / PER_COLLISION
        spheres = [Sphere((RADIUS + 0.5 * dt * n, 6.0 * RADIUS * k, 0.0), RADIUS, DENSITY, (-n, t, 0.0),
                          (0.0, 0.0, spins[k] if spins is not None else 0.0)) for k, (n, t) in enumerate(velocities)]
        pair = "pair_style gran/hooke/history 1.0 NULL 0.0 0.0 0.0 0\npair_coeff * *"   # they never meet
        text = scene(spheres, pair, dt, int(1.5 * PER_COLLISION), fixes=f"fix w all wall/gran {wall} xplane 0.0 NULL")
        rows, _ = self.rows(text, code)
        return rows[-1]

    def hertzian(self, code, velocities, e=1.0, tangential="mindlin"):
        slowest = min(n for n, _ in velocities)
        time = hertz_time(Sphere((0, 0, 0), RADIUS, DENSITY).mass, RADIUS, E_STAR, slowest)
        law = hertz_mindlin(code, YOUNG, NU, e, MU, True, tangential)
        return self.impacts(code, velocities, f"granular {law}", time)

    def test_thornton_angles(self):
        """Elastic: beyond tan = mu (7 - 2/(3 kappa)) sliding throughout, e_t = 1 - 2 mu/tan; the same law integrated below."""
        angles = np.array([1, 2, 5, 10, 15, 20, 25, 30, 35, 40, 45])
        normal, along = SPEED * np.cos(np.radians(angles)), SPEED * np.sin(np.radians(angles))
        mass = Sphere((0, 0, 0), RADIUS, DENSITY).mass
        expected = [hertz_impact(E_STAR, G_STAR, RADIUS, mass, 1.0, MU, n, [t])[1][0] for n, t in zip(normal, along)]
        for code in CODES:
            after = self.hertzian(code, list(zip(normal, along)))
            for a, n, t, v, w, slip in zip(angles, normal, along, after[:, V], after[:, W], expected):
                self.check(code, f"normal restitution at {a}", v[0] / n, 1.0, FIRST_ORDER)
                if t > MU * n * (7.0 - 2.0 / (3.0 * KAPPA)):
                    self.check(code, f"tangential restitution at {a}", v[1] / t, 1.0 - 2.0 * MU * n / t, SLIDING)
                    self.check(code, f"normalised spin at {a}", RADIUS * w[2] / (MU * n), 5.0, SLIDING)
                else:
                    self.check(code, f"v_s, part of mu v_n, at {a}", (v[1] - RADIUS * w[2]) / (MU * n), slip / (MU * n),
                               SPRING, scale=1.0 + t / (MU * n))

    def test_thornton_restitution(self):
        """The same with damping, e = 0.25, 0.5, 0.75, 0.9 (the dashpot pulls at the end, so the sliding impulse exceeds (1+e) v_n)."""
        angles = np.array([5, 15, 30, 45])
        normal, along = SPEED * np.cos(np.radians(angles)), SPEED * np.sin(np.radians(angles))
        mass = Sphere((0, 0, 0), RADIUS, DENSITY).mass
        for e in (0.25, 0.5, 0.75, 0.9):
            expected = [hertz_impact(E_STAR, G_STAR, RADIUS, mass, e, MU, n, [t]) for n, t in zip(normal, along)]
            for code in CODES:
                after = self.hertzian(code, list(zip(normal, along)), e)
                for a, n, t, v, w, (_, slip) in zip(angles, normal, along, after[:, V], after[:, W], expected):
                    self.check(code, f"e {e} at {a}", v[0] / n, e, FIRST_ORDER, scale=1.0)
                    self.check(code, f"e {e}, v_s of mu v_n at {a}", (v[1] - RADIUS * w[2]) / (MU * n), slip[0] / (MU * n),
                               SPRING, scale=1.0 + t / (MU * n))

    def test_maw_regimes(self):
        """Sticking at first, sliding at both ends, sliding throughout, for the spring and for the force that is kept.

        Where sliding lasts throughout: mindlin/force has Maw's bound 7 - 1/kappa; the spring of mindlin is as long as
        its force allows only if v_s stays above -(2/3) mu v_n/kappa, so 7 - 2/(3 kappa)."""
        mass = Sphere((0, 0, 0), RADIUS, DENSITY).mass
        for tangential, bound in (("mindlin", 7.0 - 2.0 / (3.0 * KAPPA)), ("mindlin/force", 7.0 - 1.0 / KAPPA)):
            psi = np.array([0.1, 0.5, 1.0, 2.0, 4.0, 0.9 * bound, 1.01 * bound, 1.5 * bound])
            _, expected = hertz_impact(E_STAR, G_STAR, RADIUS, mass, 1.0, MU, SPEED, psi * MU * SPEED,
                                       tangential == "mindlin/force")
            self.assertGreater((expected / (MU * SPEED) - (psi - 7.0))[5], 0.01)   # below the bound it rebounds with more
            for code in CODES:
                after = self.hertzian(code, [(SPEED, p * MU * SPEED) for p in psi], tangential=tangential)
                for p, v, w, slip in zip(psi, after[:, V], after[:, W], expected):
                    out = (v[1] - RADIUS * w[2]) / (MU * SPEED)
                    self.check(code, f"{tangential}, psi {p:.3g}", out, slip / (MU * SPEED), SPRING, scale=1.0 + p)
                    if p > bound:
                        self.check(code, f"{tangential}, psi {p:.3g}, sliding", out, p - 7.0, SLIDING, scale=p)

    def linear(self, gamma=0.0, friction=10.0, kt=None):
        kn = 1.0e7
        kt = 2.0 / 7.0 * kn if kt is None else kt
        contact = LinearContact(kn, Sphere((0, 0, 0), RADIUS, DENSITY).mass, gamma, 0.0, RADIUS)
        return contact, f"hooke/history {kn} {kt:.17g} {gamma} 0.0 {friction} 1", math.pi / contact.w

    def test_linear_spring_sticks(self):
        """kt = 2/7 kn: half a period of both springs, the contact point turns back with the speed it came with."""
        for kt, turned in ((2.0 / 7.0, -1.0), (8.0 / 7.0, 1.0)):
            _, law, time = self.linear(kt=kt * 1.0e7)
            for code in CODES:
                after = self.impacts(code, [(SPEED, 0.1), (SPEED, 1.0), (SPEED, 10.0)], law, time)
                for t, v, w in zip((0.1, 1.0, 10.0), after[:, V], after[:, W]):
                    self.check(code, f"kt/kn {kt:.3g}, v_s of {t}", (v[1] - RADIUS * w[2]) / t, turned, SPRING)
                    self.check(code, f"kt/kn {kt:.3g}, v_t of {t}", v[1] / t, 1.0 - 2.0 / 7.0 * (1.0 - turned), SPRING)

    def test_linear_spring_slides(self):
        """MFiX-DEM 05 with spring and dashpot: restitution exp(-pi beta/w), sliding by mu times the integral of |F|."""
        angles = np.array([40, 50, 60, 70, 80])
        normal, along = 3.9 * np.cos(np.radians(angles)), 3.9 * np.sin(np.radians(angles))
        for restitution in (0.98, 0.5):
            kn, mass = 1.0e7, Sphere((0, 0, 0), RADIUS, DENSITY).mass
            ratio = -math.log(restitution) / math.hypot(math.pi, math.log(restitution))
            # a stiff spring is soon stretched again after the force has passed zero and changed its sign
            contact, law, time = self.linear(2.0 * ratio * math.sqrt(kn / mass), 0.092, kt=50.0 * kn)
            for code in CODES:
                after = self.impacts(code, list(zip(normal, along)), law, time)
                for a, n, t, v, w in zip(angles, normal, along, after[:, V], after[:, W]):
                    lost = 0.092 * contact.pushes(n)
                    self.check(code, f"e {restitution} at {a}", v[0] / n, restitution, FIRST_ORDER)
                    self.check(code, f"e {restitution}, e_t at {a}", v[1] / t, 1.0 - lost / t, FIRST_ORDER)
                    self.check(code, f"e {restitution}, spin at {a}", RADIUS * w[2], 2.5 * lost, FIRST_ORDER)

    def test_grazing_gains_no_energy(self):
        """Undamped laws at flat angles, down to 0.2 degrees: the energy of translation and rotation may only fall.

        (Wall contacts of LAMMPS from 28 Mar 2023 to mid 2026 gain up to a third: the spring was scaled by the contact radius.)"""
        angles = np.array([45.0, 60.0, 70.0, 80.0, 85.0, 88.0, 89.0, 89.8])
        normal, along = SPEED * np.cos(np.radians(angles)), SPEED * np.sin(np.radians(angles))
        time = hertz_time(Sphere((0, 0, 0), RADIUS, DENSITY).mass, RADIUS, E_STAR, normal.min())
        for name in ("hooke/history", "hertz/history", "mindlin", "mindlin_rescale", "mindlin/force"):
            for code in CODES:
                if name == "hooke/history":
                    after = self.impacts(code, list(zip(normal, along)), self.linear(friction=0.5)[1], self.linear()[2])
                elif name == "hertz/history":
                    law = f"hertz/history {4.0 / 3.0 * E_STAR:.17g} {8.0 * G_STAR:.17g} 0.0 0.0 {MU} 0"
                    after = self.impacts(code, list(zip(normal, along)), law, time)
                else:
                    after = self.hertzian(code, list(zip(normal, along)), tangential=name)
                energy = (after[:, V] ** 2).sum(1) + 0.4 * RADIUS ** 2 * (after[:, W] ** 2).sum(1)
                self.assertTrue((after[:, V][:, 0] > 0.0).all(), f"{name}: all must have left the wall")
                self.check(code, f"{name}: energy gained", max(0.0, (energy / SPEED ** 2).max() - 1.0), 0.0, ENERGY_GAIN)
                self.assertLess((energy / SPEED ** 2).min(), 0.99, f"{name}: friction must have acted")

    def test_zero_slip(self):
        """A spin with R omega = v_t: the contact point rests, nothing acts along the wall and the spin stays."""
        along = np.array([0.1, 1.0, 5.0])
        for code in CODES:
            time = hertz_time(Sphere((0, 0, 0), RADIUS, DENSITY).mass, RADIUS, E_STAR, SPEED)
            law = f"granular {hertz_mindlin(code, YOUNG, NU, 1.0, MU, True)}"
            after = self.impacts(code, [(SPEED, t) for t in along], law, time, spins=along / RADIUS)
            for t, v, w in zip(along, after[:, V], after[:, W]):
                self.check(code, f"spin at v_t {t}", w[2] * RADIUS, t, SAME, scale=SPEED)
                self.check(code, f"v_t at v_t {t}", v[1], t, SAME, scale=SPEED)
                self.check(code, f"rebound at v_t {t}", v[0], SPEED, FIRST_ORDER)


if __name__ == "__main__":
    unittest.main(verbosity=2)
