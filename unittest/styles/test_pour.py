# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""LAMMPS' examples/pour: insertion by fix pour on the host into a resident run. Chaotic, so bulk means are compared."""
import os
import re
import unittest

import numpy as np

import scenes
from compare import _say
from lammps import StylesTest, source_file
from tolerance import BULK_ENERGY_BAND, BULK_HEIGHT, BULK_SIGMAS

FULL = bool(os.environ.get("GPUDEM_LONG"))
WRITE = "\nwrite_dump all custom dump.out id x y z radius vx vy vz modify sort id format float %.17g\n"


def coordination(x, radius, lengths):
    """Mean number of touching neighbours; lengths: period of each direction or None."""
    order = np.argsort(x[:, 0])
    x, radius = x[order], radius[order]
    touching, reach = 0, 2.0 * radius.max()
    shifts = [(0.0,) if length is None else (-length, 0.0, length) for length in lengths]
    for sx in shifts[0]:
        for sy in shifts[1]:
            for sz in shifts[2]:
                y = x + (sx, sy, sz)
                first = np.searchsorted(y[:, 0], x[:, 0] - reach)
                last = np.searchsorted(y[:, 0], x[:, 0] + reach)
                for i in range(len(x)):
                    j = slice(first[i], last[i])
                    distance2 = ((y[j] - x[i]) ** 2).sum(axis=1)
                    touching += (distance2 < (radius[j] + radius[i]) ** 2).sum()
    return touching / len(x) - 1.0   # each grain found itself


class Pour(StylesTest):
    def shortened(self, path, steps):
        """The example itself; the quick version only changes its numbers of steps and of output."""
        text = path.read_text()
        return text if FULL else re.sub(r"(?m)^run\s+\d+", f"run {steps}", text).replace("thermo\t\t1000", "thermo 250")

    def check(self, name, steps, vertical, lengths):
        text = self.shortened(source_file("examples", "pour", name), steps) + WRITE
        stock = self.run_lammps(text, timeout=1200)
        stock_heap = self.heap(stock, vertical, lengths)
        for precision in ("double", "mixed"):
            ours = self.run_lammps(text, gpudem=precision, threads=2, timeout=1200)
            self.assertResident(ours)
            heap = self.heap(ours, vertical, lengths)
            _say(self.id() + " " + precision, {"height": heap[0] / stock_heap[0] - 1, "contacts": heap[1] - stock_heap[1]})
            self.assertEqual(len(stock.thermo()), len(ours.thermo()))
            for (columns, a), (_, b) in zip(stock.thermo(), ours.thermo()):
                atoms, energy = columns.index("Atoms"), columns.index("KinEng")
                np.testing.assert_array_equal(a[:, atoms], b[:, atoms], "poured grains")
                self.assertLessEqual(np.abs(a[:, energy] - b[:, energy]).max(), BULK_ENERGY_BAND * a[:, energy].max())
            self.assertLessEqual(abs(heap[0] - stock_heap[0]), BULK_HEIGHT * stock_heap[0])
            self.assertLessEqual(abs(heap[1] - stock_heap[1]), BULK_SIGMAS * np.sqrt(4 * stock_heap[1] / heap[2]))
        self.assertGreater(stock_heap[1], 0.2, "grains should touch by now")

    def heap(self, run, vertical, lengths):
        names, a = list(run.dump().values())[-1]
        x = a[:, [names.index(c) for c in "xyz"]]
        return x[:, vertical].mean(), coordination(x, a[:, names.index("radius")], lengths), len(x)

    def test_pour(self):
        # both runs of the file: pouring, then flow down the tilted box
        self.check("in.pour", 6000, vertical=2, lengths=(20.0, 20.0, None))

    def test_pour_2d(self):
        self.check("in.pour.2d", 12000, vertical=1, lengths=(None, None, None))


if __name__ == "__main__":
    unittest.main(verbosity=2)
