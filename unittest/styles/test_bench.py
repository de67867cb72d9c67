# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""The benchmark programs run, in little, and their tables say what must be so at any size. Times are not judged."""
import csv
import os
import pathlib
import subprocess
import sys
import unittest

from lammps import GPUDEM, StylesTest, source_file
from tolerance import MIXED

BENCH = pathlib.Path(__file__).resolve().parent.parent.parent / "bench"
sys.path.insert(0, str(BENCH))

import feature_pairs  # noqa: E402
import features  # noqa: E402


class BenchTest(StylesTest):
    def table(self, program, *words):
        """The rows that a program writes for these words."""
        path = self.root / "table.csv"
        command = [sys.executable, str(BENCH / program), "--lmp", GPUDEM, "--device", "cpu", "--threads", "1", "--turns", "1", "--scratch",
                   str(self.root), "--csv", str(path), *map(str, words)]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=240,
                              env=dict(os.environ, OMPI_MCA_orte_tmpdir_base=str(self.root)))
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])
        with open(path, newline="") as f:
            return list(csv.DictReader(f))


class Features(BenchTest):
    def test_edits(self):
        """Every script can be made: the lines that edits replace are there."""
        for pair in feature_pairs.FEATURES + feature_pairs.IDLE:
            for edits in (pair.absent, pair.present):
                self.assertIn("run ", features.script(pair.scene, edits))

    def test_pairs(self):
        """What a feature stores it stores only where it is present; scripts that move the grains alike have the same energy."""
        rows = self.table("features.py", "--data", source_file("bench", "data.chute"), "--bed", 1, "--settle", 300, "--warm", 5, "--steps",
                          5, "--only", "history bed", "groups", "wall:", "output", "twice bed", "no fix names", "size", "coefficient 0")
        self.assertEqual(len(rows), 13)
        pairs = {(p.feature, p.scene, p.with_): p for p in feature_pairs.FEATURES + feature_pairs.IDLE}
        more = {"history", "wall: plane", "wall: planes", "wall: cylinder", "wall: region"}
        for row in rows:
            with self.subTest(feature=row["feature"], with_=row["with"]):
                self.assertGreater(float(row["us_without"]), 0.0)
                self.assertGreater(float(row["us_with"]), 0.0)
                a, b = float(row["energy_without"]), float(row["energy_with"])
                if pairs[row["feature"], row["scene"], row["with"]].alike:
                    self.assertLessEqual(abs(a - b), MIXED.thermo * max(abs(a), abs(b)))
                a, b = float(row["bytes_without"]), float(row["bytes_with"])
                self.assertGreater(a, 0.0)
                if row["feature"] in more:
                    self.assertGreater(b, a)
                if row["feature"] in ("nothing: the same script twice", "groups", "output", "a group that no fix names"):
                    self.assertEqual(b, a)


class Surfaces(BenchTest):
    def test_scenes(self):
        """Each scene holds the grains that were asked for, which reach the triangles and nothing before the first step."""
        rows = self.table("surfaces.py", "--grains", 1500, "--triangles", 500, "--settle", 1500, "--steps", 50)
        self.assertEqual([(row["scene"], row["wall"]) for row in rows],
                         [("drum", "cylinder"), ("drum", "cylinder and bars, region"), ("drum", "triangles"), ("screw", "box"),
                          ("screw", "triangles"), ("slide", "box"), ("slide", "triangles")])
        for row in rows:
            with self.subTest(scene=row["scene"], wall=row["wall"]):
                self.assertEqual(int(row["grains"]), 1500)
                self.assertGreater(float(row["us_per_step"]), 0.0)
                if row["wall"] == "triangles":
                    self.assertGreater(int(row["triangles"]), 400)
                    self.assertGreater(int(row["contacts"]), 0)
                    self.assertGreater(float(row["ratio"]), 0.0)

    def test_bare(self):
        """A drum without lifters: nothing but the shell differs, and its exact shape is the cylinder."""
        rows = self.table("surfaces.py", "--scenes", "drum", "--bare", "--grains", 1500, "--triangles", 300, "3000", "--settle", 1500,
                          "--steps", 50)
        self.assertEqual([row["wall"] for row in rows], ["cylinder", "triangles", "triangles"])
        for row in rows[1:]:
            self.assertEqual(row["ratio"], row["ratio_exact"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
