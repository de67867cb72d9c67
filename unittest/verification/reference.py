# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Reference solutions: contacts of one sphere with a plane, solved in closed form or by a fine integration."""
import math

import numpy as np


def damping_ratio(e):
    """beta of a restitution e: -ln e/sqrt(pi^2 + ln^2 e)."""
    return -math.log(e) / math.hypot(math.pi, math.log(e))


def hertz_impact(e_star, g_star, radius, mass, e, mu, normal, surface, force_kept=False, steps=20000):
    """Hertz-Mindlin impact of a sphere on a plane, no tangential dashpot, for several surface velocities at once.

    surface: velocities of the contact point along the plane (m/s); force_kept: the tangential force is what is kept (mindlin/force),
    otherwise the spring (mindlin). The midpoint rule with 20 000 steps per collision time. Returns the normal speed after
    the impact and the surface velocities after it."""
    kn, kt = 4.0 / 3.0 * e_star * math.sqrt(radius), 8.0 * g_star * math.sqrt(radius)
    alpha = math.sqrt(5.0) * damping_ratio(e)
    dt = 2.868265 * (mass * mass / (radius * e_star * e_star * normal)) ** 0.2 / steps

    def push(overlap, rate):
        return kn * overlap ** 1.5 + alpha * math.sqrt(mass * kn * math.sqrt(overlap)) * rate

    overlap, rate = 0.0, normal
    slip, kept = np.array(surface, float), np.zeros(len(surface))   # kept: spring, or force
    while True:
        middle, speed = overlap + 0.5 * dt * rate, rate - 0.5 * dt * push(overlap, rate) / mass
        if middle <= 0.0:
            return -rate, slip
        force = push(middle, speed)
        stiffness, limit = kt * math.sqrt(middle), mu * abs(force)
        gain, weight = (1.0, stiffness) if force_kept else (stiffness, 1.0)   # of what is kept in the force; of slip in it
        pull = np.clip(gain * (kept + weight * 0.5 * dt * slip), -limit, limit)
        faster, slip = slip, slip - 3.5 * dt * pull / mass   # a force at the surface pushes and spins the sphere
        kept = np.clip(kept + weight * 0.5 * dt * (faster + slip), -limit / gain, limit / gain)
        overlap, rate = overlap + dt * speed, rate - dt * force / mass
        if overlap <= 0.0:
            return -rate, slip


class LinearContact:
    """Spring and dashpot at a plane under gravity: y'' = -g + w0^2 (R - y) - gamma y', contact while y < R."""

    def __init__(self, stiffness, mass, gamma, gravity, radius):
        self.w0, self.beta, self.g, self.radius = math.sqrt(stiffness / mass), 0.5 * gamma, gravity, radius
        self.w = math.sqrt(self.w0 ** 2 - self.beta ** 2)
        self.rest = -gravity / self.w0 ** 2      # of y - R

    def state(self, t, speed):
        """y - R and velocity a time t after touching with the given downward speed."""
        c, s, d = -self.rest, (-speed - self.beta * self.rest) / self.w, math.exp(-self.beta * t)
        cos, sin = math.cos(self.w * t), math.sin(self.w * t)
        y = d * (c * cos + s * sin)
        return self.rest + y, d * self.w * (s * cos - c * sin) - self.beta * y

    def duration(self, speed):
        """Time until y returns to R."""
        low, high = 0.5 * math.pi / self.w, 1.2 * math.pi / self.w + 4.0 * self.g / (self.w0 ** 2 * speed)
        for _ in range(200):
            t = 0.5 * (low + high)
            low, high = (t, high) if self.state(t, speed)[0] < 0.0 else (low, t)
        return 0.5 * (low + high)

    def bouncing(self, height, times):
        """Height of the centre at the given times (ascending), dropped from rest at a height; and speeds after each bounce."""
        fall = math.sqrt(2.0 * (height - self.radius) / self.g)
        flights, begin, speed, top = [], 0.0, self.g * fall, (0.0, height, 0.0)   # a flight: start, height, velocity
        out, rebounds = [], []
        touch = fall
        end = touch + self.duration(speed)
        for t in times:
            while t > end:
                _, v = self.state(end - touch, speed)
                rebounds.append(v)
                top = (end, self.radius, v)
                speed = v
                touch = end + 2.0 * v / self.g
                end = touch + self.duration(speed)
            if t < touch:
                s = t - top[0]
                out.append(top[1] + top[2] * s - 0.5 * self.g * s * s)
            else:
                out.append(self.radius + self.state(t - touch, speed)[0])
        return np.array(out), rebounds

    def pushes(self, speed):
        """Integral of |force|/mass over a contact without gravity; the dashpot pulls at the end."""
        t = math.atan2(2.0 * self.beta * self.w, self.beta ** 2 - self.w ** 2) / self.w   # acceleration 0: fastest rebound
        fastest = self.state(t, speed)[1]
        last = self.state(math.pi / self.w, speed)[1]
        return speed + 2.0 * fastest - last


def linear_response(matrix, constant, start, times):
    """Solution of s' = matrix s + constant at the given times, by eigenvectors."""
    rest = -np.linalg.solve(matrix, constant)
    values, vectors = np.linalg.eig(matrix)
    amplitude = np.linalg.solve(vectors, start - rest)
    return np.array([(vectors @ (np.exp(values * t) * amplitude)).real + rest for t in times])
