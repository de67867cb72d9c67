# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Random dense clouds: every pair style with every option, every kind of boundary, two and three dimensions."""
import unittest
from dataclasses import dataclass, field

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest, make_tests
from tolerance import DOUBLE, MIXED, SHRINK_WRAP_SKINS

NVE = "fix move all nve/sphere"
WALLS = NVE + """
fix gx all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 xplane 0.05 7.15
fix gy all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 yplane 0.05 7.15
fix gz all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 zplane 0.05 7.15"""
FLOOR = NVE + "\nfix down all gravity 10.0 vector 0 0 -1\n" \
    "fix gz all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 zplane 0.05 NULL"
DISC = "fix move all nve/sphere disc\nfix flat all enforce2d"
OPEN = dict(margin=(0.3, 0.3, 0.3))


@dataclass
class Case:
    """One scene; the cloud's and the input's arguments."""
    pair: str = scenes.HOOKE_HISTORY
    cloud: dict = field(default_factory=dict)
    scene: dict = field(default_factory=dict)

    def volume_tolerance(self):
        """Relative; zero unless a face is shrink-wrapped."""
        boundary = self.scene.get("boundary", "p p p").split()
        free = sum(word.count("s") * (2 if len(word) == 1 else 1) for word in boundary)
        shortest = min(c for c in self.cloud.get("cells", (8, 8, 8)) if c > 1) * 0.9
        return SHRINK_WRAP_SKINS * free * self.scene.get("skin", 0.05) / shortest


def _pairs():
    """kn kt gamma_n gamma_t mu dampflag, and limit_damping."""
    forms = {
        "default": "NULL {g} NULL 0.5 1",
        "explicit": "{kt} {g} {gt} 0.4 1",
        "dampflag0": "{kt} {g} {gt} 0.4 0",
        "frictionless": "NULL {g} NULL 0.0 0",
        "limit_damping": "{kt} {g} {gt} 0.4 1 limit_damping",
    }
    styles = {
        "gran/hooke": dict(k="2.0e4", kt="5.0e3", g="200.0", gt="30.0"),
        "gran/hooke/history": dict(k="2.0e4", kt="5.0e3", g="200.0", gt="30.0"),
        "gran/hertz/history": dict(k="2.0e5", kt="1.5e5", g="800.0", gt="120.0"),
    }
    for style, numbers in styles.items():
        for form, text in forms.items():
            name = style.replace("gran/", "").replace("/", "_") + "_" + form
            yield name, Case(pair=f"{style} {numbers['k']} " + text.format(**numbers))


CASES = {
    "PairStyles": dict(_pairs()),
    "Boundaries": {
        "ppp_small_skin": Case(scene=dict(skin=0.01)),
        "ppp_large_skin": Case(scene=dict(skin=0.5)),
        "ppp_rebuild_every_step": Case(scene=dict(neighbor="delay 0 every 1 check no")),
        "ppp_rebuild_rarely": Case(scene=dict(neighbor="delay 10 every 5 check yes", skin=0.3)),
        "fff_walls": Case(scene=dict(boundary="f f f", fixes=WALLS)),
        "ppf_floor": Case(scene=dict(boundary="p p f", fixes=FLOOR), cloud=dict(margin=(0, 0, 0.6))),
        "ppfs_floor": Case(scene=dict(boundary="p p fs", fixes=FLOOR), cloud=dict(margin=(0, 0, 0.1))),
        "sss_free": Case(scene=dict(boundary="s s s")),
        "mmm_free": Case(scene=dict(boundary="m m m")),
        "mixed_faces": Case(scene=dict(boundary="p fs sm"), cloud=OPEN),
        "pfs_hertz": Case(pair=scenes.HERTZ_HISTORY, scene=dict(boundary="p p fm", fixes=FLOOR),
                          cloud=dict(margin=(0, 0, 0.1))),
        "far_from_origin": Case(scene=dict(before="displace_atoms all move 0.4 0.4 0.4\n")),
        "slab_thin": Case(cloud=dict(cells=(16, 16, 3))),
    },
    "TwoDimensions": {
        "disc_periodic": Case(cloud=dict(cells=(24, 24, 1), dimension=2), scene=dict(dimension=2, fixes=DISC)),
        "sphere_periodic": Case(cloud=dict(cells=(24, 24, 1), dimension=2),
                                scene=dict(dimension=2, fixes="fix move all nve/sphere\nfix flat all enforce2d")),
        "disc_box": Case(pair=scenes.HERTZ_HISTORY, cloud=dict(cells=(24, 24, 1), dimension=2),
                         scene=dict(dimension=2, boundary="f fm p", fixes=DISC +
                                    "\nfix down all gravity 10.0 vector 0 -1 0"
                                    "\nfix gx all wall/gran hertz/history 2.0e5 NULL 200.0 NULL 0.5 1 xplane 0 21.6"
                                    "\nfix gy all wall/gran hertz/history 2.0e5 NULL 200.0 NULL 0.5 1 yplane 0 NULL")),
        "plain_hooke": Case(pair=scenes.HOOKE, cloud=dict(cells=(20, 20, 1), dimension=2),
                            scene=dict(dimension=2, boundary="p s p", fixes=DISC)),
    },
}


class CloudTest(StylesTest):
    def check(self, case):
        files = [("cloud.data", scenes.cloud(**case.cloud))]
        text = scenes.scene(pair=case.pair, **case.scene)
        stock = self.run_lammps(text, files)
        for precision, tolerance in (("double", DOUBLE), ("mixed", MIXED)):
            ours = self.run_lammps(text, files, gpudem=precision)
            self.assertResident(ours)
            disturbed = compare_dumps(self, stock.dump(), ours.dump(), tolerance, scenes.DIAMETER, what=precision)
            compare_thermo(self, stock.thermo(), ours.thermo(), tolerance, what=precision, disturbed=disturbed,
                           special={"Volume": case.volume_tolerance()})


make_tests(CloudTest, CASES, globals())

if __name__ == "__main__":
    unittest.main(verbosity=2)
