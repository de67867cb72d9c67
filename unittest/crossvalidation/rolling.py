# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""A sphere that rolls on a plane without slip until rolling friction has stopped it.

Force and couple at the contact slow it by a = 5/7 mu_r g (moment of inertia 2/5 m R^2), so it stops after v0^2/(2 a).
"""
import math

from collisions import G, collision_time
from scene import Law, Plane, Scene

RADIUS, SPEED, MU = 5.0e-3, 0.3, 0.1
DECELERATION = 5.0 / 7.0 * MU * G
DISTANCE = SPEED ** 2 / (2.0 * DECELERATION)
MODELS = ("cdt", "epsd", "epsd2", "epsd3")
AFTER = 1.4     # run time in units of the time to stop


def rolls(model):
    law = Law("hooke/stiffness", friction=0.5, kn=2.0e4, kt=1.0e4, rolling=model, rolling_friction=MU, rolling_viscosity=0.3,
              rolling_stiffness=1.0)
    mass = 4.0 / 3.0 * math.pi * RADIUS ** 3 * 2500.0
    dt = collision_time(law, mass, 0.0, 0.0) / 50.0
    steps = int(AFTER * SPEED / DECELERATION / dt)
    at = RADIUS * (1.0 + 1.0e-9)   # it lands: see carried() for the first forces of a run
    return Scene(f"rolling, {model}", law, [[0.0, 0.0, at]], [RADIUS], dt, steps, [[SPEED, 0.0, 0.0]], [[0.0, SPEED / RADIUS, 0.0]],
                 walls=(Plane("z", 0.0),), gravity=G, every=200, boundary="f f f",
                 box=((-2.0 * RADIUS, -4.0 * RADIUS, 0.0), (2.0 * DISTANCE, 4.0 * RADIUS, 10.0 * RADIUS)))
