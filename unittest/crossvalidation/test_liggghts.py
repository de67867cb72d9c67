# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Contact laws of LIGGGHTS 3.8 against GPUDEM's sub-models of the same names, step by step.

What scripts/crossvalidate --quick prints, with bounds."""
import os
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "testing"))

import bulk  # noqa: E402
import rolling  # noqa: E402
from collisions import differences, questions, terms  # noqa: E402
from programs import Programs  # noqa: E402
from tolerance import BULK_APART, BULK_SEEDS, OTHER_READING, ROLLING_DISTANCE, ROLLS_ALIKE, SAME_LAW  # noqa: E402

PROGRAMS = Programs()


def name(text):
    return "test_" + re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")


@unittest.skipUnless(PROGRAMS.liggghts, "liggghts is not installed")
class Contacts(unittest.TestCase):
    def compare(self, scene, reference, precision):
        return differences(scene, PROGRAMS.run(scene, precision).rows, reference.rows)

    def agree(self, scene):
        reference = PROGRAMS.run(scene, "liggghts")
        for precision, bound in SAME_LAW.items():
            for what, difference in self.compare(scene, reference, precision).items():
                self.assertLessEqual(difference, bound.relative, f"{scene.name}, {precision}, {what} ({bound.reason})")

    def choose(self, readings, answer):
        """One reading agrees to round-off; the others are seen to differ."""
        for reading, scene in readings.items():
            largest = max(self.compare(scene, PROGRAMS.run(scene, "liggghts"), "double").values())
            if reading == answer:
                self.assertLessEqual(largest, SAME_LAW["double"].relative, reading)
            else:
                self.assertGreater(largest, OTHER_READING, reading)


class Terms(Contacts):
    """Where the laws are meant to be the same."""


class Questions(Contacts):
    """What LIGGGHTS does where its documentation leaves it open."""


class Rolling(Contacts):
    def test_rolling_to_rest(self):
        for model in rolling.MODELS:
            scene = rolling.rolls(model)
            runs = {p: PROGRAMS.run(scene, p) for p in ("liggghts", "double", "mixed")}
            for program, run in runs.items():
                with self.subTest(model=model, program=program):
                    self.assertLessEqual(abs(run.rows[-1, 0, 0] / rolling.DISTANCE - 1.0), ROLLING_DISTANCE.relative)
                    found = differences(scene, run.rows, runs["liggghts"].rows)
                    self.assertLessEqual(max(found["velocity"], found["spin"]), ROLLS_ALIKE.relative, ROLLS_ALIKE.reason)


@unittest.skipUnless(PROGRAMS.liggghts and os.environ.get("GPUDEM_LONG"), "minutes: set GPUDEM_LONG")
class Bulk(unittest.TestCase):
    def test_means_over_seeds(self):
        for name, _, values, _ in bulk.compare(PROGRAMS, ("liggghts", "double", "mixed"), BULK_SEEDS):
            for quantity, of in values.items():
                for precision in ("double", "mixed"):
                    with self.subTest(scene=name, quantity=quantity, precision=precision):
                        self.assertLessEqual(abs(bulk.apart(of[precision], of["liggghts"])), BULK_APART, of)


for term, scene in terms():
    setattr(Terms, name(term), lambda self, scene=scene: self.agree(scene))
for question, readings, answer in questions():
    setattr(Questions, name(question), lambda self, readings=readings, answer=answer: self.choose(readings, answer))
del Contacts

if __name__ == "__main__":
    unittest.main(verbosity=2)
