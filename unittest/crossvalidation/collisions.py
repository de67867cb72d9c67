# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Single contacts, step by step: each scene isolates one term of the law.

A pair has radii of 5 and 3 mm, so that effective radius, effective mass and the lens of sjkr are not those of equal spheres, and lies
along no axis. A wall is the plane z = 0.
"""
import math

import numpy as np

from scene import FIELDS, Law, Plane, Scene

ALONG = np.array([0.6, 0.64, 0.48]) / math.sqrt(0.6 ** 2 + 0.64 ** 2 + 0.48 ** 2)
SIDE = np.cross(ALONG, [0.0, 0.0, 1.0]) / np.linalg.norm(np.cross(ALONG, [0.0, 0.0, 1.0]))
RADII = np.array([5.0e-3, 3.0e-3])
FLOOR = (Plane("z", 0.0),)
SMOOTH = Law(friction=0.0)
DRY = Law(friction=0.3, tangential_damping=False)
DAMPED = Law(friction=0.3)
LINEAR = Law("hooke/stiffness", friction=0.3)


def collision_time(law, mass, radius, speed):
    """Duration of an elastic collision: Hertz 2.868265 (m^2/(R E*^2 v))^(1/5), linear pi sqrt(m/kn); effective mass and radius."""
    effective = law.young / (2.0 * (1.0 - law.nu ** 2))
    if law.normal == "hooke/stiffness":
        return math.pi * math.sqrt(mass / law.kn)
    return 2.868265 * (mass ** 2 / (radius * effective ** 2 * speed)) ** 0.2


def pair(name, law, speed=1.0, slide=0.0, spins=((0, 0, 0), (0, 0, 0)), per_collision=400, **options):
    """Two spheres that meet; per_collision time steps in an elastic collision, twice that in the run."""
    x = np.array([0.0 * ALONG, RADII.sum() * (1.0 + 1.0e-6) * ALONG])
    v = np.array([0.5 * speed * ALONG + slide * SIDE, -0.5 * speed * ALONG])
    m = 4.0 / 3.0 * math.pi * RADII ** 3 * 2500.0
    time = collision_time(law, m.prod() / m.sum(), RADII.prod() / RADII.sum(), speed)
    return Scene(name, law, x, RADII, time / per_collision, 2 * per_collision, v, spins, **options)


def impact(name, law, speed=1.0, slide=0.0, spin=(0, 0, 0), per_collision=400, **options):
    """A sphere that meets the plane z = 0."""
    r = 5.0e-3
    time = collision_time(law, 4.0 / 3.0 * math.pi * r ** 3 * 2500.0, r, speed)
    return Scene(name, law, [[0.0, 0.0, r * (1.0 + 1.0e-6)]], [r], time / per_collision, 2 * per_collision, [[slide, 0.0, -speed]],
                 [spin], walls=FLOOR, boundary="p p f", **options)


def rolling(model, **others):
    return Law(friction=0.5, rolling=model, rolling_friction=0.1, rolling_viscosity=0.3, **others)


SPINS = ((30.0, -50.0, 80.0), (-60.0, 20.0, 10.0))
TURNS = (40.0, 60.0, 20.0)


def terms():
    """(term, scene): where the laws are meant to be the same."""
    sticky = Law(friction=0.3, cohesion="sjkr", energy_density=1.0e5)
    rows = [("normal: hertz", pair("hertz", SMOOTH)),
            ("normal: hertz, plane", impact("hertz, plane", SMOOTH)),
            ("normal: hooke/stiffness", pair("hooke/stiffness", Law("hooke/stiffness"))),
            ("normal: hooke (E, V)", pair("hooke", Law("hooke"))),
            ("tangential: hertz, no dashpot", pair("hertz oblique", DRY, slide=0.8, spins=SPINS)),
            ("tangential: hertz, dashpot, sticks and slides", pair("hertz dashpot", DAMPED, slide=0.8, spins=SPINS)),
            ("tangential: hertz, slides", pair("hertz slides", DAMPED, slide=3.0)),
            ("tangential: hooke/stiffness", pair("hooke/stiffness oblique", LINEAR, slide=0.8, spins=SPINS)),
            ("tangential: hooke (E, V)", pair("hooke oblique", Law("hooke", friction=0.3), slide=0.8, spins=SPINS)),
            ("tangential: hertz, plane", impact("hertz plane", DAMPED, slide=0.8, spin=TURNS)),
            ("tangential: hooke/stiffness, plane", impact("hooke/stiffness plane", LINEAR, slide=0.8, spin=TURNS)),
            ("tangential: moving plane", Scene.changed(impact("moving plane", DAMPED, spin=TURNS), walls=(Plane("z", 0.0, shear=("x", 0.7)),)))]
    rows += [(f"rolling: {m}", pair(m, rolling(m), spins=SPINS)) for m in ("cdt", "epsd", "epsd2", "epsd3")]
    rows += [("rolling: cdt, plane", impact("cdt, plane", rolling("cdt"), spin=TURNS)),
             ("cohesion: sjkr", pair("sjkr", sticky, slide=0.8, spins=SPINS)),
             ("cohesion: sjkr2", pair("sjkr2", Law(friction=0.3, cohesion="sjkr2", energy_density=1.0e5), slide=0.8, spins=SPINS)),
             ("cohesion: sjkr, plane", impact("sjkr, plane", sticky, slide=0.8, spin=TURNS)),
             ("cohesion: sjkr in the Coulomb limit", pair("sjkr, net", Law(friction=0.3, cohesion="sjkr", energy_density=1.0e5, net=True),
                                                         slide=0.8, spins=SPINS))]
    return rows


def differences(scene, a, b):
    """{field: largest difference over all steps and grains}, relative to the largest magnitude of the field in b.

    Positions in radii; fields that vanish throughout are left out."""
    result = {}
    for name, columns in FIELDS.items():
        scale = scene.radius.min() if name == "position" else np.linalg.norm(b[:, :, columns], axis=2).max()
        if scale > 0.0 or np.abs(a[:, :, columns]).max() > 0.0:
            result[name] = np.linalg.norm(a[:, :, columns] - b[:, :, columns], axis=2).max() / (scale or 1.0)
    return result


# ---- questions about LIGGGHTS: GPUDEM is given each reading in turn, and one of them has to agree to round-off

G = 9.81


def carried(name, law, depth=0.04, **options):
    """A sphere that lies on the plane z = 0 at the overlap depth*R that carries it; the plane moves and turns it.

    It does not spin at first: in the forces at the start of a run LIGGGHTS lets rolling springs grow by one step that it does not keep."""
    r = 5.0e-3
    mass = 4.0 / 3.0 * math.pi * r ** 3 * 2500.0
    law = Law(**{**law.__dict__, "kn": mass * G / (depth * r), "kt": 0.5 * mass * G / (depth * r)})
    return Scene(name, law, [[0.0, 0.0, r * (1.0 - depth)]], [r], collision_time(law, mass, r, 0.0) / 400, 800,
                 walls=(Plane("z", 0.0, shear=("x", 1.0)),), gravity=G, boundary="p p f", **options)


def disc(name, law):
    """A pair that moves in the plane, spins normal to it."""
    mass = 4.0 / 3.0 * math.pi * RADII ** 3 * 2500.0
    dt = collision_time(law, mass.prod() / mass.sum(), 0.0, 0.0) / 400
    return Scene(name, law, [[0, 0, 0], [RADII.sum() * (1.0 + 1.0e-6), 0, 0]], RADII, dt, 800, [[0.5, 0.1, 0.0], [-0.5, 0.0, 0.0]],
                 [[0, 0, 30], [0, 0, 80]], planar=True, boundary="f f p", box=((-0.04, -0.04, -0.005), (0.04, 0.04, 0.005)))


def read_as(scene, **changes):
    """The scene with another law for GPUDEM, the same for LIGGGHTS."""
    return scene.changed(gpudem_law=Law(**{**scene.law.__dict__, **changes}))


def questions():
    """(question, {reading: scene}, the reading that LIGGGHTS 3.8 follows)."""
    linear = dict(normal="hooke/stiffness", friction=0.3, rolling_friction=0.1, rolling_viscosity=0.3)
    sticky = pair("sjkr", Law(friction=0.3, cohesion="sjkr", energy_density=1.0e5), slide=3.0)
    reduced = sticky.changed(law_changes={"net": True})
    torque = carried("cdt on a plane", Law(**linear, rolling="cdt"))
    spring = carried("epsd on a plane", Law(**linear, rolling="epsd3"))
    tangential = carried("epsd2 on a plane", Law(**linear, rolling="epsd2"))
    flat = disc("epsd in two dimensions", Law(**linear, rolling="epsd3"))
    depth = 0.04
    s = (1.0 - 0.5 * depth) / (1.0 - depth)
    return [
        ("sjkr: does the attraction count in the Coulomb limit?",
         {"no": sticky, "yes": read_as(sticky, net=True)}, "no"),
        ("sjkr with tangential_reduce on: the same question",
         {"no": read_as(reduced, net=False), "yes": reduced}, "yes"),
        ("cdt at a plane: arm of the torque?",
         {"R": torque, "R - overlap/2": read_as(torque, rolling_friction=0.1 * (1.0 - 0.5 * depth)),
          "R - overlap": read_as(torque, rolling_friction=0.1 * (1.0 - depth))}, "R"),
        ("epsd, epsd3 at a plane: which spin stretches the spring?",
         {"w": spring, "w (R - overlap/2)/(R - overlap)": read_as(spring, rolling_stiffness=2.25 * s,
                                                                 rolling_viscosity=0.3 * math.sqrt(s))},
         "w (R - overlap/2)/(R - overlap)"),
        ("epsd2 at a plane: the same question",
         {"w": tangential, "w (R - overlap/2)/(R - overlap)": read_as(tangential, rolling="epsd3", rolling_viscosity=0.0,
                                                                      rolling_stiffness=0.5 * s / 0.1 ** 2)},
         "w (R - overlap/2)/(R - overlap)"),
        ("epsd in two dimensions: inertia of its dashpot?",
         {"1.4 m R^2": flat, "1.5 m R^2": read_as(flat, rolling_viscosity=0.3 * math.sqrt(1.5 / 1.4))}, "1.5 m R^2"),
    ]


def in_parts(rolls, parts):
    """A sphere on a plane that slides (or rolls, with epsd), 1200 steps in so many runs: the forces at the start of a run count half a step."""
    law = Law("hooke/stiffness", friction=0.9 if rolls else 0.1, kn=2.0e4, kt=1.0e4, gamman=500.0, gammat=500.0,
              rolling="epsd" if rolls else "", rolling_friction=0.1, rolling_viscosity=0.3)
    r, steps = 5.0e-3, 1200 // parts
    mass = 4.0 / 3.0 * math.pi * r ** 3 * 2500.0
    return Scene("rolls" if rolls else "slides", law, [[0.0, 0.0, r - mass * G / law.kn]], [r], collision_time(law, mass, r, 0.0) / 100, steps,
                 [[1.0, 0.0, 0.0]], [[0.0, 1.0 / r if rolls else 0.0, 0.0]], walls=FLOOR, then=((FLOOR, steps),) * (parts - 1), gravity=G,
                 every=1200, boundary="p p f")
