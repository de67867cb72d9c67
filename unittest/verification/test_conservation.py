# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Momentum and angular momentum of a closed system of 10^4 grains, which nothing but their contacts acts on.

pair granular: its torque arms end at the contact, so that contacts exchange angular momentum and make none. Friction, dashpots and
adhesion (dmt), which holds the cluster together, so that it never runs out of contacts; it turns, with random velocities and
spins. 1000 steps; 10^5 with GPUDEM_LONG set.
"""
import os
import unittest

import numpy as np

from verification import CODES, V, W, X, Verification
from tolerance import closed_system

SIDE, RADIUS, DENSITY = 22, 0.5, 1.0
STEPS = 100000 if os.environ.get("GPUDEM_LONG") else 1000


def cluster():
    """Data file of a jittered cubic lattice of 22^3 = 10 648 spheres, next to touching."""
    random = np.random.default_rng(7)
    grid = np.stack(np.meshgrid(*[np.arange(SIDE) - 0.5 * (SIDE - 1)] * 3, indexing="ij"), -1).reshape(-1, 3)
    x = 1.0005 * grid + random.uniform(-5e-4, 5e-4, grid.shape)
    v = random.normal(0.0, 0.1, x.shape) - 0.02 * x + 0.02 * np.cross((0.0, 0.3, 1.0), x)
    w = random.normal(0.0, 0.3, x.shape)
    edge = SIDE
    lines = [f"closed system\n\n{len(x)} atoms\n1 atom types\n"] + [f"{-edge} {edge} {a}lo {a}hi" for a in "xyz"]
    lines += ["\nAtoms # sphere\n"] + [f"{n} 1 {2 * RADIUS} {DENSITY} " + " ".join(f"{c:.17g}" for c in p)
                                       for n, p in enumerate(x, 1)]
    lines += ["\nVelocities\n"] + [f"{n} " + " ".join(f"{c:.17g}" for c in (*a, *b)) for n, (a, b) in enumerate(zip(v, w), 1)]
    return "\n".join(lines) + "\n"


INPUT = f"""units lj
atom_style sphere
boundary s s s
newton off
comm_modify vel yes
read_data data.cluster
pair_style granular
pair_coeff * * dmt 1.0e4 0.5 0.3 2.0 damping tsuji tangential mindlin NULL 1.0 0.5
neighbor 0.1 bin
neigh_modify delay 0 every 1 check yes
timestep 1.0e-3
fix move all nve/sphere
dump out all custom {STEPS} dump.out id x y z vx vy vz omegax omegay omegaz fx fy fz
dump_modify out sort id format float %.17g
thermo {STEPS}
run {STEPS}
"""


class Closed(Verification):
    def test_momentum_and_angular_momentum(self):
        data = cluster()
        mass = 4.0 / 3.0 * np.pi * RADIUS ** 3 * DENSITY
        for code in CODES:
            rows, at = self.rows(INPUT, code, files=[("data.cluster", data)], timeout=7200)
            first, last = rows[0], rows[-1]
            self.assertEqual(at[-1], STEPS)
            self.assertEqual(len(last), SIDE ** 3)

            def angular(s):
                return mass * np.cross(s[:, X], s[:, V]) + 0.4 * mass * RADIUS ** 2 * s[:, W]

            bound = closed_system(code, STEPS, len(first))
            for what, of in (("momentum", lambda s: mass * s[:, V]), ("angular momentum", angular)):
                before, after = of(first).sum(0), of(last).sum(0)
                scale = np.linalg.norm(of(first), axis=1).sum()   # of all magnitudes
                for name, a, b in zip("xyz", after, before):
                    self.check(code, f"{what} {name}", a, b, bound, scale=scale)
            extent = np.linalg.norm(last[:, X] - last[:, X].mean(0), axis=1)
            self.assertLess(np.median(extent), 1.5 * SIDE * RADIUS, "the grains must still touch each other")
            spread = np.linalg.norm(last[:, V] - first[:, V], axis=1).mean() / np.linalg.norm(first[:, V], axis=1).mean()
            self.assertGreater(spread, 0.1, "the grains must have collided")


if __name__ == "__main__":
    unittest.main(verbosity=2)
