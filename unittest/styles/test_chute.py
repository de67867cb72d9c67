# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""LAMMPS' granular benchmark, bench/in.chute, unmodified: 32000 grains over a frozen base at 26 degrees."""
import unittest

import scenes
from compare import compare_dumps
from lammps import StylesTest, source_file
from tolerance import CHUTE_DOUBLE, CHUTE_DOUBLE_LONG, CHUTE_MIXED_ENERGY, MIXED

WRITE = f"write_dump all custom dump.out {scenes.DUMP_COLUMNS} radius mass modify sort id format float %.17g\n"
UNMODIFIED = "include in.chute\n" + WRITE
# Rebuilds, and many more contacts opening and closing: the same file with a longer second run.
LONGER = "include in.chute\nrun 400\n" + WRITE
# Whole-number copies of the benchmark's box.
REPLICATED = """
units lj
atom_style sphere
boundary p p fs
newton off
comm_modify vel yes
read_data data.chute
replicate 1 2 1
pair_style gran/hooke/history 200000.0 NULL 50.0 NULL 0.5 0
pair_coeff * *
neighbor 0.1 bin
neigh_modify every 1 delay 0
timestep 0.0001
group bottom type 2
group active subtract all bottom
neigh_modify exclude group bottom bottom
fix 1 all gravity 1.0 chute 26.0
fix 2 bottom freeze
fix 3 active nve/sphere
compute 1 all erotate/sphere
run 50
""" + WRITE


class Chute(StylesTest):
    def setUp(self):
        super().setUp()
        self.files = [source_file("bench", "in.chute"), source_file("bench", "data.chute")]

    def energy(self, run):
        """Kinetic energy of translation, from the dump (no conversion in units lj)."""
        names, a = list(run.dump().values())[-1]
        return 0.5 * sum((a[:, names.index("mass")] * a[:, names.index(c)] ** 2).sum() for c in ("vx", "vy", "vz"))

    def check(self, text, precisions=("double", "mixed"), tolerance=CHUTE_DOUBLE):
        stock = self.run_lammps(text, self.files)
        for precision in precisions:
            ours = self.run_lammps(text, self.files, gpudem=precision, threads=2)
            self.assertResident(ours)
            double = precision == "double"
            compare_dumps(self, stock.dump(), ours.dump(), tolerance if double else MIXED, scenes.DIAMETER,
                          what=precision)
            expected = self.energy(stock)
            self.assertLessEqual(abs(self.energy(ours) - expected),
                                 (tolerance.thermo if double else CHUTE_MIXED_ENERGY) * expected)

    def test_unmodified(self):
        self.check(UNMODIFIED)

    def test_replicated(self):
        self.check(REPLICATED, precisions=("double",))

    def test_longer(self):
        self.check(LONGER, precisions=("double",), tolerance=CHUTE_DOUBLE_LONG)


if __name__ == "__main__":
    unittest.main(verbosity=2)
