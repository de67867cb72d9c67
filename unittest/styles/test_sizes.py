# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Grains of many sizes: levels of the neighbour search, sizes that grow and that come between runs."""
import pathlib
import unittest

import numpy as np

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest
from tolerance import CONTINUED_STROKE, DOUBLE

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def spread(ratio, seed=3):
    """Make every grain of a cloud smaller by up to a ratio."""
    def edit(atoms, velocities):
        random = np.random.default_rng(seed)
        for atom in atoms:
            atom[2] *= ratio ** -random.uniform(0.0, 1.0)
    return edit


class Levels(StylesTest):
    def same(self, text, files, head="", phrases=()):
        stock = self.run_lammps(text, files)
        ours = self.run_lammps(head + text, files, gpudem="double")
        self.assertResident(ours)
        for phrase in phrases:
            self.assertIn(phrase, ours.log)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)

    def test_levels(self):
        files = [("cloud.data", scenes.cloud(edit=spread(8.0), spacing=0.75))]
        text = scenes.scene(steps=100)
        self.same(text, files, "gpudem neighbor single\n")
        self.same(text, files, "gpudem neighbor multigrid\n", ("multigrid of ", "levels, radii up to "))
        self.same(text, files, "gpudem levels 3\n", ("multigrid of 3 levels",))
        equal = [("cloud.data", scenes.cloud())]
        run = self.run_lammps("gpudem neighbor multigrid\n" + scenes.scene(steps=1), equal, gpudem="double")
        self.assertIn("all grains fit one level", run.log)

    def test_growing_diameters(self):
        """fix adapt changes radii on the host at every step."""
        grow = ("fix move all nve/sphere\nvariable d equal 0.6+0.002*step\n"
                "fix grow all adapt 1 atom diameter v_d\n")
        text = scenes.scene(grow, steps=100, skin=0.3).replace("atom_style sphere", "atom_style sphere 1")
        self.same(text, [("cloud.data", scenes.cloud())])

    def test_other_sizes_between_runs(self):
        """The largest and the smallest grain come after the first run."""
        def hole(x):
            return np.hypot(np.hypot(x[0] - 3.6, x[1] - 3.6), x[2] - 3.6) > 2.2
        cloud = scenes.cloud(keep=hole)
        n = int(cloud.split("\n")[2].split()[0])
        later = (f"run 50\ncreate_atoms 2 single 3.6 3.6 3.6\nset atom {n + 1} diameter 3.0\nset atom {n + 1} density 1.0\n"
                 f"create_atoms 2 single 3.6 3.6 5.25\nset atom {n + 2} diameter 0.2\nset atom {n + 2} density 1.0\nrun 100\n")
        self.same(scenes.scene(after=later), [("cloud.data", cloud)], phrases=("multigrid of ",))


class Compaction(StylesTest):
    def test_restart_in_the_middle(self):
        """examples/compaction, small: the continued stroke ends as the other does."""
        files = list((EXAMPLES / "compaction").glob("*.inc")) + [EXAMPLES / "compaction" / "in.continue"]
        few = "variable grains index 300\nvariable steps index 1000\n"
        text = few + (EXAMPLES / "compaction" / "in.compaction").read_text()
        whole = self.run_lammps(text, files, gpudem="double")
        self.assertResident(whole)
        half = whole.path("compaction.restart")
        rest = self.run_lammps(few + (EXAMPLES / "compaction" / "in.continue").read_text(), files + [half], gpudem="double")
        self.assertResident(rest)
        (names, a), (_, b) = whole.thermo()[-1], rest.thermo()[-1]
        self.assertEqual(a[-1, names.index("Step")], b[-1, names.index("Step")])
        for column in ("v_fraction", "v_pressure", "KinEng"):
            x, y = a[-1, names.index(column)], b[-1, names.index(column)]
            self.assertLess(abs(x - y), CONTINUED_STROKE * abs(x), column)


if __name__ == "__main__":
    unittest.main(verbosity=2)
