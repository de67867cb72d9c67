# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Runs that are long, or stopped and continued many times.

Quick: 25 continuations, 5*10^4 steps of a small drum. GPUDEM_LONG=1: 1000 continuations, 10^7 steps.
"""
import os
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "styles"))

import scenes                                   # noqa: E402
from compare import compare_dumps               # noqa: E402
from lammps import StylesTest                   # noqa: E402
from tolerance import CONTINUATIONS             # noqa: E402

LONG = bool(os.environ.get("GPUDEM_LONG"))


class LongRuns(StylesTest):
    def test_many_continuations(self):
        """A process for every ten steps, each of which reads what the one before wrote: as many runs in one process.

        (Not the run without stops: at the start of a run LAMMPS evaluates dashpots with the velocity of the full step.)
        """
        times, steps = (1000, 10) if LONG else (25, 10)
        law = scenes.middle(scenes.HERTZ_HISTORY)
        fixes = "fix move all nve/sphere\nfix down all gravity 10.0 vector 0.3 0 -1\n" \
                "fix floor all wall/gran hertz/history 2.0e5 NULL 200.0 NULL 0.5 1 zplane 0.05 NULL\n"
        data = ("cloud.data", scenes.cloud(cells=(5, 5, 5), margin=(0, 0, 0.3)))
        whole = self.run_lammps(scenes.head("p p f") + law + fixes + scenes.output(times * steps) + f"run {steps}\n" * times, [data],
                                gpudem="double", name="whole", timeout=1000)
        state = None
        for k in range(times):
            head = scenes.head("p p f") if state is None else "newton off\ncomm_modify vel yes\nread_restart state\n"
            text = head + law + fixes + scenes.output(times * steps) + f"run {steps}\nwrite_restart state.next\n"
            run = self.run_lammps(text, [data] if state is None else [("state", state)], gpudem="double", name=f"part{k % 2}")
            state = run.path("state.next").read_bytes()
        last = times * steps
        compare_dumps(self, {last: whole.dump()[last]}, {last: run.dump()[last]}, CONTINUATIONS, scenes.DIAMETER,
                      what=f"{times} continuations")

    def test_drum_turns_on(self):
        """A drum keeps all its grains inside, awake and calm, however long it turns."""
        steps = 10_000_000 if LONG else 50_000
        radius, speed = 4.0, 1.5
        text = scenes.head("f f f") + scenes.middle(scenes.HOOKE_HISTORY, timestep=5.0e-4) + \
            "fix move all nve/sphere\nfix down all gravity 10.0 vector 0 -1 0\n" \
            f"fix drum all wall/gran hooke/history 2.0e4 NULL 200.0 NULL 0.7 1 zcylinder {radius} shear x {speed}\n" \
            "fix ends all wall/gran hooke/history 2.0e4 NULL 200.0 NULL 0.7 1 zplane 0.0 2.7\n" \
            "thermo_style custom step atoms ke\nthermo_modify norm yes\n" \
            f"thermo {steps // 20}\nrun {steps}\nwrite_dump all custom last id x y z radius modify sort id format float %.17g\n"
        data = ("cloud.data", scenes.cloud(cells=(8, 8, 3), speed=0.5, centred=True, margin=(0.8, 0.8, 0.8)))
        for precision in ("double", "mixed"):
            run = self.run_lammps(text, [data], gpudem=precision, timeout=7000)
            self.assertResident(run)
            _, rows = run.thermo()[0]
            self.assertEqual(set(rows[:, 1]), {rows[0, 1]})
            early, late = rows[4:12, 2].mean(), rows[13:, 2].mean()
            self.assertLess(abs(late - early), 0.5 * early, "the drum has not kept its kinetic energy")
            grains = np.loadtxt(run.path("last"), skiprows=9)
            self.assertLess(np.max(np.hypot(grains[:, 1], grains[:, 2]) + 0.95 * grains[:, 4]), radius)


if __name__ == "__main__":
    unittest.main(verbosity=2)
