# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""One description of a scene, written as input of LIGGGHTS and of GPUDEM. SI units.

Both read the same file of grains; walls are planes and cylinders along an axis. What the programs understand differently is
stated by the law (Law.gpudem, Law.properties), nowhere else.
"""
import math
from dataclasses import dataclass, field, replace

import numpy as np

COLUMNS = "id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz"
FIELDS = {"position": slice(0, 3), "velocity": slice(3, 6), "spin": slice(6, 9), "force": slice(9, 12), "torque": slice(12, 15)}
AXES = "xyz"


@dataclass(frozen=True)
class Law:
    """Contact law of grains and walls (one material).

    normal: hertz (young, nu, restitution), hooke (the same and the characteristic speed of LIGGGHTS) or hooke/stiffness (kn, kt,
    gamman, gammat: 1/time, times the effective mass)."""
    normal: str = "hertz"
    young: float = 1.0e7
    nu: float = 0.3
    restitution: float = 0.5
    friction: float = 0.0
    tangential_damping: bool = True
    characteristic: float = 1.0
    kn: float = 1.0e4
    kt: float = 5.0e3
    gamman: float = 200.0
    gammat: float = 100.0
    rolling: str = ""            # cdt, epsd, epsd2, epsd3
    rolling_friction: float = 0.0
    rolling_viscosity: float = 0.0
    rolling_stiffness: float = 2.25   # epsd3: k_r over kn (mu R*)^2
    cohesion: str = ""           # sjkr, sjkr2
    energy_density: float = 0.0
    net: bool = False            # friction counts from the force that cohesion leaves (LIGGGHTS: tangential_reduce on)

    def hooke_stiffness(self, radius, mass):
        """kn of LIGGGHTS' hooke: the linear spring that stores as much at the characteristic speed (effective radius and mass)."""
        effective = self.young / (2.0 * (1.0 - self.nu ** 2))
        root = math.sqrt(radius)
        return 16.0 / 15.0 * root * effective * (15.0 * mass * self.characteristic ** 2 / (16.0 * root * effective)) ** 0.2

    def gpudem(self, radius, mass):
        """Words of pair_coeff and of a wall; effective radius and mass are for LIGGGHTS' hooke, which depends on them."""
        if self.normal == "hertz":
            words = f"hertz/material {self.young} {self.restitution} {self.nu} damping coeff_restitution"
            dashpot = "NULL" if self.tangential_damping else "0.0"
            words += f" tangential liggghts_history NULL {dashpot} {self.friction}"
        elif self.normal == "hooke":
            kn = self.hooke_stiffness(radius, mass)
            words = (f"hooke {kn:.17g} {self.restitution} damping coeff_restitution "
                     f"tangential liggghts_linear_history {kn:.17g} {1.0 * self.tangential_damping} {self.friction}")
        else:
            dashpot = self.gammat / self.gamman if self.gamman and self.tangential_damping else 0.0
            words = (f"hooke {self.kn:.17g} {self.gamman:.17g} damping mass_velocity "
                     f"tangential liggghts_linear_history {self.kt:.17g} {dashpot:.17g} {self.friction}")
        if self.rolling:
            words += f" rolling {self.rolling} {self.rolling_friction}"
            words += f" {self.rolling_viscosity:.17g}" if self.rolling in ("epsd", "epsd3") else ""
            words += f" {self.rolling_stiffness:.17g}" if self.rolling == "epsd3" else ""
        if self.cohesion:
            words += f" cohesion {self.cohesion} {self.energy_density} coulomb {'net' if self.net else 'contact'}"
        return words + " arm contact_point"

    def words(self):
        """Words of LIGGGHTS behind 'model'."""
        words = f"{self.normal} tangential history"
        words += f" cohesion {self.cohesion}" if self.cohesion else ""
        words += f" rolling_friction {self.rolling}" if self.rolling else ""
        words += " tangential_reduce on" if self.net else ""
        return words + ("" if self.tangential_damping else " tangential_damping off")

    def properties(self):
        """Lines of LIGGGHTS that give the material."""
        pair = {"coefficientRestitution": self.restitution, "coefficientFriction": self.friction,
                "coefficientRollingFriction": self.rolling_friction, "coefficientRollingViscousDamping": self.rolling_viscosity,
                "cohesionEnergyDensity": self.energy_density,
                "kn": self.kn, "kt": self.kt, "gamman": self.gamman, "gammat": self.gammat}
        lines = [f"fix p{k} all property/global {name} peratomtypepair 1 {value:.17g}" for k, (name, value) in enumerate(pair.items())]
        return "\n".join(lines + [f"fix q1 all property/global youngsModulus peratomtype {self.young}",
                                  f"fix q2 all property/global poissonsRatio peratomtype {self.nu}",
                                  f"fix q3 all property/global characteristicVelocity scalar {self.characteristic}",
                                  f"fix q4 all property/global rollingStiffness scalar {self.rolling_stiffness:.17g}"])


@dataclass(frozen=True)
class Plane:
    axis: str
    at: float
    below: bool = True           # grains lie above it
    shear: tuple = ()            # (axis, speed): velocity of its surface


    def gpudem(self, number, law):
        sides = f"{self.at:.17g} NULL" if self.below else f"NULL {self.at:.17g}"
        shear = " shear {} {:.17g}".format(*self.shear) if self.shear else ""
        return f"fix w{number} all wall/gran granular {law} {self.axis}plane {sides}{shear}\n"

    def liggghts(self, number, law):
        shear = " shear {} {:.17g}".format(*self.shear) if self.shear else ""
        return f"fix w{number} all wall/gran model {law} primitive type 1 {self.axis}plane {self.at:.17g}{shear}\n"

    def files(self, number):
        return ()


@dataclass(frozen=True)
class Drum:
    """The inside of a cylinder about the x axis, open at both ends, that turns.

    LIGGGHTS leaves its curvature out of R*. Its 'shear' is an angular velocity, is right about x and z, not about y, and gives the
    surface the velocity at the centre of the grain: it turns faster here, so that grains of the given radius meet the same surface."""
    radius: float
    half: float                  # of its length
    speed: float                 # rad/s about +x
    grain: float                 # radius of the grains

    def gpudem(self, number, law):
        return (f"variable turn{number} equal {self.speed:.17g}*dt*step\n"
                f"region drum{number} cylinder x 0 0 {self.radius:.17g} {-self.half:.17g} {self.half:.17g} open 1 open 2 units box "
                f"rotate v_turn{number} 0 0 0 1 0 0\nfix w{number} all wall/gran/region granular {law} region drum{number}\n")

    def liggghts(self, number, law):
        return (f"fix w{number} all wall/gran model {law} primitive type 1 xcylinder {self.radius:.17g} 0.0 0.0 "
                f"shear y {self.speed * self.radius / (self.radius - self.grain):.17g}\n")

    def files(self, number):
        return ()


@dataclass(frozen=True)
class Surface:
    """Triangles, at rest or moving at a constant velocity; both programs read the same STL file."""
    triangles: tuple             # ((corner, corner, corner), ...)
    velocity: tuple = ()

    def gpudem(self, number, law):
        move = " move linear {:.17g} {:.17g} {:.17g}".format(*self.velocity) if self.velocity else ""
        return f"fix w{number} all wall/gran/sdf granular {law} surface s{number}.stl{move}\n"

    def liggghts(self, number, law):
        move = "fix m{} all move/mesh mesh s{} linear {:.17g} {:.17g} {:.17g}\n".format(number, number, *self.velocity) if self.velocity else ""
        return (f"fix s{number} all mesh/surface file s{number}.stl type 1\n{move}"
                f"fix w{number} all wall/gran model {law} mesh n_meshes 1 meshes s{number}\n")

    def files(self, number):
        lines = ["solid s"]
        for corners in self.triangles:
            lines += ["facet normal 0 0 0", "outer loop", *("vertex {:.9g} {:.9g} {:.9g}".format(*c) for c in corners), "endloop", "endfacet"]
        return ((f"s{number}.stl", "\n".join([*lines, "endsolid s"]) + "\n"),)


@dataclass
class Scene:
    name: str
    law: Law
    x: np.ndarray                # [n, 3] m
    radius: np.ndarray           # [n] m
    dt: float                    # s
    steps: int
    v: np.ndarray = None         # [n, 3] m/s
    w: np.ndarray = None         # [n, 3] rad/s
    density: float = 2500.0      # kg/m^3
    walls: tuple = ()
    gravity: float = 0.0         # m/s^2, along -z
    every: int = 1               # steps between dumps
    box: tuple = None            # (lo, hi)
    boundary: str = "f f f"
    skin: float = None
    then: tuple = ()             # ((walls, steps), ...): further runs, with these walls
    planar: bool = False         # motion in x and y only
    gpudem_law: Law = None       # where GPUDEM is given other numbers, on purpose
    mass: np.ndarray = field(init=False)

    def __post_init__(self):
        self.x, self.radius = np.array(self.x, float), np.array(self.radius, float)
        self.v = np.zeros_like(self.x) if self.v is None else np.array(self.v, float)
        self.w = np.zeros_like(self.x) if self.w is None else np.array(self.w, float)
        self.mass = 4.0 / 3.0 * np.pi * self.radius ** 3 * self.density
        if self.box is None:
            margin = 4.0 * self.radius.max() + np.abs(self.v).max() * self.dt * self.steps
            self.box = (self.x.min(0) - margin, self.x.max(0) + margin)
        if self.skin is None:
            self.skin = 0.2 * self.radius.max()

    def data(self, discs=False):
        """Grains of both programs, all digits. discs: in two dimensions LIGGGHTS takes the density per area."""
        rows = [f"{self.name}\n\n{len(self.x)} atoms\n1 atom types\n"]
        rows += [f"{a:.17g} {b:.17g} {axis}lo {axis}hi" for axis, a, b in zip(AXES, *self.box)]
        rows += ["\nAtoms\n"] + [f"{k} 1 {2.0 * r:.17g} {self.density * (4.0 / 3.0 * r if discs else 1.0):.17g} " + " ".join(f"{c:.17g}" for c in x)
                                 for k, (r, x) in enumerate(zip(self.radius, self.x), 1)]
        rows += ["\nVelocities\n"] + [f"{k} " + " ".join(f"{c:.17g}" for c in (*v, *w))
                                      for k, (v, w) in enumerate(zip(self.v, self.w), 1)]
        return "\n".join(rows) + "\n"

    def effective(self, wall):
        """Effective radius and mass of a contact of the first grain."""
        r, m = self.radius, self.mass
        return (r[0], m[0]) if wall or len(r) == 1 else (r[0] * r[1] / (r[0] + r[1]), m[0] * m[1] / (m[0] + m[1]))

    def gpudem(self):
        law = self.gpudem_law or self.law
        text = (f"units si\natom_style sphere\n{'dimension 2' if self.planar else ''}\nboundary {self.boundary}\nnewton off\n"
                f"comm_modify vel yes\nread_data data.scene\npair_style granular\npair_coeff * * {law.gpudem(*self.effective(False))}\n"
                f"neighbor {self.skin:.17g} bin\nneigh_modify delay 0 every 1\ntimestep {self.dt:.17g}\n"
                f"fix move all nve/sphere {'disc' if self.planar else ''}\n")
        text += f"fix weight all gravity {self.gravity} vector 0 0 -1\n" if self.gravity else ""
        text += "fix flat all enforce2d\n" if self.planar else ""
        return text + self.runs("format float %.17g", "gpudem", law.gpudem(*self.effective(True)))

    def liggghts(self):
        # only plain 'soft' and 'hard' particles pass its check of E; forces are those of the given E either way
        text = (f"units si\natom_style granular\natom_modify map array\n{'dimension 2' if self.planar else ''}\n"
                f"boundary {self.boundary}\nnewton off\ncommunicate single vel yes\nread_data data.scene\n"
                f"neighbor {self.skin:.17g} bin\nneigh_modify delay 0 every 1\n{'hard' if self.law.young > 1.0e9 else 'soft'}_particles yes\n"
                f"{self.law.properties()}\npair_style gran model {self.law.words()}\npair_coeff * *\ntimestep {self.dt:.17g}\n"
                "fix move all nve/sphere\n")
        text += f"fix weight all gravity {self.gravity} vector 0 0 -1\n" if self.gravity else ""
        text += "fix flat all enforce2d\n" if self.planar else ""
        numbers = " ".join(["%d"] + ["%.17g"] * (len(COLUMNS.split()) - 1))
        return text + self.runs(f'format "{numbers}"', "liggghts", self.law.words())

    def all_walls(self):
        return list(dict.fromkeys(w for walls in (self.walls, *(w for w, _ in self.then)) for w in walls))

    def files(self):
        return [f for k, wall in enumerate(self.all_walls()) for f in wall.files(k)]

    def runs(self, digits, program, law):
        """Walls, dump and runs."""
        text = (f"dump out all custom {self.every} dump.out {COLUMNS}\ndump_modify out sort id {digits}\n"
                f"thermo {max(1, self.steps)}\nthermo_modify lost ignore\n")
        known, present = self.all_walls(), ()
        for walls, steps in ((self.walls, self.steps), *self.then):
            text += "".join(f"unfix w{known.index(w)}\n" for w in present if w not in walls)
            text += "".join(getattr(w, program)(known.index(w), law) for w in walls if w not in present)
            text, present = text + f"run {steps}\n", walls
        return text

    def changed(self, **fields):
        """The same grains with other settings."""
        fields = {"law": replace(self.law, **fields.pop("law_changes", {})), **fields}
        return replace(self, **fields)
