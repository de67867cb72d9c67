# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""pair_style granular and fix wall/gran granular: every sub-model against stock LAMMPS, dense clouds of two types.

Stock LAMMPS turns rolling and twisting springs round whenever a rebuild lists a pair the other way round, and mixes
unlike types wrongly: the skins here are so large that stock never rebuilds, and every pair of types has its own
pair_coeff.
"""
import math
import unittest
from dataclasses import dataclass, field

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests
from tolerance import DOUBLE, MIXED

NVE = "fix move all nve/sphere"
HERTZ = "hertz 2.0e5 20.0"
HOOKE = "hooke 2.0e4 50.0 damping velocity"
MATERIAL = "hertz/material 2.0e5 20.0 0.3"
MINDLIN = "tangential mindlin NULL 0.6 0.4"
ROLLING = "rolling sds 1.0e4 30.0 0.2"
NO_REBUILD = dict(skin=0.4, neighbor="delay 100000 every 100000 check no")


def stock_tsuji_argument(e):
    """Argument for which stock's fit of damping tsuji gives the dashpot sqrt(5) beta of restitution e (Hertz)."""
    alpha = -math.sqrt(5.0) * math.log(e) / math.hypot(math.pi, math.log(e))
    low, high = 0.0, 1.0
    for _ in range(100):
        c = 0.5 * (low + high)
        fit = 1.2728 + c * (-4.2783 + c * (11.087 + c * (-22.348 + c * (27.467 + c * (-18.022 + c * 4.8218)))))
        low, high = (c, high) if fit > alpha else (low, c)
    return 0.5 * (low + high)


def three(law, law12=None, law22=None):
    """pair_coeff of types 1 1, 1 2 and 2 2."""
    return tuple(f"{t} {w}" for t, w in zip(("1 1", "1 2", "2 2"), (law, law12 or law, law22 or law)))


@dataclass
class Case:
    coeff: tuple
    scene: dict = field(default_factory=dict)
    cloud: dict = field(default_factory=dict)
    stock_words: tuple = ()    # (ours, stock's) words: where GPUDEM is right and stock can be made right by other numbers


def _normal():
    rest = "tangential linear_history 5.0e3 0.5 0.4"
    yield "hooke", Case(three(f"{HOOKE} {rest}"))
    yield "hertz", Case(three(f"{HERTZ} {rest}"))
    yield "hertz_material", Case(three(f"{MATERIAL} {rest}"))
    # stock takes the Coulomb limit of dmt from a number that it never sets: no friction here
    yield "dmt", Case(three("dmt 2.0e5 20.0 0.3 50.0 tangential linear_nohistory 0.0 0.0"))
    yield "jkr", Case(three(f"jkr 2.0e5 20.0 0.3 50.0 {rest}"))
    yield "limit_damping", Case(three(f"hertz 2.0e5 200.0 {rest} limit_damping"))


def _damping():
    for name in ("velocity", "mass_velocity", "viscoelastic"):
        yield name, Case(three(f"hertz 2.0e5 30.0 damping {name} tangential linear_nohistory 0.5 0.4"))
        yield name + "_hooke", Case(three(f"hooke 2.0e4 30.0 damping {name} tangential linear_history 5.0e3 0.5 0.4"))
    # stock's fit returns another restitution
    for e in (0.5, 0.9):
        argument = stock_tsuji_argument(e)
        yield f"tsuji_{int(10 * e)}", Case(three(f"hertz/material 2.0e5 {e} 0.3 damping tsuji {MINDLIN}"), scene=dict(steps=150),
                                 stock_words=((f"2.0e5 {e} 0.3", f"2.0e5 {argument} 0.3"),))
    yield "tsuji_lammps", Case(three(f"hertz/material 2.0e5 0.6 0.3 damping tsuji {MINDLIN}"),
                               scene=dict(before="gpudem_conventions\n"))


def _tangential():
    yield "linear_nohistory", Case(three(f"{HERTZ} tangential linear_nohistory 0.5 0.4"))
    yield "linear_history", Case(three(f"{HERTZ} tangential linear_history 2.0e4 0.5 0.4"))
    for name in ("mindlin", "mindlin_rescale", "mindlin/force", "mindlin_rescale/force"):
        word = name.replace("/", "_")
        yield word, Case(three(f"{HERTZ} tangential {name} 1.5e5 0.5 0.4"))
        yield word + "_material", Case(three(f"{MATERIAL} tangential {name} NULL 0.5 0.2"))
    yield "frictionless", Case(three(f"{HERTZ} tangential mindlin 1.5e5 0.5 0.0"))


def _rolling():
    yield "sds", Case(three(f"{MATERIAL} {MINDLIN} {ROLLING}"))
    yield "sds_nohistory", Case(three(f"{HERTZ} tangential linear_nohistory 0.5 0.4 {ROLLING}"))
    yield "sds_rescale", Case(three(f"{MATERIAL} tangential mindlin_rescale NULL 0.5 0.4 {ROLLING}"))
    yield "twist_sds", Case(three(f"{MATERIAL} {MINDLIN} twisting sds 2.0e3 5.0 0.1"))
    yield "twist_marshall", Case(three(f"{MATERIAL} {MINDLIN} twisting marshall"))
    yield "all", Case(three(f"{MATERIAL} damping viscoelastic {MINDLIN} {ROLLING} twisting marshall"))
    yield "all_jkr", Case(three(f"jkr 2.0e5 20.0 0.3 50.0 tangential mindlin_rescale/force NULL 0.5 0.4 {ROLLING} "
                                "twisting sds 2.0e3 5.0 0.1"))


def _types():
    yield "coefficients", Case(three(f"{MATERIAL} {MINDLIN}", f"hertz/material 4.0e5 30.0 0.2 {MINDLIN}",
                                     f"hertz/material 1.0e5 10.0 0.4 tangential mindlin NULL 0.3 0.9"))
    yield "models", Case(three(f"{HOOKE} tangential linear_history 5.0e3 0.5 0.4", f"{HERTZ} {ROLLING} tangential "
                               "mindlin 1.5e5 0.5 0.4", "jkr 2.0e5 20.0 0.3 50.0 tangential linear_nohistory 0.5 0.4"))


def _walls():
    """The pair style is the same in all; walls in all directions, and stock made right by other numbers.

    jkr is missing: stock LAMMPS shortens the reach of a wall where an adhesion neck must lengthen it.
    """
    pair = three(f"{HERTZ} tangential mindlin 1.5e5 0.5 0.4")
    young, nu = 2.0e5, 0.3
    stock_young = young / (1.0 - nu * nu) * (1.0 - nu)          # stock takes E/(2 (1 - nu)) for E/(2 (1 - nu^2))
    stock_kt = 8.0 * young / (4.0 * (2.0 - nu) * (1.0 + nu))    # and E/4 (2 - nu)(1 + nu) for 8 G*
    material = (f"{young} 20.0 {nu}", f"{stock_young:.17g} 20.0 {nu}")
    laws = {
        "hooke": (f"{HOOKE} tangential linear_history 5.0e3 0.5 0.4", ()),
        "hertz_viscous": (f"{HERTZ} tangential linear_nohistory 0.5 0.4", ()),
        "hertz_material": (f"hertz/material {material[0]} {MINDLIN}",
                           (material, ("mindlin NULL", f"mindlin {stock_kt:.17g}"))),
        "dmt": (f"dmt {material[0]} 50.0 tangential linear_nohistory 0.0 0.0", (material,)),
        "all": (f"hertz/material {material[0]} tangential mindlin_rescale/force 1.5e5 0.5 0.4 {ROLLING} "
                "twisting marshall limit_damping", (material,)),
        "twist_sds": (f"{HERTZ} {ROLLING} tangential mindlin/force 1.5e5 0.5 0.4 twisting sds 2.0e3 5.0 0.1", ()),
    }
    planes = "\n".join(f"fix g{d} all wall/gran granular {{law}} {d}plane 0.05 7.15" for d in "xyz")
    for name, (law, stock_words) in laws.items():
        yield name, Case(pair, scene=dict(boundary="f f f", fixes=f"{NVE}\n{planes.format(law=law)}"),
                         stock_words=stock_words)
    turning = f"{NVE}\nfix down all gravity 10.0 vector 0 0 -1\n" \
        f"fix side all wall/gran granular {laws['all'][0]} zcylinder 3.75 shear z 1.5\n" \
        f"fix low all wall/gran granular {laws['hertz_material'][0]} zplane 0.05 NULL wiggle z 0.02 0.1 contacts"
    yield "cylinder_and_wiggle", Case(pair, cloud=dict(centred=True),
                                      scene=dict(boundary="f f f", fixes=turning,
                                                 columns=" ".join(f"f_low[{k}]" for k in range(1, 9))),
                                      stock_words=laws["hertz_material"][1])


CASES = {"Walls": dict(_walls()), "Normal": dict(_normal()), "Damping": dict(_damping()), "Tangential": dict(_tangential()),
         "Rolling": dict(_rolling()), "Types": dict(_types())}


class GranularTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        settings = {**NO_REBUILD, "steps": 200, "every": 50, **case.scene}
        text = scenes.scene(pair="granular", coeff=case.coeff, **settings)
        stock_text, conventions = text.replace("gpudem_conventions\n", ""), "gpudem_conventions" in text
        for ours, theirs in case.stock_words:
            self.assertIn(ours, stock_text)
            stock_text = stock_text.replace(ours, theirs)
        text = text.replace("gpudem_conventions\n", "")
        if conventions:
            text = "gpudem conventions lammps\n" + text
        stock = self.run_lammps(stock_text, files)
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            ours = self.run_lammps(text, files, gpudem=precision)
            self.assertResident(ours)
            disturbed = compare_dumps(self, stock.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)
            compare_thermo(self, stock.thermo(), ours.thermo(), tolerance, what=precision, disturbed=disturbed)


make_tests(GranularTest, CASES, globals())

if __name__ == "__main__":
    unittest.main(verbosity=2)
