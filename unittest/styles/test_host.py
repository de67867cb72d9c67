# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Styles without a device version act at their LAMMPS call points, give LAMMPS' results, and are named in the log."""
import unittest
from dataclasses import dataclass, field

import numpy as np

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests, read_dump
from tolerance import DOUBLE

NVE = "fix move all nve/sphere\n"
DOWN = "fix down all gravity 10.0 vector 0 0 -1\n"
FLOOR = "fix w all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 zplane 0.05 NULL\n"
# no ghosts: Pair::single() takes velocities at full steps here, while in stock LAMMPS a ghost still has that of the
# half step, so that its damping across a periodic boundary is not that of the same pair inside
OPEN = dict(boundary="m m m")
TALL = dict(cloud=dict(margin=(0, 0, 0.5)), scene=dict(boundary="p p f"))


@dataclass
class Case:
    fixes: str = NVE
    before: str = ""
    columns: str = ""
    thermo: str = ""
    log: tuple = ()             # phrases the log must contain
    files: tuple = ()           # further outputs to compare, numbers only
    local: tuple = ()           # dumps of local data
    cloud: dict = field(default_factory=dict)
    scene: dict = field(default_factory=dict)


# no rebuild: stock turns rolling springs round there, and is right about all else here
GRANULAR = dict(OPEN, pair="granular", skin=0.4, neighbor="delay 100000 every 100000 check no",
                coeff=tuple(f"{t} hertz/material 2.0e5 20.0 0.3 tangential mindlin_rescale NULL 0.5 0.4 rolling sds 1.0e4 30.0 0.2"
                            for t in ("1 1", "1 2", "2 2")))

CASES = {
    "HostFixes": {
        "addforce": Case(NVE + "group one type 1\nfix push one addforce 1.0 -2.0 3.0\n",
                         thermo=" f_push f_push[1] f_push[3]", log=("fix push (addforce) on the host",)),
        "addforce_varying": Case(NVE + "variable fx atom 5.0*sin(x)\nfix push all addforce v_fx 0.0 0.0\n",
                                 log=("addforce",)),
        "addforce_then_device_terms": Case("fix push all addforce 1.0 0.0 0.0\n" + DOWN + FLOOR + NVE,
                                           log=("addforce", "a fix before it in the script"), **TALL),
        "device_terms_then_addforce": Case(DOWN + FLOOR + "fix push all addforce 1.0 0.0 0.0\n" + NVE, **TALL),
        "momentum": Case(NVE + "fix still all momentum 10 linear 1 1 1 angular\n", log=("momentum",)),
        "nve_limit": Case("group one type 1\ngroup two type 2\nfix a one nve/limit 0.001\nfix b two nve/sphere\n",
                          log=("nve/limit",)),
        "plain_nve": Case("fix a all nve\n", log=("fix a (nve) on the host",)),
        "print_and_average": Case(NVE + "variable e equal ke\nfix say all print 20 \"$(step) ${e}\" file said.out screen no\n"
                                  "fix mean all ave/time 2 5 20 v_e file mean.out format \" %.17g\"\n",
                                  log=("ave/time", "print"), files=("mean.out",)),
        "average_per_atom": Case(NVE + "fix mean all ave/atom 5 4 20 vx fx vz\n",
                                 columns="f_mean[1] f_mean[2] f_mean[3]", scene=dict(every=20)),
        "chunks": Case(NVE + "compute layer all chunk/atom bin/1d z lower 0.9 units box\n"
                       "fix profile all ave/chunk 5 4 20 layer vx vz density/mass file profile.out format \" %.15g\"\n",
                       files=("profile.out",)),
        "store_state": Case(NVE + "fix old all store/state 20 x y z vx\n", columns="f_old[1] f_old[4]"),
        "set_every": Case(NVE + "variable w atom id*0.01\nfix turn all vector 10 c_thermo_temp\n"),
        "move_variable": Case("group bottom type 2\ngroup active subtract all bottom\nfix a active nve/sphere\n"
                              "variable dx equal vdisplace(0,2)\nvariable vx equal 2.0\n"
                              "fix plate bottom move variable v_dx NULL NULL v_vx NULL NULL\n",
                              cloud=dict(frozen_layer=True, margin=(0, 0, 0.5)), scene=dict(boundary="p p f"),
                              log=("style 'variable'",)),
        "wall_region": Case(NVE + DOWN + "region can cylinder z 3.6 3.6 3.5 0.05 8.0 side in units box\n"
                            "fix r all wall/gran/region hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 region can\n",
                            cloud=dict(margin=(0.05, 0.05, 0.8)), scene=dict(boundary="f f f"), log=("wall/gran/region",)),
        "dynamic_group": Case("region low block INF INF INF INF INF 3.0 units box\ngroup low dynamic all region low every 10\n" + NVE +
                              "fix g low gravity 30.0 vector 0 0 -1\ncompute n low reduce max z\n", log=("members of group low",),
                              thermo=" c_n"),
        "dynamic_group_of_a_variable": Case("variable fast atom vx>1.0\ngroup quick dynamic all var fast every 7\n" + NVE +
                                            "fix drag quick viscous 3.0\n", log=("members of group quick",)),
        "balance_on_one_rank": Case("fix even all balance 20 1.0 shift xy 5 1.1\n" + NVE, log=("(balance), on one rank",)),
        "hybrid_of_one": Case(scene=dict(pair="hybrid gran/hooke/history 2.0e4 NULL 50.0 NULL 0.5 1",
                                         coeff=("* * gran/hooke/history",)), thermo=" press"),
        "wall_reflect": Case(NVE + "fix bounce all wall/reflect zlo 0.02 zhi EDGE\n", scene=dict(boundary="p p f"),
                             cloud=dict(margin=(0, 0, 0.3)), log=("wall/reflect",)),
        "drag_and_region_setforce": Case(NVE + "region half block INF INF INF INF INF 3.0 units box\n"
                                         "fix set all setforce 0.0 NULL NULL region half\n", log=("keyword 'region'",)),
        "variable_gravity_of_state": Case(NVE + "variable pull equal 1.0+0.001*ke\nfix g all gravity v_pull vector 0 0 -1\n",
                                          log=("depends on more than the step",)),
    },
    "HostComputes": {
        "contact": Case(before="compute n all contact/atom\ncompute total all reduce sum c_n\n", columns="c_n",
                        thermo=" c_total", log=("on host",)),
        "coordination": Case(before="compute n all coord/atom cutoff 0.95\ncompute total all reduce sum c_n\n",
                             columns="c_n", thermo=" c_total"),
        "stress": Case(before="compute s all stress/atom NULL\ncompute p all reduce sum c_s[1] c_s[2] c_s[3]\n",
                       columns="c_s[1] c_s[3] c_s[4] c_s[6]", thermo=" c_p[1] c_p[2] press"),
        "pair_virial_stress": Case(before="compute s all stress/atom NULL pair\n", columns="c_s[1] c_s[3] c_s[4] c_s[6]"),
        "peratom_reductions": Case(before="compute k all ke/atom\ncompute top all reduce max c_k vx z\n"
                                   "compute d all displace/atom\n", columns="c_k c_d[4]",
                                   thermo=" c_top[1] c_top[2] c_top[3]", log=("compute top (reduce)",)),
        "pair_local": Case(before="compute force all pair/local dist fx fy fz\ncompute who all property/local patom1 patom2\n"
                           "dump loc all local 50 local.out c_who[1] c_who[2] c_force[1] c_force[2] c_force[3] c_force[4]\n"
                           "dump_modify loc format float %.17g\n", local=("local.out",), scene=OPEN),
        "pair_local_granular": Case(
            before="compute force all pair/local dist force fx fy fz p1 p2 p3 p4 p5 p6 p7 p8 p10 p11\n"
            "compute who all property/local patom1 patom2\n"
            "dump loc all local 50 local.out c_who[1] c_who[2] c_force[1] c_force[2] c_force[7] c_force[11]\n"
            "dump_modify loc format float %.17g\n", local=("local.out",), scene=GRANULAR),
        "fabric_granular": Case(before="compute f all fabric radius contact branch force/normal force/tangential\n",
                                thermo=" c_f[1] c_f[2] c_f[7] c_f[13] c_f[19]", scene=GRANULAR),
        "contact_stress_granular": Case(before="compute n all contact/atom\ncompute s all stress/atom NULL\n",
                                        columns="c_n c_s[1] c_s[4]", scene=GRANULAR),
        "centre_of_mass": Case(before="compute c all com\ncompute g all gyration\n", thermo=" c_c[1] c_c[3] c_g"),
        "group_group": Case(before="group one type 1\ngroup two type 2\ncompute g one group/group two\n",
                            thermo=" c_g[1] c_g[2] c_g[3]", scene=OPEN),
        "wall_contacts_reduced": Case(NVE + DOWN + FLOOR.replace("NULL\n", "NULL contacts\n"),
                                      before="variable x equal 0\n", thermo=" c_wall[1] c_wall[2]", **TALL),
        "radial_distribution": Case(before="comm_modify cutoff 2.0\ncompute r all rdf 10 cutoff 1.0\n", thermo=" c_r[5][2] c_r[9][2]"),
    },
}
CASES["HostComputes"]["wall_contacts_reduced"].fixes += "compute wall all reduce sum f_w[1] f_w[4]\n"


def numbers(path):
    rows = [line.split() for line in path.read_text().split("\n") if line and not line.startswith("#")]
    return np.array([float(w) for row in rows for w in row])


class HostTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        text = scenes.scene(case.fixes, before=case.before, columns=case.columns, thermo=scenes.THERMO + case.thermo,
                            **{"steps": 200, **case.scene})
        stock = self.run_lammps(text, files)
        ours = self.run_lammps(text, files, gpudem="double")
        self.assertResident(ours)
        for phrase in case.log:
            self.assertIn(phrase, ours.log)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE, skip=("Volume",) if case.scene.get("boundary") == "m m m" else ())
        for name in case.files:
            a, b = numbers(stock.path(name)), numbers(ours.path(name))
            self.assertEqual(a.shape, b.shape, name)
            self.assertLessEqual(np.abs(a - b).max(), DOUBLE.other * np.abs(a).max(), name)
        for name in case.local:
            self.compare_local(read_dump(stock.path(name)), read_dump(ours.path(name)))

    def compare_local(self, stock, ours):
        """Pairs in any order and either orientation: (tag, tag, distance, force on the first)."""
        self.assertEqual(sorted(stock), sorted(ours))
        for step, (_, a) in stock.items():
            a, b = self.oriented(a), self.oriented(ours[step][1])
            self.assertEqual(a.shape, b.shape, f"other pairs at step {step}")
            self.assertTrue(np.array_equal(a[:, :2], b[:, :2]))
            for column in range(2, a.shape[1]):
                scale = np.abs(a[:, column]).max()
                self.assertLessEqual(np.abs(a[:, column] - b[:, column]).max(), DOUBLE.force * scale, f"step {step}")

    @staticmethod
    def oriented(table):
        table = table.copy()
        swap = table[:, 0] > table[:, 1]
        table[swap, :2] = table[swap, 1::-1]
        table[swap, 3:] *= -1.0
        return table[np.lexsort((table[:, 1], table[:, 0]))]


make_tests(HostTest, CASES, globals())

if __name__ == "__main__":
    unittest.main(verbosity=2)
