# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""LAMMPS' examples/pour: insertion by fix pour on the host into a resident run. Chaotic, so bulk means are compared."""
import os
import re
import unittest

import numpy as np

import scenes
from compare import _say, compare_dumps, compare_thermo
from lammps import StylesTest, source_file
from tolerance import BULK_ENERGY_BAND, BULK_FLOW_SPREAD, BULK_HEIGHT, BULK_SIGMAS, DOUBLE

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
            spread = np.sqrt(4 * stock_heap[1] / heap[2] + 2 * (BULK_FLOW_SPREAD if FULL else 0.0) ** 2)
            self.assertLessEqual(abs(heap[1] - stock_heap[1]), BULK_SIGMAS * spread)
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

    def test_continued_heap(self):
        """A poured heap on its way down the chute, taken from a restart file: grain by grain for 1000 steps.

        The file is written during the run. The command write_restart would renew LAMMPS' ghosts before the springs are
        gathered, so that those across a periodic boundary get a wrong partner.
        """
        lines = source_file("examples", "pour", "in.pour").read_text()
        stop = 8000
        pour = re.sub(r"(?m)^run\s+\d+", f"run {stop // 2}", lines)
        last = pour.rindex("run ")
        state = self.run_lammps(pour[:last] + f"restart {stop - 500} state.*\n" + pour[last:]).path(f"state.{stop - 500}")
        begin, end = lines.index("pair_style"), lines.index("region\t\tslab")
        text = ("newton off\ncomm_modify vel yes\nread_restart state\nneighbor 0.2 bin\nneigh_modify delay 0\n" +
                lines[begin:end].replace("spherical 0.0 -180.0", "chute 26.0") + scenes.output(200) + "run 1000\n")
        files = [("state", state.read_bytes())]
        stock = self.run_lammps(text, files)
        ours = self.run_lammps(text, files, gpudem="double")
        self.assertResident(ours)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE, special={"Volume": DOUBLE.position})


if __name__ == "__main__":
    unittest.main(verbosity=2)
