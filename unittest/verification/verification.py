# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Cases with known answers: spheres, laws and walls as LAMMPS input, and the comparison of measured with expected.

Every case runs in stock LAMMPS and in GPUDEM, double and mixed, on a GPU if there is one (GPUDEM_DEVICE decides otherwise). With
GPUDEM_TEST_REPORT set, each comparison is printed: measured, expected, relative error, tolerance and its reason.
"""
import math
import os
import pathlib
import re
import sys
from dataclasses import dataclass

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "styles"))
from lammps import StylesTest  # noqa: E402

CODES = (None, "double", "mixed")   # None: stock LAMMPS
GPA = 1.0e9
COLUMNS = "id xu yu zu vx vy vz omegax omegay omegaz fx fy fz"
X, V, W, F = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)   # of a row without its id


@dataclass
class Sphere:
    """SI units; the mass follows from radius and density."""
    position: tuple
    radius: float
    density: float
    velocity: tuple = (0.0, 0.0, 0.0)
    spin: tuple = (0.0, 0.0, 0.0)

    @property
    def mass(self):
        return 4.0 / 3.0 * math.pi * self.radius ** 3 * self.density


def stock_tsuji_argument(e):
    """Argument for which stock's fit of damping tsuji gives the dashpot sqrt(5) beta of restitution e."""
    alpha = -math.sqrt(5.0) * math.log(e) / math.hypot(math.pi, math.log(e))
    low, high = -1.0, 1.01   # the fit is 3e-4 at 1, and 0 a little later
    for _ in range(200):
        c = 0.5 * (low + high)
        fit = 1.2728 + c * (-4.2783 + c * (11.087 + c * (-22.348 + c * (27.467 + c * (-18.022 + c * 4.8218)))))
        low, high = (c, high) if fit > alpha else (low, c)
    return 0.5 * (low + high)


def hertz_mindlin(code, young, nu, e, mu, wall, tangential="mindlin"):
    """Words of the contact law without tangential dashpot; of a rigid plane (a material of twice the modulus) if wall is set.

    Stock LAMMPS gets other numbers where it is wrong (its fit of damping tsuji, modulus and tangential stiffness of walls), so
    that all codes answer the same question."""
    if wall:
        young = 2.0 * young
    damping = f"{e}" if code else f"{stock_tsuji_argument(e):.17g}"
    words = "coeff_restitution" if code else "tsuji"
    kt = "NULL"
    if wall and not code:
        kt = f"{8.0 * young / (4.0 * (2.0 - nu) * (1.0 + nu)):.17g}"
        young = young / (1.0 - nu * nu) * (1.0 - nu)
    return f"hertz/material {young:.17g} {damping} {nu} damping {words} tangential {tangential} {kt} 0.0 {mu}"


def hertz_time(mass, radius, e_star, speed):
    """Duration of an elastic Hertzian collision, 2.868265 (m^2/(R E*^2 v))^(1/5); effective mass and radius (Hertz 1882)."""
    return 2.868265 * (mass * mass / (radius * e_star * e_star * speed)) ** 0.2


def scene(spheres, pair, dt, steps, every=None, fixes="", boundary="f f f", margin=2.0, skin=None, columns=COLUMNS):
    """LAMMPS input. pair: pair_style and pair_coeff lines; fixes: lines behind the integrator; a dump every so many steps."""
    largest = max(s.radius for s in spheres)
    at = np.array([s.position for s in spheres], float)
    lo, hi = at.min(0) - margin * largest * 2.0, at.max(0) + margin * largest * 2.0
    text = (f"units si\natom_style sphere\nboundary {boundary}\nnewton off\ncomm_modify vel yes\n"
            "region box block " + " ".join(f"{a:.17g} {b:.17g}" for a, b in zip(lo, hi)) + " units box\ncreate_box 1 box\n")
    for k, s in enumerate(spheres, 1):
        x, v, w = (" ".join(f"{c:.17g}" for c in u) for u in (s.position, s.velocity, s.spin))
        vx, vy, vz = v.split()
        text += (f"create_atoms 1 single {x} units box\nset atom {k} diameter {2.0 * s.radius:.17g} density {s.density:.17g}\n"
                 f"set atom {k} vx {vx} vy {vy} vz {vz}\nset atom {k} omega {w}\n")
    return (text + f"{pair}\nneighbor {skin or 0.1 * largest:.17g} bin\ntimestep {dt:.17g}\nfix move all nve/sphere\n{fixes}\n"
            f"dump out all custom {every or steps} dump.out {columns}\n"
            f"dump_modify out sort id format float %.17g\nthermo {steps}\nrun {steps}\n")


class Verification(StylesTest):
    def rows(self, text, code, resident=True, **options):
        """[snapshot][sphere][x 3, v 3, omega 3, force 3], and the steps of the snapshots."""
        run = self.run_lammps(text, gpudem=code, **options)
        self.device = "host"
        if code:
            self.device = re.search(r"device +: (\w+)", run.everything).group(1)
            if resident:
                self.assertResident(run)
        dump = run.dump()
        steps = sorted(dump)
        return np.array([dump[s][1][:, 1:] for s in steps]), np.array(steps)

    def check(self, code, what, measured, expected, bound, scale=None):
        """|measured - expected| within the bound, relative to the expected value, or to a scale where that may vanish."""
        error = abs(measured - expected) / (scale or abs(expected) or 1.0)
        if os.environ.get("GPUDEM_TEST_REPORT"):
            print(f"{self._testMethodName[5:]:34s} {code or 'stock':6s} {self.device:4s} {what:34s} measured {measured:14.7g} "
                  f"expected {expected:14.7g} error {error:.1e} tolerance {bound.relative:.0e}: {bound.reason}")
        self.assertLessEqual(error, bound.relative, f"{code or 'stock'} {what}: {measured} for {expected} ({bound.reason})")
