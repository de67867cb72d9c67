# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Bad input ends with a message that names the offending word; scenes that cannot be resident say why and still run."""
import os
import pathlib
import unittest

import scenes
from compare import compare_dumps, compare_thermo
from lammps import GPUDEM, STOCK, StylesTest
from tolerance import DOUBLE

NVE = "fix move all nve/sphere\n"


class Errors(StylesTest):
    def fails(self, text, *phrases, cloud=None, environment=None, gpudem="double"):
        run = self.run_lammps(text, [("cloud.data", cloud or scenes.cloud(cells=(5, 5, 5)))], gpudem=gpudem,
                              environment=environment, succeed=False, timeout=60)
        self.assertNotEqual(run.status, 0, run.screen[-1500:])
        for phrase in phrases:
            self.assertIn(phrase, run.everything)
        return run

    def test_unknown_keyword(self):
        self.fails("gpudem foo 1\n", "ERROR", "'foo'", "device, precision, threads, neighbor, levels, warps, conventions, info")

    def test_unknown_value(self):
        self.fails("gpudem precision half\n", "ERROR", "'half'", "'precision'", "double, mixed")
        self.fails("gpudem device tpu\n", "ERROR", "'tpu'", "'device'", "auto, gpu, cpu")
        self.fails("gpudem threads none\n", "ERROR", "'none'", "'threads'", "whole number")
        self.fails("gpudem threads 0\n", "ERROR", "'0'", "'threads'")
        self.fails("gpudem neighbor grid\n", "ERROR", "'grid'", "'neighbor'", "auto, single, multigrid")
        self.fails("gpudem levels 13\n", "ERROR", "'13'", "'levels'", "at most 12")
        for word in ("few", "0", "-2", "2.5", "3x"):
            self.fails(f"gpudem levels {word}\n", "ERROR", f"'{word}'", "'levels'", "whole number of at least 1")

    def test_missing_value(self):
        self.fails("gpudem precision\n", "ERROR", "'precision'", "no value")
        self.fails("gpudem\n", "ERROR", "keyword value")

    def test_environment(self):
        self.fails(scenes.scene(steps=1), "ERROR", "GPUDEM_PRECISION", "'half'", environment={"GPUDEM_PRECISION": "half"})

    def test_no_gpu(self):
        text = "gpudem device gpu\n" + scenes.scene(steps=1)
        run = self.run_lammps(text, [("cloud.data", scenes.cloud(cells=(5, 5, 5)))], gpudem="double", succeed=False,
                              environment={"CUDA_VISIBLE_DEVICES": ""})
        self.assertNotEqual(run.status, 0)
        self.assertIn("gpudem device gpu", run.everything)
        self.assertIn("no usable GPU", run.everything)

    def test_infinite_velocity(self):
        """From a variable: LAMMPS itself refuses such a word in a data file."""
        for precision in ("double", "mixed"):
            text = scenes.scene(before="variable bad atom (id==17)*1.0e308*1.0e10\n",
                                after="run 20\nvelocity all set v_bad NULL NULL\nrun 50\n")
            run = self.fails(text, "ERROR", gpudem=precision)
            self.assertRegex(run.everything, "[Aa]tom 17 .*step")

    def test_not_a_number(self):
        for precision in ("double", "mixed"):
            text = scenes.scene(before="variable bad atom (id==17)*1.0e308*1.0e10-(id==17)*1.0e308*1.0e10\n",
                                after="run 20\nvelocity all set v_bad NULL NULL\nrun 50\n")
            run = self.fails(text, "ERROR", gpudem=precision)
            self.assertRegex(run.everything, "[Aa]tom 17 .*step")

    def test_not_a_number_from_a_host_fix(self):
        text = scenes.scene(NVE + "variable bad atom (id==17)*(step>10)*1.0e308*1.0e10\n"
                            "fix push all addforce v_bad 0 0\n")
        run = self.fails(text, "ERROR")
        self.assertRegex(run.everything, "[Aa]tom 17 .*step")

    def test_much_too_fast(self):
        """A grain that crosses the box in one step."""
        def edit(atoms, velocities):
            velocities[41][2] = 1.0e9
        files = [("cloud.data", scenes.cloud(cells=(5, 5, 5), edit=edit))]
        for precision in ("double", "mixed"):
            run = self.run_lammps(scenes.scene(steps=20), files, gpudem=precision, succeed=False, timeout=60)
            if run.status == 0:   # survived: then it must agree with stock about who is still there
                stock = self.run_lammps(scenes.scene(steps=20), files)
                self.assertEqual(stock.thermo()[-1][1][-1, 1], run.thermo()[-1][1][-1, 1])
            else:
                self.assertIn("42", run.everything)

    def test_zero_diameter(self):
        """A point has no place in a contact law. LAMMPS' nve/sphere refuses it; GPUDEM does even where nothing moves it."""
        cloud = scenes.cloud(cells=(5, 5, 5))
        self.fails(scenes.scene(after="set atom 9 diameter 0.0\nrun 20\n"), "ERROR", "extended particles", cloud=cloud)
        for fixes in ("fix move some nve/sphere\n", ""):
            self.fails(scenes.scene(fixes, before="group some id 10:125\n", after="set atom 9 diameter 0.0\nrun 20\n"),
                       "ERROR", "atom 9 at step", "the radius 0", "above 0", cloud=cloud)

    def test_diameter_that_is_no_number(self):
        """In the data, and in a run that goes on after it."""
        bad = "variable bad atom 1.0e308*1.0e10-1.0e308*1.0e10\nset atom 9 diameter v_bad\n"
        for before, after in ((bad, "run 20\n"), ("", "run 20\n" + bad + "run 20\n")):
            self.fails(scenes.scene(before=before, after=after), "ERROR", "atom 9", "radius", "nan", "above 0")

    def test_wrong_style_arguments(self):
        self.fails(scenes.scene(pair="gran/hooke/history 2.0e4 NULL 50.0"), "ERROR", "Illegal pair_style command")
        self.fails(scenes.scene("fix move all nve/sphere\nfix w all wall/gran hooke 1 2 3\n"), "ERROR", "wall/gran")


class GranularErrors(StylesTest):
    """Every wrong word of a contact law: the message names the word and what would be right, and LAMMPS adds the line."""
    REST = "tangential mindlin NULL 1.0 0.4"
    CASES = (
        ("hertz/materal 1e5 0.3 0.3 " + REST, ("'hertz/materal'", "known are", "hertz/material")),
        ("hertz/material 1e5 0.3 " + REST, ("'tangential'", "nu of normal hertz/material", "E eta nu")),
        ("hertz/material 1e5", ("eta of normal hertz/material", "missing")),
        ("hertz/material 1e5 0.3 0.7 " + REST, ("nu = 0.7", "above -1 and at most 0.5")),
        ("hertz/material 1e5 0.3 -1.0 " + REST, ("nu = -1", "above -1 and at most 0.5")),
        ("hertz/material -1e5 0.3 0.3 " + REST, ("E = -100000", "must be positive")),
        ("hertz/material 1e5 1.2 0.3 damping tsuji " + REST, ("tsuji", "e = 1.2", "above 0 and at most 1")),
        ("hertz/material 1e5 0 0.3 damping coeff_restitution " + REST, ("e = 0", "above 0 and at most 1")),
        ("hertz/material 1e5 -3 0.3 " + REST, ("viscoelastic", "eta = -3", "must not be negative")),
        ("hooke 1e5 50 damping tsujii " + REST, ("'tsujii'", "known are velocity")),
        ("hooke 1e5 50 " + REST, ("NULL", "material")),
        ("hooke 1e5 50", ("'tangential'", "missing")),
        (REST, ("normal sub-model", "missing")),
        ("hooke 1e5 50 tangential linear_history 1e4 1.0", ("mu of tangential linear_history", "missing")),
        ("hooke 1e5 50 tangential linear_history 1e4 1.0 -0.4", ("mu = -0.4", "between 0 and 10000")),
        ("hooke 1e5 50 tangential linear_history NULL 1.0 0.4", ("kt of tangential linear_history", "cannot be NULL")),
        ("hertz 1e5 50 tangential mindlin 1e5 1.0 0.4 rolling sds 1e3 10", ("mu of rolling sds", "missing")),
        ("hertz 1e5 50 tangential mindlin 1e5 1.0 0.4 rolling epsd9 1e3", ("'epsd9'", "sds")),
        ("hertz 1e5 50 tangential mindlin 1e5 1.0 0.4 twisting sds 1e3 -1 0.1", ("gamma = -1", "must not be negative")),
        ("jkr 1e5 50 0.3 10 " + REST + " limit_damping", ("limit_damping", "jkr")),
        ("hertz 1e5 50 tangential mindlin 1e5 1.0 0.4 synchronized_verlet", ("'synchronized_verlet'", "not available")),
        ("hertz 1e5 abc tangential mindlin 1e5 1.0 0.4", ("'abc'", "eta of normal hertz")),
        ("hertz nan 50 tangential mindlin 1e5 1.0 0.4", ("kn", "nan")),
    )

    def test_pair_coeff(self):
        files = [("cloud.data", scenes.cloud(cells=(3, 3, 3)))]
        for law, phrases in self.CASES:
            with self.subTest(law=law):
                run = self.run_lammps(scenes.scene(pair="granular", coeff=(f"* * {law}",), steps=0), files, gpudem="double",
                                      succeed=False)
                self.assertNotEqual(run.status, 0)
                for phrase in ("ERROR: Pair_coeff: ", f"Last command: pair_coeff * * {law}", *phrases):
                    self.assertIn(phrase, run.everything)

    def test_wall(self):
        files = [("cloud.data", scenes.cloud(cells=(3, 3, 3)))]
        for law, phrases in self.CASES:
            with self.subTest(law=law):
                fix = f"fix w all wall/gran granular {law} zplane 0.05 NULL"
                run = self.run_lammps(scenes.scene(fix, boundary="p p f", steps=0), files, gpudem="double", succeed=False)
                self.assertNotEqual(run.status, 0)
                for phrase in ("ERROR: Fix wall/gran: ", f"Last command: {fix}", *phrases[:1]):
                    self.assertIn(phrase, run.everything)

    def test_mixing_of_different_models(self):
        text = scenes.scene(pair="granular", coeff=(f"1 1 hertz/material 1e5 20 0.3 {self.REST}", "2 2 hooke 1e5 20 tangential "
                            "linear_history 1e4 1.0 0.4"), steps=0)
        run = self.run_lammps(text, [("cloud.data", scenes.cloud(cells=(3, 3, 3)))], gpudem="double", succeed=False)
        self.assertNotEqual(run.status, 0)
        for phrase in ("types 1 and 2", "hertz/material and hooke differ", "give pair_coeff 1 2"):
            self.assertIn(phrase, run.everything)


class StillRuns(StylesTest):
    def falls_back(self, text, *phrases, files=None, **kw):
        files = files or [("cloud.data", scenes.cloud())]
        stock = self.run_lammps(text, files, **kw)
        ours = self.run_lammps(text, files, gpudem="double", **kw)
        for phrase in ("not resident", *phrases):
            self.assertIn(phrase, ours.everything)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)
        compare_thermo(self, stock.thermo(), ours.thermo(), DOUBLE)

    def test_triclinic(self):
        text = scenes.scene(steps=100).replace("pair_style", "change_box all triclinic\npair_style", 1)
        self.falls_back(text, "triclinic")

    def test_pair_without_device_version(self):
        self.falls_back(scenes.scene(steps=100, pair="soft 1.0", coeff=("* * 100.0",)), "pair style soft")

    def test_granular_without_residency(self):
        """LAMMPS' own loop reads its tables, which GPUDEM filled, by the stock style's compute()."""
        law = "hertz/material 2.0e5 20.0 0.3 tangential mindlin_rescale NULL 0.5 0.4 rolling sds 1.0e4 30.0 0.2"
        text = scenes.scene(steps=100, pair="granular", coeff=tuple(f"{t} {law}" for t in ("1 1", "1 2", "2 2")), skin=0.4,
                            neighbor="delay 1000 every 1000 check no")
        self.falls_back(text.replace("pair_style", "change_box all triclinic\npair_style", 1), "triclinic")

    def test_hybrid(self):
        law = "gran/hooke 2.0e4 NULL 50.0 NULL 0.5 1"
        self.falls_back(scenes.scene(steps=100, pair=f"hybrid {law} soft 1.0",
                                     coeff=("* 1 gran/hooke", "1 2 gran/hooke", "2 2 soft 100.0")), "pair style hybrid")

    def test_deforming_box(self):
        text = scenes.scene(NVE + "fix press all deform 1 z scale 0.95\n", steps=100)
        self.falls_back(text, "changes the box")

    def test_small_periodic_box(self):
        text = scenes.scene(steps=100)
        self.falls_back(text, "twice the interaction range", files=[("cloud.data", scenes.cloud(cells=(2, 8, 8)))])

    def test_ghost_velocities_not_asked_for(self):
        text = scenes.scene(steps=100)
        files = [("cloud.data", scenes.cloud())]
        stock = self.run_lammps(text, files)
        ours = self.run_lammps(text.replace("comm_modify vel yes\n", ""), files, gpudem="double")
        self.assertIn("comm_modify vel yes", ours.screen)
        self.assertIn("WARNING", ours.screen)
        self.assertResident(ours)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)

    def test_empty_box(self):
        """Nothing to move, nothing announced: the stock loop runs."""
        text = scenes.head(read="region all block 0 5 0 5 0 5\ncreate_box 1 all") + scenes.middle() + NVE + "run 10\n"
        run = self.run_lammps(text, gpudem="double")
        self.assertIn("no grain", run.everything)

    def test_one_grain(self):
        def only_first(atoms, velocities):
            del atoms[1:], velocities[1:]
        data = scenes.cloud(edit=only_first).replace("512 atoms", "1 atoms")
        text = scenes.scene(NVE + "fix down all gravity 1.0 vector 0 0 -1\n", boundary="p p s")
        for boundary in ("p p p", "p p f"):
            text = scenes.scene(NVE + "fix down all gravity 1.0 vector 0 0 -1\n", boundary=boundary)
            stock = self.run_lammps(text, [("cloud.data", data)])
            ours = self.run_lammps(text, [("cloud.data", data)], gpudem="double")
            compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)


class Doors(StylesTest):
    def test_preloaded_into_stock(self):
        """The library preloaded into stock lmp does what the launcher does."""
        library = os.environ.get("GPUDEM_LIBRARY") or pathlib.Path(GPUDEM).resolve().parent / "gpudemplugin.so"
        if not pathlib.Path(library).exists():
            self.skipTest("gpudemplugin.so is not beside the launcher; set GPUDEM_LIBRARY")
        files, text = [("cloud.data", scenes.cloud())], scenes.scene(steps=100)
        launcher = self.run_lammps(text, files, gpudem="double")
        preloaded = self.run_lammps(text, files, gpudem="double", executable=STOCK,
                                    environment={"LD_PRELOAD": str(library)})
        self.assertResident(preloaded)
        self.assertEqual(launcher.path("dump.out").read_bytes(), preloaded.path("dump.out").read_bytes())

    def test_without_suffix(self):
        """Without the suffix the launcher is an ordinary lmp."""
        files, text = [("cloud.data", scenes.cloud())], scenes.scene(steps=100)
        stock = self.run_lammps(text, files)
        ours = self.run_lammps(text, files, executable=GPUDEM)
        self.assertNotIn("GPUDEM", ours.everything.replace(str(self.root), ""))
        self.assertEqual(stock.path("dump.out").read_bytes(), ours.path("dump.out").read_bytes())

    def test_explicit_style_names(self):
        """A script may name the styles itself."""
        files = [("cloud.data", scenes.cloud())]
        stock = self.run_lammps(scenes.scene(steps=100), files)
        text = scenes.scene("run_style verlet/gpudem\nfix move all nve/sphere/gpudem", steps=100).replace(
            "pair_style gran/hooke/history", "pair_style gran/hooke/history/gpudem")
        ours = self.run_lammps(text, files, gpudem="double", arguments=[])
        self.assertResident(ours)
        compare_dumps(self, stock.dump(), ours.dump(), DOUBLE, scenes.DIAMETER)

    def test_settings_command(self):
        files = [("cloud.data", scenes.cloud())]
        run = self.run_lammps("gpudem precision double threads 2 device cpu\n" + scenes.scene(steps=10), files,
                              gpudem="mixed")
        self.assertIn("precision : double, coordinates of 64 bits", run.log)
        self.assertIn("2 threads", run.log)
        for groups, bits in ((7, 40), (8, 32)):   # and the group of nve/sphere
            crowd = "".join(f"group g{k} id {k + 1}:{k + 40}\nfix v{k} g{k} viscous 0.01\n" for k in range(groups))
            run = self.run_lammps(scenes.scene(steps=10, before=crowd), files, gpudem="mixed")
            self.assertIn(f"precision : mixed, coordinates of {bits} bits", run.log)
        quiet = self.run_lammps("gpudem info no\n" + scenes.scene(steps=10), files, gpudem="mixed")
        self.assertNotIn("GPUDEM resident run", quiet.log)


class Determinism(StylesTest):
    def test_bitwise(self):
        """Same input, same bits: from run to run and for any number of threads."""
        fixes = ("fix move all nve/sphere\nfix down all gravity 10.0 chute 20\n"
                 "fix w all wall/gran hertz/history 2.0e5 NULL 200.0 NULL 0.5 1 zplane 0.05 NULL\n")
        text = scenes.scene(fixes, boundary="p p f", every=20, pair=scenes.HERTZ_HISTORY,
                            thermo=scenes.THERMO + " press temp")
        files = [("cloud.data", scenes.cloud(cells=(10, 10, 8), margin=(0, 0, 0.5)))]
        for precision in ("double", "mixed"):
            runs = [self.run_lammps(text, files, gpudem=precision, threads=t) for t in (1, 1, 2, 3)]
            for other in runs[1:]:
                self.assertEqual(runs[0].path("dump.out").read_bytes(), other.path("dump.out").read_bytes(), precision)
                self.assertEqual(str(runs[0].thermo()), str(other.thermo()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
