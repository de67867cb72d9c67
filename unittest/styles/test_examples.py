# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""The granular examples of LAMMPS' source package, unmodified but for the lengths of their runs and one
column of output, resident.

They are chaotic: the same grains must be there as in stock LAMMPS, at about the same mean height.
"""
import re
import unittest

import numpy as np

from lammps import StylesTest, source_file
from tolerance import BULK_HEIGHT, TUMBLED_HEIGHT


class Examples(StylesTest):
    def check(self, *path, steps=None, allowed=BULK_HEIGHT, alike=None):
        """steps: length of every run, None: as it stands. alike: the runs after which heights agree, None: all."""
        text = source_file("examples", *path).read_text()
        text = re.sub(r"^run", "compute height all reduce ave z\nthermo_style custom step atoms c_height\nrun", text, count=1,
                      flags=re.M)
        if steps:
            text = re.sub(r"^run(\s+)\d+", rf"run\g<1>{steps}", text, flags=re.M)
        stock = self.run_lammps(text)
        ours = self.run_lammps(text, gpudem="mixed")
        self.assertResident(ours)
        self.assertEqual(len(stock.thermo()), len(ours.thermo()))
        for k, ((names, a), (_, b)) in enumerate(zip(stock.thermo(), ours.thermo())):
            self.assertEqual(a.shape, b.shape)
            atoms = names.index("Atoms")
            self.assertTrue((a[:, atoms] == b[:, atoms]).all(), "other numbers of grains")
            if alike is not None and k >= alike:
                continue
            height = names.index("c_height")
            self.assertLess(abs(a[-1, height] - b[-1, height]), allowed * np.abs(a[:, height]).max())
        return ours

    def test_pour_flatwall(self):
        self.check("granular", "in.pour.flatwall", steps=3000)

    def test_granregion_box(self):
        """The second rotation is about (1, 1, 1), the length of which stock takes for speed (test_region_corrections)."""
        self.check("granregion", "in.granregion.box", allowed=TUMBLED_HEIGHT, alike=3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
