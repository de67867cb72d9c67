# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""The granular examples of LAMMPS' source package, unmodified but for the lengths of their runs, resident.

They are chaotic: the same grains must be there as in stock LAMMPS, with about the same energy.
"""
import re
import unittest

from lammps import StylesTest, source_file
from tolerance import BULK_ENERGY_BAND


class Examples(StylesTest):
    def check(self, *path, steps=None, energy=None):
        """steps: length of every run, None: as it stands; energy: thermo column compared at the end."""
        text = source_file("examples", *path).read_text()
        if steps:
            text = re.sub(r"^run(\s+)\d+", rf"run\g<1>{steps}", text, flags=re.M)
        stock = self.run_lammps(text)
        ours = self.run_lammps(text, gpudem="mixed")
        self.assertResident(ours)
        for (names, a), (_, b) in zip(stock.thermo(), ours.thermo()):
            self.assertEqual(a.shape, b.shape)
            atoms = names.index("Atoms")
            self.assertTrue((a[:, atoms] == b[:, atoms]).all(), "other numbers of grains")
            if energy:
                k = names.index(energy)
                self.assertLess(abs(a[-1, k] - b[-1, k]), BULK_ENERGY_BAND * abs(a[-1, k]))
        return ours

    def test_pour_flatwall(self):
        self.check("granular", "in.pour.flatwall", steps=3000, energy="KinEng")

    def test_granregion_box(self):
        self.check("granregion", "in.granregion.box")


if __name__ == "__main__":
    unittest.main(verbosity=2)
