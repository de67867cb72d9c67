# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Restart and data files travel between stock LAMMPS and GPUDEM, contact springs included."""
import unittest

import numpy as np

import scenes
from compare import compare_dumps, compare_thermo
from lammps import StylesTest
from tolerance import DOUBLE, DOUBLE_LONG, ROUND_OFF

HALF = 100
FIXES = """fix move active nve/sphere
fix down all gravity 10.0 chute 20.0
fix ice bottom freeze
fix w all wall/gran hooke/history 2.0e4 NULL 50.0 NULL 0.5 1 yplane 0.05 7.1
"""
GROUPS = "group bottom type 2\ngroup active subtract all bottom\n"
CLOUD = dict(frozen_layer=True, margin=(0.05, 0.05, 0.5))
BOUNDARY = "p f f"


class Restart(StylesTest):
    pair = scenes.HOOKE_HISTORY
    coeff = ("* *",)

    def first_half(self, gpudem):
        text = (scenes.head(BOUNDARY) + scenes.middle(self.pair, coeff=self.coeff) + GROUPS + FIXES + scenes.output(HALF) +
                f"restart {HALF} state.*\nrun {HALF}\nwrite_restart state.written\n")
        return self.run_lammps(text, [("cloud.data", scenes.cloud(**CLOUD))], gpudem=gpudem)

    def second_half(self, gpudem, state, restate_pair=True, every=50, steps=HALF):
        """restate_pair: name the pair style again, which keeps its springs. Without it stock LAMMPS leaves the
        option limit_damping unset, and its forces depend on what stood in memory before."""
        text = scenes.head(BOUNDARY, read="read_restart state").replace("atom_style sphere\n", "")
        text = text.replace("dimension 3\n", "").replace("units lj\n", "").replace(f"boundary {BOUNDARY}\n", "")
        if restate_pair:
            text += f"pair_style {self.pair}\n" + "".join(f"pair_coeff {c}\n" for c in self.coeff)
        text += ("neighbor 0.05 bin\nneigh_modify delay 0 every 1 check yes\ntimestep 1.0e-4\n" + FIXES +
                 scenes.output(every) + f"run {steps}\n")
        return self.run_lammps(text, [("state", state.read_bytes())], gpudem=gpudem)

    def check(self, writer, reader, file="state.100", restate_pair=True):
        stock = self.second_half(None, self.first_half(None).path(file))
        written = self.first_half(writer)
        if writer:
            self.assertResident(written)
        ours = self.second_half(reader, written.path(file), restate_pair)
        if reader:
            self.assertResident(ours)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)

    def test_stock_to_gpudem(self):
        self.check(None, "double")

    def test_gpudem_to_stock(self):
        self.check("double", None)

    def test_gpudem_to_gpudem(self):
        self.check("double", "double")

    def test_write_restart_command(self):
        self.check("double", None, file="state.written")
        self.check(None, "double", file="state.written")

    def test_pair_style_from_file(self):
        self.check("double", "double", restate_pair=False)
        self.check(None, "double", restate_pair=False)

    def test_springs_are_carried(self):
        """Forces right after reading are those before writing, and would not be without the springs."""
        written = self.first_half("double")
        for reader in ("double", None):
            read = self.second_half(reader, written.path("state.100"), every=1, steps=0)
            names, before = written.dump()[HALF]
            names, after = read.dump()[HALF]
            # the force at setup sees full-step velocities, the one of the step half-step ones: torques show the
            # springs best, because sliding resistance is mostly spring here
            torque = [names.index(c) for c in ("tqx", "tqy", "tqz")]
            forgotten = self.forgotten(written)
            scale = np.abs(before[:, torque]).max()
            kept = np.abs(after[:, torque] - before[:, torque]).max() / scale
            lost = np.abs(forgotten[:, torque] - before[:, torque]).max() / scale
            self.assertLess(kept, 0.25 * lost, f"read by {reader}")

    def forgotten(self, written):
        """The same state from a data file, which stores no springs."""
        text = ("read_restart state\nwrite_data state.data\nclear\n" + scenes.head(BOUNDARY, read="read_data state.data") +
                scenes.middle(self.pair, coeff=self.coeff) + GROUPS + FIXES + scenes.output(1) + "run 0\n")
        return self.run_lammps(text, [("state", written.path("state.100").read_bytes())]).dump()[0][1]

    def test_setup_forces_equal_stock(self):
        """At the first step after reading, nothing but the order of sums differs."""
        state = self.first_half(None).path("state.100")
        stock = self.second_half(None, state, every=1, steps=0)
        ours = self.second_half("double", state, every=1, steps=0)
        compare_dumps(self, stock.dump(), ours.dump(), ROUND_OFF, scenes.DIAMETER)


class HertzRestart(Restart):
    pair = scenes.HERTZ_HISTORY


class GranularRestart(Restart):
    """Two types, both of which rescale: stock then leaves a gap in what a contact keeps."""
    pair = "granular"
    coeff = tuple(f"{t} hertz/material {e} 20.0 0.3 tangential mindlin_rescale NULL 0.5 0.4"
                  for t, e in (("1 1", 2.0e5), ("1 2", 3.0e5), ("2 2", 4.0e5)))

    def test_pair_style_from_file(self):
        """Stock LAMMPS leaves unset what pair_style granular keeps when it comes from a file: GPUDEM to GPUDEM only."""
        self.check("double", "double", restate_pair=False)

    def test_springs_are_carried(self):
        self.skipTest("torques do not tell springs from dashpots as clearly as in the base class")


class RollingRestart(Restart):
    """Everything a contact can keep; mixed coefficients. Stock turns rolling springs round at rebuilds: GPUDEM alone."""
    pair = "granular"
    coeff = tuple(f"{t} hertz/material {e} 0.8 0.3 damping tsuji tangential mindlin_rescale/force NULL 0.5 0.4 "
                  "rolling sds 1.0e4 30.0 0.2 twisting marshall" for t, e in (("1 1", 2.0e5), ("2 2", 4.0e5)))

    def check(self, writer, reader, file="state.100", restate_pair=True):
        text = (scenes.head(BOUNDARY) + scenes.middle(self.pair, coeff=self.coeff) + GROUPS + FIXES +
                scenes.output(50) + f"run {HALF}\nrun {HALF}\n")
        whole = self.run_lammps(text, [("cloud.data", scenes.cloud(**CLOUD))], gpudem="double").dump()
        ours = self.second_half("double", self.first_half("double").path(file), restate_pair).dump()
        compare_dumps(self, {s: whole[s] for s in whole if s > HALF}, {s: ours[s] for s in ours if s > HALF},
                      DOUBLE_LONG, scenes.DIAMETER)

    test_stock_to_gpudem = test_gpudem_to_stock = test_springs_are_carried = test_setup_forces_equal_stock = None


class DataFile(StylesTest):
    def test_write_data_read_data(self):
        """A data file written by either code starts the same run in either code."""
        first = (scenes.head() + scenes.middle() + "fix move all nve/sphere\n" + scenes.output(50) +
                 "run 100\nwrite_data later.data\n")
        second = (scenes.head(read="read_data later.data") + scenes.middle() + "fix move all nve/sphere\n" +
                  scenes.output(50) + "run 100\n")
        files = [("cloud.data", scenes.cloud())]
        results = []
        for writer, reader in ((None, None), ("double", None), (None, "double"), ("double", "double")):
            state = self.run_lammps(first, files, gpudem=writer).path("later.data").read_text()
            results.append(self.run_lammps(second, [("later.data", state)], gpudem=reader))
        for ours in results[1:]:
            compare_dumps(self, results[0].dump(), ours.dump(), DOUBLE, scenes.DIAMETER)


if __name__ == "__main__":
    unittest.main(verbosity=2)
