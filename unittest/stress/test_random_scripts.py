# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Random scripts through stock LAMMPS and through GPUDEM in double precision: the same grains at every dump.

    GPUDEM_SEEDS=100:200 python3 test_random_scripts.py     other seeds; the input of one: random_script.py SEED
"""
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "styles"))

import scenes                                   # noqa: E402
from compare import compare_dumps               # noqa: E402
from lammps import StylesTest                   # noqa: E402
from random_script import RandomScript          # noqa: E402
from tolerance import FUZZ                      # noqa: E402

LONG = bool(os.environ.get("GPUDEM_LONG"))


def seeds():
    first, last = (int(s) for s in os.environ.get("GPUDEM_SEEDS", "1:400" if LONG else "1:24").split(":"))
    return range(first, last + 1)


class RandomScripts(StylesTest):
    def test_same_answer(self):
        refused = {}
        for seed in seeds():
            with self.subTest(seed=seed):
                why = self.check(RandomScript(seed), seed)
                if why:
                    refused[seed] = why
        self.assertLess(len(refused), 0.2 * len(seeds()), f"too many scripts that stock LAMMPS refuses: {refused}")

    def check(self, script, seed):
        stock = self.run_lammps(script.text, script.files, name=f"{seed}-stock", succeed=False)
        ours = self.run_lammps(script.text, script.files, gpudem="double", ranks=script.ranks, name=f"{seed}-gpudem",
                               environment=script.environment, succeed=False)
        refused = "ERROR" in stock.everything
        self.assertEqual("ERROR" in ours.everything, refused,
                         f"stock: {stock.everything[-400:]}\nGPUDEM: {ours.everything[-400:]}\n{script.text}")
        if refused:
            return next(line for line in stock.everything.splitlines() if "ERROR" in line)
        self.assertIn("GPUDEM resident run", ours.everything)
        compare_dumps(self, stock.dump(), ours.dump(), FUZZ, scenes.DIAMETER, what=f"seed {seed}\n{script.text}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
