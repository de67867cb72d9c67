# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""The cases of the MFiX-DEM verification (Garg et al., Powder Technol. 220 (2012) 122; MFiX VVUQ DEM-01 to DEM-06), closed forms.

Free fall and bounce, repeated bounces, two spheres stacked between planes, slip to roll, terminal velocity. DEM-05, the oblique
impact, stands in test_oblique.py.
"""
import math
import unittest

import numpy as np

from reference import LinearContact, linear_response
from verification import CODES, V, W, X, Sphere, Verification, scene
from tolerance import BOUNCES, DRAG, FIRST_ORDER, FREE_FLIGHT, HARD_SPHERE, LINEAR_RESPONSE, SLIP_TO_ROLL

G = 9.81   # m/s^2
GRAVITY = f"fix g all gravity {G} vector 0 0 -1\n"


def linear_pair(kn=1.0, gamma=0.0):
    return f"pair_style gran/hooke {kn:.17g} 0.0 {gamma:.17g} 0.0 0.0 0\npair_coeff * *"


class Mfix(Verification):
    def bounce(self, code, stiffness, gamma, height, total, per_collision=2000, every=50):
        sphere = Sphere((0.0, 0.0, height), 0.1, 2600.0)
        contact = LinearContact(stiffness, sphere.mass, gamma, G, sphere.radius)
        dt = math.pi / contact.w / per_collision
        steps = int(total / dt) // every * every
        text = scene([sphere], linear_pair(), dt, steps, every, margin=3.0,
                     fixes=f"{GRAVITY}fix w all wall/gran hooke {stiffness:.17g} 0.0 {gamma:.17g} 0.0 0.0 0 zplane 0.0 NULL")
        rows, at = self.rows(text, code)
        return contact, at * dt, rows[:, 0]

    def test_1_free_fall_contact_and_bounce(self):
        """Height and speed of the first 0.9 s, through fall, contact and rise, for e from 0.6 to 1."""
        height, kn = 0.5, 5.0e4
        mass = Sphere((0, 0, 0), 0.1, 2600.0).mass
        for e in (0.6, 0.8, 1.0):
            ratio = -math.log(e) / math.hypot(math.pi, math.log(e))
            for code in CODES:
                contact, t, row = self.bounce(code, kn, 2.0 * ratio * math.sqrt(kn / mass), height, 0.9)
                expected, rebounds = contact.bouncing(height, t)
                touch = math.sqrt(2.0 * (height - 0.1) / G)
                end = touch + contact.duration(G * touch)
                for what, part, bound in (("fall", t < touch, FREE_FLIGHT), ("contact", (t >= touch) & (t <= end), FIRST_ORDER),
                                          ("after", t > end, FIRST_ORDER)):
                    worst = np.abs(row[:, 2] - expected)[part].argmax()
                    self.check(code, f"e {e}, height, {what}", row[part][worst, 2], expected[part][worst], bound, scale=height)
                risen = row[t > end][0]   # energy of the flight after the bounce
                speed = math.sqrt(risen[5] ** 2 + 2.0 * G * (risen[2] - 0.1))
                self.check(code, f"e {e}, rebound speed", speed, rebounds[0] if rebounds else math.nan, FIRST_ORDER)

    def test_2_repeated_bounces(self):
        """Tops of three bounces: closed form with gravity in the contact, and e^(2k) (h - R) of hard spheres."""
        height, kn, e = 0.5, 5.0e6, 0.8
        mass = Sphere((0, 0, 0), 0.1, 2600.0).mass
        gamma = -2.0 * math.log(e) / math.hypot(math.pi, math.log(e)) * math.sqrt(kn / mass)
        for code in CODES:
            contact, t, row = self.bounce(code, kn, gamma, height, 1.7, per_collision=500, every=5)
            tops = [row[k, 2] for k in range(1, len(t) - 1) if row[k - 1, 2] < row[k, 2] >= row[k + 1, 2] and row[k, 2] > 0.11]
            speed = math.sqrt(2.0 * G * (height - 0.1))
            for k, top in enumerate(tops[:3], 1):
                _, speed = contact.state(contact.duration(speed), speed)
                self.check(code, f"top of bounce {k}", top - 0.1, speed * speed / (2.0 * G), BOUNCES)
                self.check(code, f"top of bounce {k}, hard sphere", top - 0.1, e ** (2 * k) * (height - 0.1), HARD_SPHERE)
            self.assertGreaterEqual(len(tops), 3)

    def test_3_stacked_pair(self):
        """Two spheres of different density pressed between two planes: linear equations, solved by their eigenvectors."""
        radius, top = 5.0e-4, 3.6 * 5.0e-4
        pair_k, wall_k, pair_gamma, wall_gamma = 1.0e3, 1.5e3, 2.0e3, 1.0e3
        spheres = [Sphere((0, 0, 0.25 * top), radius, 20000.0), Sphere((0, 0, 0.75 * top), radius, 10000.0)]
        m1, m2 = (s.mass for s in spheres)
        both = m1 * m2 / (m1 + m2)
        matrix, constant = np.zeros((4, 4)), np.zeros(4)   # state: z1, z2, their velocities
        matrix[0, 2] = matrix[1, 3] = 1.0
        for row, mass, sign in ((2, m1, -1.0), (3, m2, 1.0)):
            matrix[row] = sign * np.array([pair_k, -pair_k, both * pair_gamma, -both * pair_gamma]) / mass
            matrix[row, row - 2] -= wall_k / mass
            matrix[row, row] -= wall_gamma
            constant[row] = -G + sign * pair_k * 2.0 * radius / mass
        constant[2] += wall_k * radius / m1
        constant[3] += wall_k * (top - radius) / m2
        period = 2.0 * math.pi * math.sqrt(m2 / (wall_k + pair_k))
        dt, steps = period / 2000.0, 10000
        text = scene(spheres, linear_pair(pair_k, pair_gamma), dt, steps, 100, fixes=GRAVITY +
                     f"fix w all wall/gran hooke {wall_k} 0.0 {wall_gamma} 0.0 0.0 0 zplane 0.0 {top:.17g}")
        for code in CODES:
            rows, at = self.rows(text, code)
            expected = linear_response(matrix, constant, np.array([s.position[2] for s in spheres] + [0.0, 0.0]), at * dt)
            self.assertGreater(np.ptp(expected[:, 0]), 1e-2 * radius)
            for k in (0, 1):
                for what, column, shown, scale in (("height", k, 2, 0.1 * radius),
                                                   ("velocity", k + 2, 5, np.abs(expected[:, 2:]).max())):
                    worst = np.abs(rows[:, k, shown] - expected[:, column]).argmax()
                    self.check(code, f"sphere {k + 1}, {what}", rows[worst, k, shown], expected[worst, column],
                               LINEAR_RESPONSE, scale=scale)

    def test_4_slip_to_roll(self):
        """Thrown flat: slows down by mu g until 2 u/(7 mu g), at 12 u^2/(49 mu g), then rolls with 5/7 u."""
        radius, u, mu, kn = 5.0e-3, 2.0, 0.3, 1.0e5
        sphere = Sphere((0, 0, radius), radius, 2500.0)
        sink = sphere.mass * G / kn
        sphere.position = (0.0, 0.0, radius - sink)
        sphere.velocity = (u, 0.0, 0.0)
        rolls, where = 2.0 * u / (7.0 * mu * G), 12.0 * u * u / (49.0 * mu * G)
        dt = math.pi * math.sqrt(sphere.mass / kn) / 50.0
        half, steps = int(0.5 * rolls / dt), int(1.5 * rolls / dt)
        steps -= steps % half
        text = scene([sphere], linear_pair(), dt, steps, half, boundary="p p f", fixes=GRAVITY +
                     f"fix w all wall/gran hooke/history {kn} {2.0 / 7.0 * kn:.17g} 2000.0 1000.0 {mu} 1 zplane 0.0 NULL")
        for code in CODES:
            rows, at = self.rows(text, code)
            first, last = rows[1, 0], rows[-1, 0]
            t, end = at[1] * dt, at[-1] * dt
            self.check(code, "speed while sliding", first[V][0], u - mu * G * t, SLIP_TO_ROLL)
            self.check(code, "spin while sliding", first[W][1] * radius, 2.5 * mu * G * t, SLIP_TO_ROLL)
            self.check(code, "way while sliding", first[X][0], u * t - 0.5 * mu * G * t * t, SLIP_TO_ROLL)
            self.check(code, "speed rolling", last[V][0], 5.0 / 7.0 * u, SLIP_TO_ROLL)
            self.check(code, "spin rolling", last[W][1] * radius, 5.0 / 7.0 * u, SLIP_TO_ROLL)
            self.check(code, "way", last[X][0], where + 5.0 / 7.0 * u * (end - rolls), SLIP_TO_ROLL)

    def test_6_terminal_velocity_stokes(self):
        """fix viscous: v = v_t (1 - exp(-t/tau)), tau = m/gamma, v_t = g tau."""
        sphere = Sphere((0, 0, 0.3), 5.0e-4, 2000.0)
        tau = 0.02
        dt, steps = tau / 10000.0, 100000
        text = scene([sphere], linear_pair(), dt, steps, steps // 20, boundary="p p p",
                     fixes=f"{GRAVITY}fix drag all viscous {sphere.mass / tau:.17g}")
        for code in CODES:
            rows, at = self.rows(text, code)
            for k in (1, 2, 4, 20):
                self.check(code, f"velocity at {at[k] * dt / tau:.1f} tau", -rows[k, 0, 5],
                           G * tau * (1.0 - math.exp(-at[k] * dt / tau)), DRAG, scale=G * tau)

    def test_6_terminal_velocity_schiller_naumann(self):
        """Drag 3 pi mu d v (1 + 0.15 Re^0.687) as a force of a variable, evaluated by the host in every step."""
        sphere = Sphere((0, 0, 0.3), 5.0e-4, 2000.0)
        viscosity, fluid, d = 1.8e-5, 1.2, 1.0e-3
        low, high = 0.0, 100.0
        for _ in range(200):   # weight = drag
            v = 0.5 * (low + high)
            drag = 3.0 * math.pi * viscosity * d * v * (1.0 + 0.15 * (fluid * v * d / viscosity) ** 0.687)
            low, high = (v, high) if drag < sphere.mass * G else (low, v)
        sphere.velocity = (0.0, 0.0, -0.99 * v)
        fixes = (f"neigh_modify delay 0 every 1 check yes\n{GRAVITY}variable c equal {3.0 * math.pi * viscosity * d:.17g}\n"
                 f"variable f atom -v_c*vz*(1.0+0.15*({fluid * d / viscosity:.17g}*abs(vz))^0.687)\n"
                 "fix drag all addforce 0.0 0.0 v_f\n")
        text = scene([sphere], linear_pair(), 1.0e-4, 20000, boundary="p p p", margin=20.0, skin=5.0e-3, fixes=fixes)
        for code in CODES:
            rows, _ = self.rows(text, code)
            self.check(code, "terminal velocity", -rows[-1, 0, 5], v, DRAG)


if __name__ == "__main__":
    unittest.main(verbosity=2)
