# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Material files: the same run from a file and from numbers, every message, the search for files, the shipped sets."""
import math
import pathlib
import unittest

import numpy as np

import scenes
from compare import compare_dumps
from lammps import StylesTest
from tolerance import CHUNG_OOI, DOUBLE, DOUBLE_LONG, ROUND_OFF

SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "potentials"
HEADER = "# DATE: 2026-11-23 UNITS: lj CONTRIBUTOR: tests CITATION: none\n"
MATERIALS = HEADER + """
material soft young 2.0e5 poisson 0.3 density 2.0   # as dense as the mean of the cloud
material hard density 2.0 poisson 0.2 young 4.0e5
material wall young 1.0e6 poisson 0.25
"""
PAIRS = """
pair soft soft restitution 0.8 friction 0.4
pair hard soft restitution 0.6 friction 0.3
pair hard hard friction 0.5 restitution 0.7
pair soft wall restitution 0.5 friction 0.2
pair wall hard restitution 0.4 friction 0.1
"""
ROLLING = PAIRS.replace("friction 0.3", "friction 0.3 rolling 0.1").replace("friction 0.4", "friction 0.4 twisting 0.02")
ADHESIVE = PAIRS.replace("friction 0.3", "friction 0.3 surface_energy 30")
COEFF = ("* * m.gran soft hard",)
WALLS = "".join(f"fix low{t} type{t} {{style}} granular {law} {{surface}}\n" for t, law in (("1", "{soft}"), ("2", "{hard}")))
PLANE = dict(style="wall/gran", surface="zplane 0.05 NULL")
REGION = dict(style="wall/gran/region", surface="region floor")


def words_of_log(text):
    """{(i, j) or (grain, wall): words} that the log names for each pair."""
    words = {}
    for line in text.split("\n"):
        head, colon, law = line.strip().partition(": ")
        part = head.replace(",", "").split()
        if colon and part[:1] == ["types"]:
            words[tuple(part[1:3])] = law
        elif colon and part[1:5] == ["at", "a", "wall", "of"]:
            words[(part[0], part[5])] = law
    return words


class Numbers(StylesTest):
    def both(self, content, walls=None, precisions=("double", "mixed"), environment=None):
        """Runs from a file and from the numbers that its log names; the dumps must be the same to the last bit."""
        fixes = "fix move all nve/sphere\n"
        laws = dict(soft="m.gran soft wall", hard="m.gran hard wall")
        settings = dict(pair="granular", steps=200, boundary="p p f" if walls else "p p p",
                        before="group type1 type 1\ngroup type2 type 2\nregion floor plane 0 0 0.05 0 0 1\n" if walls else "")
        cloud = ("cloud.data", scenes.cloud(cells=(5, 5, 5), margin=(0, 0, 0.3 if walls else 0)))
        for precision in precisions:
            by_file = self.run_lammps(scenes.scene(fixes + (WALLS.format(**laws, **walls) if walls else ""), coeff=COEFF, **settings),
                                      [cloud, ("m.gran", content)], gpudem=precision)
            self.assertResident(by_file)
            self.assertIn("Reading material file m.gran with DATE: 2026-11-23", by_file.log)
            words = words_of_log(by_file.log)
            coeff = tuple(f"{i} {j} {words[(i, j)]}" for i, j in (("1", "1"), ("1", "2"), ("2", "2")))
            numbers = {name: words.get((name, "wall"), "") for name in laws}
            by_number = self.run_lammps(scenes.scene(fixes + (WALLS.format(**numbers, **walls) if walls else ""), coeff=coeff,
                                                     **settings), [cloud], gpudem=precision)
            self.assertEqual(by_file.path("dump.out").read_bytes(), by_number.path("dump.out").read_bytes(), precision)
        return words

    def test_hertz(self):
        words = self.both(MATERIALS + PAIRS)
        for pair, (e, mu) in {("1", "1"): (0.8, 0.4), ("1", "2"): (0.6, 0.3), ("2", "2"): (0.7, 0.5)}.items():
            w = words[pair].split()
            young, restitution, nu, xgt, friction = (float(w[k]) for k in (1, 2, 3, 9, 10))
            self.assertEqual((restitution, friction), (e, mu))
            material = {"1": (2.0e5, 0.3), "2": (4.0e5, 0.2)}
            both = [material[t] for t in pair]
            compliance = sum((1 - n * n) / y for y, n in both)                     # 1/E*
            shear = sum(2 * (2 - n) * (1 + n) / y for y, n in both)                # 1/G*
            self.assertAlmostEqual(2 * (1 - nu * nu) / young / compliance, 1, delta=ROUND_OFF.other)
            self.assertAlmostEqual(4 * (2 - nu) * (1 + nu) / young / shear, 1, delta=ROUND_OFF.other)
            self.assertAlmostEqual(xgt / (2 * math.sqrt(compliance / shear)), 1, delta=ROUND_OFF.other)
        self.assertEqual(words[("1", "1")].split()[1:4], ["200000", "0.8", "0.3"])

    def test_rolling_and_twisting(self):
        words = self.both(MATERIALS + ROLLING + "law radius 0.45 speed 3.0\n")
        self.assertIn("rolling sds", words[("1", "2")])
        self.assertIn("twisting sds", words[("1", "1")])
        self.assertNotIn("rolling", words[("2", "2")])

    def test_adhesion(self):
        words = self.both(MATERIALS + ADHESIVE)
        self.assertTrue(words[("1", "2")].startswith("jkr "))
        self.assertTrue(words[("2", "2")].startswith("hertz/material "))
        words = self.both(MATERIALS + ADHESIVE + "law dmt tangential mindlin_rescale\n", precisions=("double",))
        for law in words.values():
            self.assertTrue(law.startswith("dmt "))
            self.assertIn("mindlin_rescale NULL", law)

    def test_law(self):
        words = self.both(MATERIALS + "law tangential mindlin/force twisting marshall limit_damping tangential_damping 0.5\n"
                          + PAIRS, precisions=("double",))
        for law in words.values():
            self.assertIn("tangential mindlin/force NULL 0.5", law)
            self.assertTrue(law.endswith("twisting marshall limit_damping"))
        for rolling in ("epsd2", "epsd", "cdt"):
            words = self.both(MATERIALS + ROLLING.replace("twisting 0.02", "") + f"law rolling {rolling}\n",
                              precisions=("double",))
            self.assertIn(f"rolling {rolling} 0.1", words[("1", "2")])
        words = self.both(MATERIALS + ROLLING + "law rolling none twisting none\n", precisions=("double",))
        self.assertNotIn("sds", "".join(words.values()))

    def test_walls(self):
        for walls in (PLANE, REGION):
            words = self.both(MATERIALS + PAIRS, walls)
            self.assertEqual(words[("soft", "wall")].split()[2], "0.5")
            self.assertEqual(words[("hard", "wall")].split()[2], "0.4")
        rolling = self.both(MATERIALS + ROLLING.replace("friction 0.2", "friction 0.2 rolling 0.05") +
                            "law radius 0.45 speed 3.0\n", walls=PLANE, precisions=("double",))
        self.assertIn("rolling sds", rolling[("soft", "wall")])

    def test_unset_types(self):
        """NULL leaves a type to other commands."""
        cloud = ("cloud.data", scenes.cloud(cells=(5, 5, 5)))
        law = "hertz/material 4.0e5 0.7 0.2 damping coeff_restitution tangential mindlin NULL 0.9 0.5"
        run = self.run_lammps(scenes.scene(pair="granular", coeff=("* * m.gran soft NULL", f"2 2 {law}"), steps=20),
                              [cloud, ("m.gran", MATERIALS + PAIRS)], gpudem="double")
        self.assertResident(run)
        self.assertEqual(list(words_of_log(run.log)), [("1", "1")])
        run = self.run_lammps(scenes.scene(pair="granular", coeff=("* * m.gran soft NULL",), steps=20),
                              [cloud, ("m.gran", MATERIALS + PAIRS)], gpudem="double", succeed=False)
        self.assertIn("All pair coeffs are not set", run.everything)

    def test_two_ranks(self):
        """One rank reads the file, all know it."""
        files = [("cloud.data", scenes.cloud()), ("m.gran", MATERIALS + PAIRS)]
        text = scenes.scene(pair="granular", coeff=COEFF, steps=50, skin=0.4,
                            neighbor="delay 100000 every 100000 check no")
        one, two = (self.run_lammps(text, files, gpudem="double", ranks=r) for r in (1, 2))
        compare_dumps(self, one.dump(), two.dump(), DOUBLE, scenes.DIAMETER)


class Messages(StylesTest):
    """The message names file, line, word and what is allowed."""
    GOOD = MATERIALS.replace(HEADER, "") + PAIRS   # materials in lines 3 to 5, pairs in 7 to 11
    CASES = (
        # (what replaces what in the good file, phrases)
        ("material soft", "materiel soft", ("line 3", "'materiel'", "material, pair, law")),
        ("young 2.0e5", "jung 2.0e5", ("line 3", "'jung'", "young, poisson, [density]")),
        ("young 2.0e5", "", ("line 3", "'young' is missing", "'material' takes young, poisson, [density]")),
        ("young 2.0e5", "young 2.0e5 young 1", ("line 3", "'young' is given twice")),
        ("young 2.0e5", "young big", ("line 3", "'big'", "'young'")),
        ("young 2.0e5", "young -2.0e5", ("line 3", "young = -200000", "must be positive")),
        ("young 2.0e5", "young 1e999", ("line 3", "young = inf", "must be finite")),
        ("poisson 0.3", "poisson 0.6", ("line 3", "poisson = 0.6", "above -1 and at most 0.5")),
        ("density 2.0   #", "density 0 #", ("line 3", "density = 0", "must be positive")),
        ("density 2.0   #", "density #", ("line 3", "the number of 'density' is missing")),
        ("material hard", "material soft", ("line 4", "'soft' is given twice", "first in line 3")),
        ("material wall", "material NULL", ("line 5", "NULL")),
        ("material wall young 1.0e6 poisson 0.25", "material", ("line 5", "name of the material is missing")),
        ("pair soft soft", "pair soft", ("line 7", "'restitution'", "hard, soft, wall")),
        ("pair soft soft restitution 0.8 friction 0.4", "pair soft", ("line 7", "names of two materials are missing")),
        ("pair hard soft", "pair hrad soft", ("line 8", "unknown material 'hrad'", "hard, soft, wall")),
        ("pair hard hard", "pair soft hard", ("line 9", "'soft hard' is given twice", "first in line 8")),
        ("restitution 0.8", "restitution 0", ("line 7", "restitution = 0", "above 0 and at most 1")),
        ("restitution 0.8", "restitution 1.2", ("line 7", "restitution = 1.2", "above 0 and at most 1")),
        ("restitution 0.8", "", ("line 7", "'restitution' is missing",
                                 "restitution, friction, [rolling], [twisting], [surface_energy]")),
        ("friction 0.4", "friction -0.4", ("line 7", "friction = -0.4", "between 0 and 10000")),
        ("friction 0.4", "mu 0.4", ("line 7", "'mu'", "restitution, friction, [rolling], [twisting], [surface_energy]")),
        ("friction 0.4", "friction 0.4 rolling -1", ("line 7", "rolling = -1", "between 0 and 10000")),
        ("friction 0.4", "friction 0.4 twisting -1", ("line 7", "twisting = -1", "must not be negative")),
        ("friction 0.4", "friction 0.4 surface_energy -1", ("line 7", "surface_energy = -1", "must not be negative")),
        ("friction 0.4", "friction 0.4 rolling 0.1", ("line 7", "law radius R speed V")),
        ("friction 0.2", "friction 0.2 rolling 0.1\nlaw radius 0.5 speed 0", ("line 11", "speed = 0", "must be positive")),
        ("pair wall hard", "law hooke\npair wall hard", ("line 11", "'hooke'", "hertz/material, dmt, jkr", "radius")),
        ("pair wall hard", "law tangential mindlim\npair wall hard",
         ("line 11", "'mindlim'", "mindlin, mindlin_rescale, mindlin/force, mindlin_rescale/force")),
        ("pair wall hard", "law rolling epds\npair wall hard", ("line 11", "'epds'", "sds, epsd2, epsd, cdt, none")),
        ("pair wall hard", "law twisting\npair wall hard", ("line 11", "twisting sub-model is missing")),
        ("pair wall hard", "law dmt\nlaw jkr\npair wall hard", ("line 12", "second law", "line 11")),
        ("pair wall hard", "law tangential_damping -1\npair wall hard", ("line 11", "tangential_damping = -1")),
        ("friction 0.4", "friction 0.4 surface_energy 1\nlaw hertz/material", ("line 7", "surface_energy", "jkr or dmt")),
        ("friction 0.4", "friction 0.4 twisting 1\nlaw twisting marshall", ("line 7", "marshall takes none")),
        ("pair hard soft restitution 0.6 friction 0.3", "",
         ("soft (line 3)", "hard (line 4)", "'pair soft hard restitution E friction MU'")),
    )

    def fails(self, content, *phrases, coeff=COEFF, fixes="fix move all nve/sphere\n", command="Pair_coeff: material file m.gran"):
        files = [("cloud.data", scenes.cloud(cells=(3, 3, 3)))] + ([("m.gran", content)] if content is not None else [])
        run = self.run_lammps(scenes.scene(fixes, pair="granular", coeff=coeff, steps=0), files, gpudem="double",
                              succeed=False, timeout=60)
        self.assertNotEqual(run.status, 0, run.screen[-1000:])
        for phrase in (f"ERROR: {command}", *phrases):
            self.assertIn(phrase, run.everything)

    def test_content(self):
        for old, new, phrases in self.CASES:
            with self.subTest(line=new or old):
                self.assertIn(old, self.GOOD)
                self.fails(HEADER + self.GOOD.replace(old, new, 1), *phrases)

    def test_header(self):
        si = HEADER.replace("lj", "si")
        self.fails(si + self.GOOD, "line 1", "'si' units", "units 'lj'")
        for first in ("\n", "# no date\n", "# DATE: 2026-11-23\n", "# UNITS: lj\n", HEADER[2:], "# DATE: 2026-11-23 UNITS:\n"):
            with self.subTest(first=first):
                self.fails(first + self.GOOD, "line 1", "# DATE: yyyy-mm-dd UNITS: si")
        self.fails("", "is empty or cannot be read")
        self.fails(HEADER, "has no line 'material NAME ...'")

    def test_commands(self):
        good = HEADER + self.GOOD
        pair = "Pair_coeff: "
        self.fails(None, "was not found", "LAMMPS_POTENTIALS")
        self.fails(good, "pair_coeff * * m.gran ...", "not 1 *", coeff=("1 * m.gran soft hard",), command=pair)
        self.fails(good, "each of the 2 atom types, not 1 words", coeff=("* * m.gran soft",), command=pair)
        self.fails(good, "each of the 2 atom types, not 3 words", coeff=("* * m.gran soft hard hard",), command=pair)
        self.fails(good, "no type has a material of m.gran", coeff=("* * m.gran NULL NULL",), command=pair)
        self.fails(good, "has no material 'glas'; it has hard, soft, wall", coeff=("* * m.gran soft glas",))
        self.fails(good, "'m.txt'", "*.gran", coeff=("* * m.txt soft hard",), command=pair)

    def test_walls(self):
        def wall(words):
            return f"fix move all nve/sphere\nfix w all wall/gran granular {words}\n"
        good, where = HEADER + self.GOOD, "Fix wall/gran: "
        self.fails(good, "materials of the grains and of the wall are missing", fixes=wall("m.gran soft"), command=where)
        self.fails(good, "has no material 'zplane'", fixes=wall("m.gran soft zplane 0 NULL"), command=where)
        self.fails(good, "has no material 'iron'", fixes=wall("m.gran soft iron zplane 0 NULL"), command=where)
        self.fails(good.replace("pair soft wall restitution 0.5 friction 0.2", ""), "soft (line 3) and wall (line 5)",
                   "'pair soft wall restitution", fixes=wall("m.gran soft wall zplane 0 NULL"), command=where)


class Density(StylesTest):
    def test_warning(self):
        """Once per type, over all runs; not for one per cent, and not without a density."""
        cloud = ("cloud.data", scenes.cloud(cells=(4, 4, 4)))
        def run(factor, materials=MATERIALS):
            text = scenes.scene(pair="granular", coeff=COEFF, before=f"set type 1 density 2.0\nset type 2 density {2.0 * factor}\n",
                                after="run 5\nrun 5\n")
            return self.run_lammps(text, [cloud, ("m.gran", materials + PAIRS)], gpudem="double").log
        self.assertNotIn("their material", run(1.009))
        for factor in (1.011, 0.5):
            log = run(factor)
            self.assertEqual(log.count("WARNING: Grains of type 2 have a density of"), 1)
            self.assertIn("their material hard has 2", log)
            self.assertNotIn("Grains of type 1", log)
        self.assertNotIn("their material", run(3.0, MATERIALS.replace("hard density 2.0", "hard")))


class Search(StylesTest):
    def test_folders(self):
        cloud = ("cloud.data", scenes.cloud(cells=(3, 3, 3)))
        (self.root / "a").mkdir()
        (self.root / "b").mkdir()
        here = MATERIALS.replace("2.0e5", "1.0e5")
        (self.root / "a" / "m.gran").write_text(MATERIALS.replace("2.0e5", "3.0e5") + PAIRS)
        (self.root / "b" / "m.gran").write_text(MATERIALS.replace("2.0e5", "5.0e5") + PAIRS)
        a, b = ({k: f"{self.root}/none:{self.root}/{f}"} for k, f in (("LAMMPS_POTENTIALS", "a"), ("GPUDEM_POTENTIALS", "b")))
        text = scenes.scene(pair="granular", coeff=COEFF, steps=0)
        for environment, content, young in (({}, here, "100000"), ({**a, **b}, here, "100000"), ({**a, **b}, None, "300000"),
                                            (b, None, "500000")):
            files = [cloud] + ([("m.gran", content + PAIRS)] if content else [])
            run = self.run_lammps(text, files, gpudem="double", environment={"LAMMPS_POTENTIALS": "", **environment})
            self.assertEqual(words_of_log(run.log)[("1", "1")].split()[1], young)
        path = self.root / "b" / "m.gran"
        run = self.run_lammps(scenes.scene(pair="granular", coeff=(f"* * {path} soft hard",), steps=0), [cloud], gpudem="double")
        self.assertEqual(words_of_log(run.log)[("1", "1")].split()[1], "500000")


class Restart(StylesTest):
    def test_without_the_file(self):
        """A restart file has the law: the run goes on without the material file, as one that began with numbers does."""
        content = MATERIALS + ROLLING + "law radius 0.45 speed 3.0\n"
        cloud = ("cloud.data", scenes.cloud(cells=(5, 5, 5)))
        end = "run 100\nwrite_restart half\nrun 100\n"
        first = self.run_lammps(scenes.scene(pair="granular", coeff=COEFF, after=end), [cloud, ("m.gran", content)],
                                gpudem="double")
        words = words_of_log(first.log)
        numbers = self.run_lammps(scenes.scene(pair="granular", coeff=tuple(f"{i} {j} {w}" for (i, j), w in words.items()),
                                               after=end), [cloud], gpudem="double")
        text = (scenes.head(read="read_restart half") + "neighbor 0.05 bin\ntimestep 1.0e-4\nfix move all nve/sphere\n" +
                scenes.output(50) + "run 100\n")
        second, other = (self.run_lammps(text, [run.path("half")], gpudem="double") for run in (first, numbers))
        self.assertNotIn("material file", second.log)
        self.assertEqual(second.path("dump.out").read_bytes(), other.path("dump.out").read_bytes())
        whole, rest = first.dump(), second.dump()
        compare_dumps(self, {s: whole[s] for s in whole if s > 100}, {s: rest[s] for s in rest if s > 100}, DOUBLE_LONG,
                      scenes.DIAMETER)


class Shipped(StylesTest):
    """The files in potentials/, found without being named by path."""

    def collide(self, file, grains, wall=None, radius=0.01, speed=1.0, angle=0.0, steps=None, per_collision=2000):
        """A grain meets another at rest, or a wall at x = 0, at *angle* from the normal. Rows of id, x, v, w, f."""
        material, _ = self.read(file)
        one, two = material[grains[0]], material[wall or grains[1]]
        e_star = 1.0 / sum((1 - m["poisson"] ** 2) / m["young"] for m in (one, two))
        volume = 4.0 / 3.0 * math.pi * radius ** 3
        masses = [volume * one["density"]] + ([] if wall else [volume * two["density"]])
        mass, effective = (masses[0], radius) if wall else (masses[0] * masses[1] / sum(masses), 0.5 * radius)
        approach = speed * math.cos(angle)
        dt = 2.868265 * (mass ** 2 / (effective * e_star ** 2 * approach)) ** 0.2 / per_collision
        steps = steps or int(1.4 * per_collision)
        size = 5.0 * radius
        types = f"{grains[0]} {grains[0] if wall else grains[1]}"
        text = ("units si\natom_style sphere\nboundary f f f\nnewton off\ncomm_modify vel yes\n"
                f"region box block {-size} {size} {-size} {size} {-size} {size} units box\ncreate_box 2 box\n"
                f"create_atoms 1 single {radius + 0.5 * dt * approach:.17g} 0 0 units box\n"
                f"set atom 1 diameter {2 * radius} density {one['density']}\n"
                f"set atom 1 vx {-approach:.17g} vy {speed * math.sin(angle):.17g}\n")
        if not wall:
            text += (f"create_atoms 2 single {-radius} 0 0 units box\n"
                     f"set atom 2 diameter {2 * radius} density {two['density']}\n")
        text += "pair_style granular\n"
        if wall:   # the file may have nothing on grains of one kind: nothing here meets another
            text += "pair_coeff * * hooke 1 0 tangential linear_nohistory 0 0\n"
            text += f"fix w all wall/gran granular {file} {grains[0]} {wall} xplane 0 NULL\n"
        else:
            text += f"pair_coeff * * {file} {types}\n"
        text += (f"neighbor {0.1 * radius} bin\ntimestep {dt:.17g}\nfix move all nve/sphere\n"
                 f"dump out all custom 1 dump.out id x y z vx vy vz omegax omegay omegaz fx fy fz\n"
                 f"dump_modify out sort id format float %.17g\nrun {steps}\n")
        run = self.run_lammps(text, gpudem="double", environment={"LAMMPS_POTENTIALS": ""})
        self.assertResident(run)
        self.assertNotIn("their material", run.log)
        return np.array([table for _, (_, table) in sorted(run.dump().items())]), run

    @staticmethod
    def read(file):
        """Materials and pairs of a file, read once more."""
        material, pairs = {}, {}
        for line in (SHIPPED / file).read_text().split("\n"):
            words = line.split("#")[0].split()
            if words[:1] == ["material"]:
                material[words[1]] = dict(zip(words[2::2], map(float, words[3::2])))
            elif words[:1] == ["pair"]:
                pairs[tuple(words[1:3])] = dict(zip(words[3::2], map(float, words[4::2])))
        return material, pairs

    def test_every_pair_collides(self):
        """Every file parses, and a head-on impact of every pair returns the restitution of its line."""
        files = sorted(f.name for f in SHIPPED.glob("*.gran"))
        self.assertGreaterEqual(len(files), 3)
        for file in files:
            material, pairs = self.read(file)
            self.assertTrue(pairs, file)
            for (a, b), values in pairs.items():
                like = (b, b) in pairs and (a, a) in pairs
                with self.subTest(file=file, pair=(a, b)):
                    wall = None if like or a == b else b
                    rows, _ = self.collide(file, (a, b), wall=wall)
                    before, after = (rows[k, 0, 4] - (0.0 if wall else rows[k, 1, 4]) for k in (0, -1))
                    self.assertAlmostEqual(-after / before, values["restitution"], delta=CHUNG_OOI.rebound.relative * 2)

    def test_header_and_citation(self):
        for file in SHIPPED.glob("*.gran"):
            first = file.read_text().split("\n")[0]
            for word in ("# DATE: ", " UNITS: si ", " CONTRIBUTOR: ", " CITATION: "):
                self.assertIn(word, first, file.name)
            self.assertIn(file.name, (SHIPPED / "README.md").read_text())
            file.read_text(encoding="ascii")

    def test_chung_ooi(self):
        """Test 1: largest force of two glass spheres at 20 m/s, 10697 N. Test 4: tangential restitution at 40 degrees."""
        rows, _ = self.collide("chung_ooi_2011.gran", ("glass", "glass"), speed=20.0)
        self.assertAlmostEqual(np.abs(rows[:, 0, 10]).max() / 10697.0, 1.0, delta=CHUNG_OOI.peak.relative)
        rows, _ = self.collide("chung_ooi_2011.gran", ("aluminium_oxide",), wall="plane_4", radius=0.0025, speed=3.9,
                               angle=math.radians(40.0))
        self.assertAlmostEqual(rows[-1, 0, 5] / rows[0, 0, 5] / 0.78291, 1.0, delta=CHUNG_OOI.sliding.relative)

    def test_missing_pair(self):
        """What the literature does not have, the file does not have: the message says what to add."""
        text = ("units si\natom_style sphere\nregion box block 0 1 0 1 0 1 units box\ncreate_box 2 box\n"
                "pair_style granular\npair_coeff * * common.gran glass steel\n")
        run = self.run_lammps(text, gpudem="double", succeed=False, environment={"LAMMPS_POTENTIALS": ""})
        self.assertNotEqual(run.status, 0)
        self.assertIn("'pair glass steel restitution E friction MU'", run.everything)


if __name__ == "__main__":
    unittest.main(verbosity=2)
