# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Pairs of scripts for features.py: a feature absent and present, or absent and switched on with nothing to do.

A script is an input of this folder with some of its lines changed. An edit is (line, what takes its place); the line must
stand in the script exactly once.
"""
from dataclasses import dataclass

# lines of in.chute
CHUTE_PAIR = "pair_style      gran/hooke/history 200000.0 NULL 50.0 NULL 0.5 0"
CHUTE_FIX = "fix             3 active nve/sphere"
WALL = "hooke/history 200000.0 NULL 50.0 NULL 0.5 0"
# lines of in.bed
BED_BOUNDARY = "boundary        p p f"
BED_READ = "read_data       ${data}"
BED_COPY = "replicate       $x $y 1"
BED_PAIR = "pair_coeff      * * ${law}"
BED_MOVE = "fix             1 all nve/sphere"
BED_GRAVITY = "fix             2 all gravity 1.0 vector 0 0 -1"
BED_WALL = "fix             3 all wall/gran granular ${law} zplane 0 NULL"
THERMO = "thermo_style    custom step atoms ke press"
THERMO_EVERY = "thermo          100"

NORMAL = "hertz/material 1.0e6 0.3 0.3 damping tsuji"
MINDLIN = f"{NORMAL} tangential mindlin NULL 1.0 0.5"


@dataclass
class Pair:
    feature: str
    scene: str             # chute or one of the beds of features.py
    absent: tuple = ()     # edits of the script without the feature
    present: tuple = ()    # and with it
    without: str = "none"  # the two sides in words
    with_: str = ""
    other: str = ""        # scene of the script with the feature, where it is another
    alike: bool = False    # same motion of the grains, so same kinetic energy


def add(line, *more):
    """An edit that puts lines behind a line."""
    return (line, "\n".join((line, *more)))


def gran(words):
    return ((CHUTE_PAIR, f"pair_style {words}"),)


def law(words):
    return (("variable        law index", f'variable law string "{words}"\n#'),)


def frozen(shape, *before):
    """Edits that freeze the grains of the bed outside a region: a wall there changes nothing that moves."""
    return (add(BED_COPY, *before, f"region loose {shape}", "group loose region loose",
                "group held subtract all loose", "velocity held set 0 0 0", "set group held omega 0 0 0"),
            (BED_MOVE, "fix 1 loose nve/sphere"))


def walled(pair_of, *walls):
    """The same scene without and with walls. Frozen grains touch them, so the wall is evaluated where it would be."""
    return {"absent": (*pair_of, (BED_WALL, "fix 9 held freeze")),
            "present": (*pair_of, (BED_WALL, "\n".join((*walls, "fix 9 held freeze")))), "alike": True}


RIM = 1.6  # width of the frozen rim (diameters)
CLOSED = (BED_BOUNDARY, "boundary f f f")
FLOOR = frozen(f"block INF INF INF INF {RIM} INF units box")
SIDES = (CLOSED, *frozen(f"block $(xlo+{RIM}) $(xhi-{RIM}) $(ylo+{RIM}) $(yhi-{RIM}) {RIM} INF units box"))
# zcylinder stands around the z axis: the bed is moved there and cut round
ROUND = (CLOSED, *frozen(f"cylinder z 0 0 $(v_half-{RIM}) {RIM} INF units box", "variable half equal $(0.5*xhi)",
                         "change_box all x final $(-xhi) $(xhi) y final $(-yhi) $(yhi) units box",
                         "displace_atoms all move $(-v_half) $(-v_half) 0 units box",
                         "region beyond cylinder z 0 0 ${half} INF INF side out units box", "delete_atoms region beyond"))
HALVES = add(BED_COPY, "region low block INF INF INF INF INF 12 units box", "group low region low",
             "group high subtract all low")
NOBODY = "group nobody empty"


def dump(fields, every=100):
    return (add(THERMO_EVERY, f"dump 1 all custom {every} grains.bin {fields}"),)


def plane(number, axis, lo, hi):
    return f"fix {number} all wall/gran granular ${{law}} {axis}plane {lo} {hi}"


FEATURES = [
    Pair("friction and rotation", "chute", gran("gran/hooke 200000.0 NULL 50.0 0.0 0.0 0"),
         gran("gran/hooke 200000.0 NULL 50.0 NULL 0.5 0"), "no friction, no torques", "viscous friction"),
    Pair("history", "chute", gran("gran/hooke 200000.0 NULL 50.0 NULL 0.5 0"), (), "viscous friction", "springs"),
    Pair("friction and rotation", "bed", law(f"{NORMAL} tangential none"),
         law(f"{NORMAL} tangential linear_nohistory 1.0 0.5"), "tangential none", "linear_nohistory"),
    Pair("history", "bed", law(f"{NORMAL} tangential linear_nohistory 1.0 0.5"), law(MINDLIN), "linear_nohistory", "mindlin"),
    Pair("rolling resistance", "bed", (), law(f"{MINDLIN} rolling sds 1.0e4 10.0 0.1"), "mindlin", "and rolling sds"),
    Pair("polydispersity", "bed, one size", (), (), "one size", "radii from 1 to 1.5", other="bed, sizes 1 to 1.5"),
    Pair("several types", "bed", (),
         ((BED_READ, f"{BED_READ} extra/atom/types 2"),
          add(BED_COPY, "set group all type/fraction 2 0.333 4711", "set type 1 type/fraction 3 0.5 4712"),
          add(BED_PAIR, f"pair_coeff * 2 {NORMAL} tangential mindlin NULL 1.0 0.45",
              f"pair_coeff * 3 {NORMAL} tangential mindlin NULL 1.0 0.55")), "one", "three, six laws"),
    Pair("groups", "bed", (), (HALVES, (BED_MOVE, "fix 1 low nve/sphere\nfix 11 high nve/sphere"),
                               (BED_GRAVITY, "fix 2 low gravity 1.0 vector 0 0 -1\nfix 12 high gravity 1.0 vector 0 0 -1")),
         "fixes of all", "fixes of two halves", alike=True),
    Pair("wall: plane", "bed", **walled(FLOOR, plane(3, "z", 0, "NULL")), with_="floor"),
    Pair("wall: planes", "bed", **walled(SIDES, plane(3, "z", 0, "NULL"), plane(4, "x", "$(xlo)", "$(xhi)"),
                                         plane(5, "y", "$(ylo)", "$(yhi)")), with_="floor and four sides"),
    Pair("wall: cylinder", "bed", **walled(ROUND, "fix 3 all wall/gran granular ${law} zcylinder ${half}"), with_="zcylinder"),
    Pair("wall: region", "bed", **walled(ROUND, "region tube cylinder z 0 0 ${half} EDGE EDGE open 1 open 2 units box",
                                         "fix 3 all wall/gran/region granular ${law} region tube"), with_="cylinder"),
    Pair("virial", "bed", ((THERMO, "thermo_style custom step atoms ke"),), (), "no pressure", "pressure every 100 steps",
         alike=True),
    Pair("virial", "bed", ((THERMO, "thermo_style custom step atoms ke"), (THERMO_EVERY, "thermo 10")),
         ((THERMO_EVERY, "thermo 10"),), "no pressure", "pressure every 10 steps", alike=True),
    Pair("output", "bed", (), dump("x y z"), "no dump", "x every 100 steps", alike=True),
    Pair("output", "bed", dump("x y z"),
         dump("x y z vx vy vz omegax omegay omegaz fx fy fz radius"), "x every 100 steps", "x v omega f radius",
         alike=True),
]

FAR = -1000.0  # where no grain comes (diameters)
IDLE = [
    Pair("nothing: the same script twice", "chute"),
    Pair("nothing: the same script twice", "bed"),
    Pair("a plane far away", "chute", (), (add(CHUTE_FIX, f"fix 9 all wall/gran {WALL} zplane {FAR} NULL"),)),
    Pair("four pairs of planes far away", "chute", (),
         (add(CHUTE_FIX, *(f"fix {9 + k} all wall/gran {WALL} zplane {FAR - k} {k - FAR}" for k in range(4))),)),
    Pair("a region far away", "chute", (), (add(CHUTE_FIX, f"region far sphere 0 0 {FAR} 10 side out units box",
                                                f"fix 9 all wall/gran/region {WALL} region far"),)),
    Pair("a surface of triangles far away", "chute", (),
         (add(CHUTE_FIX, f"fix 9 all wall/gran/sdf {WALL} surface box(0,5,0,5,{FAR},{FAR + 5})"),)),
    Pair("friction coefficient 0", "chute", gran("gran/hooke 200000.0 NULL 50.0 0.0 0.0 0"),
         gran("gran/hooke 200000.0 NULL 50.0 NULL 0.0 0"), "no friction", "coefficient 0"),
    Pair("a second type that nobody has", "bed", (), ((BED_READ, f"{BED_READ} extra/atom/types 1"),)),
    Pair("a group that no fix names", "bed", (), (add(BED_COPY, "group some id 1:1000"),)),
    Pair("a fix of a group without members", "bed", (), (add(BED_WALL, NOBODY, "fix 9 nobody viscous 0.5"),)),
    Pair("an exclusion that excludes nobody", "bed", (), (add(BED_WALL, NOBODY, "neigh_modify exclude group nobody all"),)),
    Pair("a compute pressure that nobody reads", "bed", (), (add(BED_WALL, "compute p all pressure thermo_temp"),)),
    Pair("a dump that is never due", "bed", (), dump("x y z", 100000000)),
    Pair("levels by size", "bed, one size", (), (add(THERMO_EVERY, "gpudem neighbor multigrid"),)),
    Pair("rolling sds with coefficients 0", "bed", (), law(f"{MINDLIN} rolling sds 0.0 0.0 0.0"), "none", "coefficients 0"),
]
for _pair in IDLE:
    _pair.alike, _pair.with_ = True, _pair.with_ or "idle"
