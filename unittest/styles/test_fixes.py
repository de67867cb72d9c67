# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Walls, force terms, prescribed motion, groups and exclusions, one scene each, against stock LAMMPS."""
import unittest
from dataclasses import dataclass, field

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests
from tolerance import DOUBLE, MIXED

NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 10.0 vector 0.0 0.0 -1.0\n"
LAWS = {
    "hooke": "hooke 2.0e4 NULL 50.0 20.0 0.5 1",
    "hooke_history": "hooke/history 2.0e4 NULL 50.0 20.0 0.5 1",
    "hertz_history": "hertz/history 2.0e5 NULL 200.0 100.0 0.5 1",
    "dampflag0": "hooke/history 2.0e4 5.0e3 50.0 20.0 0.5 0",
    "limit_damping": "hooke/history 2.0e4 5.0e3 300.0 20.0 0.5 1 limit_damping",
}
BOX = dict(boundary="f f f")
BOXED = dict(margin=(0.05, 0.05, 0.05))
CYLINDER = dict(centred=True, margin=(0.05, 0.05, 0))
CONTACTS = "f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6] f_w[7] f_w[8]"
# a floor of grains of type 2
FLOORED = dict(frozen_layer=True, margin=(0, 0, 0.5))
GROUPS = "group bottom type 2\ngroup active subtract all bottom\n"
FLOW = GROUPS + "neigh_modify exclude group bottom bottom\n"
ACTIVE = "fix move active nve/sphere\n"


@dataclass
class Case:
    fixes: str
    before: str = ""
    columns: str = ""
    thermo: str = ""
    cloud: dict = field(default_factory=dict)
    scene: dict = field(default_factory=dict)
    pair: str = scenes.HOOKE_HISTORY
    resident: bool = True
    says: str = ""      # a phrase the log must contain


def _walls():
    planes = {"x": "xplane 0.05 7.15", "y": "yplane NULL 7.1", "z": "zplane 0.05 NULL"}
    for law, words in LAWS.items():
        for axis, plane in planes.items():
            yield f"{law}_{axis}plane", Case(NVE + DOWN + f"fix w all wall/gran {words} {plane} contacts",
                                             columns=CONTACTS, cloud=BOXED, scene=BOX)
        yield f"{law}_cylinder", Case(NVE + DOWN + "fix w all wall/gran " + words + " zcylinder 3.7 contacts",
                                      columns=CONTACTS,
                                      cloud=CYLINDER, scene=dict(boundary="f f p"))
    yield "wiggle_z", Case(NVE + f"fix w all wall/gran {LAWS['hooke_history']} zplane 0.1 7.1 wiggle z 0.1 0.03",
                           cloud=BOXED, scene=BOX)
    yield "wiggle_x_of_z", Case(NVE + f"fix w all wall/gran {LAWS['hertz_history']} zplane 0.1 NULL wiggle x 0.2 0.05",
                                cloud=BOXED, scene=BOX)
    yield "shear_y_of_x", Case(NVE + f"fix w all wall/gran {LAWS['hooke_history']} xplane 0.1 7.1 shear y 3.0",
                               cloud=BOXED, scene=BOX)
    yield "shear_hooke", Case(NVE + f"fix w all wall/gran {LAWS['hooke']} zplane 0.1 7.1 shear x -2.0",
                              cloud=BOXED, scene=BOX)
    yield "cylinder_turns", Case(NVE + f"fix w all wall/gran {LAWS['hooke_history']} zcylinder 3.7 shear z 2.0",
                                 cloud=CYLINDER, scene=dict(boundary="f f p"))
    yield "group_only", Case(NVE + "group one type 1\n"
                             f"fix w one wall/gran {LAWS['hooke_history']} zplane 0.05 7.1 contacts",
                             columns=CONTACTS, cloud=BOXED, scene=BOX)
    yield "history_wall_on_hooke_pair", Case(NVE + f"fix w all wall/gran {LAWS['hooke_history']} zplane 0.05 7.1",
                                             cloud=BOXED, scene=BOX, pair=scenes.HOOKE)


FROZEN_OUT = " f_ice[1] f_ice[2] f_ice[3]"
SET_OUT = " f_set[1] f_set[2] f_set[3]"

CASES = {
    "Walls": dict(_walls()),
    "Gravity": {
        "chute": Case(NVE + "fix g all gravity 10.0 chute 26.0"),
        "spherical": Case(NVE + "fix g all gravity 10.0 spherical 30.0 -120.0"),
        "vector": Case(NVE + "fix g all gravity 10.0 vector 1.0 2.0 -3.0"),
        "group": Case(NVE + "group one type 1\nfix g one gravity 10.0 vector 1.0 0.0 -1.0"),
        "two": Case(NVE + "fix g all gravity 10.0 vector 1.0 0.0 -1.0\nfix h all gravity 3.0 chute 15.0"),
        "variable_magnitude": Case(NVE + "variable pull equal 10.0*sin(0.1*step)\nfix g all gravity v_pull vector 0 1 -1"),
        "variable_vector": Case(NVE + "variable ax equal ramp(0,5)\nvariable az equal -time*100\n"
                                "fix g all gravity 20.0 vector v_ax 1.0 v_az"),
        "variable_angle": Case(NVE + "variable tilt equal 20.0+step/10\nfix g all gravity 10.0 chute v_tilt"),
    },
    "Freeze": {
        "floor": Case(ACTIVE + DOWN + "fix ice bottom freeze", before=FLOW, thermo=FROZEN_OUT, cloud=FLOORED,
                      scene=dict(boundary="p p f")),
        "first_in_script": Case("fix ice bottom freeze\n" + DOWN + ACTIVE, before=FLOW, thermo=FROZEN_OUT,
                                cloud=FLOORED, scene=dict(boundary="p p f")),
        "hertz_no_exclusion": Case(ACTIVE + DOWN + "fix ice bottom freeze", before=GROUPS, thermo=FROZEN_OUT,
                                   cloud=FLOORED, scene=dict(boundary="p p f"), pair=scenes.HERTZ_HISTORY),
        "integrated_too": Case(NVE + DOWN + "fix ice bottom freeze", before=GROUPS, thermo=FROZEN_OUT,
                               cloud=FLOORED, scene=dict(boundary="p p f"), pair=scenes.HOOKE),
    },
    "ForceTerms": {
        "viscous": Case(NVE + "fix drag all viscous 5.0"),
        "viscous_scaled": Case(NVE + "fix drag all viscous 5.0 scale 2 0.2"),
        "viscous_group": Case(NVE + "group one type 1\nfix drag one viscous 5.0"),
        "setforce_null": Case(NVE + "group one type 1\nfix set one setforce NULL 0.0 NULL", thermo=SET_OUT),
        "setforce_constant": Case(NVE + "group one type 1\nfix set one setforce 1.0 -2.0 0.5", thermo=SET_OUT),
        "setforce_variable": Case(NVE + "group one type 1\nvariable push equal 10*cos(0.05*step)\n"
                                  "fix set one setforce v_push NULL 0.0", thermo=SET_OUT),
        "order_set_then_gravity": Case(NVE + "group one type 1\nfix set one setforce 0.0 0.0 0.0\n" + DOWN,
                                       thermo=SET_OUT),
        "order_gravity_then_set": Case(DOWN + "group one type 1\nfix set one setforce 0.0 0.0 0.0\n" + NVE,
                                       thermo=SET_OUT),
        "all_at_once": Case("fix g all gravity 10.0 chute 26.0\n"
                            f"fix w all wall/gran {LAWS['hooke_history']} zplane 0.05 NULL contacts\n"
                            "fix drag active viscous 1.0 scale 1 3.0\nfix ice bottom freeze\n"
                            "fix set active setforce NULL 0.0 NULL\nfix move active nve/sphere\n"
                            f"fix top all wall/gran {LAWS['hertz_history']} zplane NULL 7.0 shear x 1.0",
                            before=GROUPS, columns=CONTACTS, thermo=SET_OUT + FROZEN_OUT,
                            cloud=FLOORED, scene=dict(boundary="p p f")),
        "enforce2d_before_walls": Case("fix flat all enforce2d\n" + NVE +
                                       f"fix w all wall/gran {LAWS['hooke_history']} yplane 0.05 17.0\n",
                                       cloud=dict(dimension=2, cells=(20, 19, 1)),
                                       scene=dict(dimension=2, boundary="p f p")),
    },
    "Move": {
        "linear": Case(ACTIVE + "fix plate bottom move linear 2.0 -1.0 0.0", before=FLOW, cloud=FLOORED,
                       scene=dict(boundary="p p f")),
        "linear_null": Case(ACTIVE + "fix plate bottom move linear 2.0 NULL 0.0", before=FLOW, cloud=FLOORED,
                            scene=dict(boundary="p p f")),
        "wiggle": Case(ACTIVE + "fix plate bottom move wiggle 0.2 NULL 0.1 0.03", before=FLOW, cloud=FLOORED,
                       scene=dict(boundary="p p f")),
        "rotate": Case(ACTIVE + "fix plate bottom move rotate 3.6 3.6 0.0 0.0 0.0 1.0 1.0", before=FLOW, cloud=FLOORED,
                       scene=dict(boundary="p p f")),
        "rotate_oblique": Case(ACTIVE + "fix plate bottom move rotate 3.6 3.6 0.0 0.2 0.1 1.0 2.0", before=FLOW,
                               cloud=FLOORED, scene=dict(boundary="f f f")),
        "frozen_and_moving": Case(ACTIVE + "fix ice bottom freeze\nfix plate bottom move linear 2.0 0.0 0.0",
                                  before=FLOW, cloud=FLOORED, scene=dict(boundary="p p f")),
        "variable_on_host": Case(ACTIVE + "variable dx equal vdisplace(0,2)\nvariable vx equal 2.0\n"
                                 "fix plate bottom move variable v_dx NULL NULL v_vx NULL NULL", before=FLOW,
                                 cloud=FLOORED, scene=dict(boundary="p p f"), says="style 'variable'"),
    },
    "Groups": {
        "exclude_group": Case(NVE + DOWN, before="group one type 1\ngroup two type 2\nneigh_modify exclude group one two\n"),
        "exclude_type": Case(NVE + DOWN, before="neigh_modify exclude type 1 2\n"),
        "exclude_both": Case(NVE + DOWN, before="group low id <= 250\nneigh_modify exclude group low low exclude type 2 2\n"),
        "partial_integration": Case("fix move some nve/sphere", before="group some id 1:300\n"),
        "two_integrators": Case("fix a one nve/sphere\nfix b two nve/sphere disc",
                                before="group one type 1\ngroup two type 2\n",
                                cloud=dict(dimension=2, cells=(24, 24, 1)), scene=dict(dimension=2)),
    },
}


class FixesTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        text = scenes.scene(case.fixes, before=case.before, columns=case.columns, pair=case.pair,
                            thermo=scenes.THERMO + case.thermo, **case.scene)
        stock = self.run_lammps(text, files)
        if "contacts" in case.fixes:
            self.assertTrue(any(a[:, n.index("f_w[1]")].any() for n, a in stock.dump().values()), "nothing touches")
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            ours = self.run_lammps(text, files, gpudem=precision)
            self.assertResident(ours)
            if case.says:
                self.assertIn(case.says, ours.everything)
            disturbed = compare_dumps(self, stock.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)
            compare_thermo(self, stock.thermo(), ours.thermo(), tolerance, what=precision, disturbed=disturbed)


make_tests(FixesTest, CASES, globals())

if __name__ == "__main__":
    unittest.main(verbosity=2)
