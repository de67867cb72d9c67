# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Random inputs from a seed: box, grains, contact law, groups, walls, motions, host styles, changes between runs.

Left out is what LAMMPS 29 Sep 2021 does wrong or in no defined way (lists of doc/pair_granular_gpudem.md and of the
fix pages), as the answer of stock LAMMPS is the reference.
"""
import numpy as np

import scenes


class RandomScript:
    """One input. text and files are what LAMMPS reads; ranks is the number of MPI processes GPUDEM runs on."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)
        self.dimension = 2 if self._maybe(0.2) else 3
        self.flat = self.dimension == 2
        self.cells = (18, 18, 1) if self.flat else tuple(int(c) for c in self.rng.integers(4, 10, 3))
        self.skin = self._pick(0.01, 0.05, 0.2, 0.5)
        self._choose_boundary()
        cloud = scenes.cloud(cells=self.cells, dimension=self.dimension, seed=seed, margin=self.margin,
                             speed=self._pick(0.1, 3.0, 10.0), spin=self._pick(0.1, 5.0), edit=self._edit())
        self.files = [("cloud.data", cloud)]
        self.ranks = int(self._pick(1, 1, 1, 2, 3))
        self.environment = {"GPUDEM_THREADS": str(self._pick(1, 2))}
        self.computes = []
        pair = self._pair()
        body = self._groups() + self._motion() + self._terms() + self._walls() + self._host()
        before = self._exclusions()
        self.text = scenes.scene(fixes=body.rstrip("\n"), boundary=" ".join(self.boundary), dimension=self.dimension,
                                 pair=pair, coeff=self.coeff, skin=self.skin, neighbor=self._neighbor(), before=before,
                                 columns=" ".join(self.computes), after=self._runs(), every=30)

    def _maybe(self, chance):
        return bool(self.rng.random() < chance)

    def _pick(self, *values):
        return values[int(self.rng.integers(len(values)))]

    def _number(self, low, high):
        return f"{self.rng.uniform(low, high):.6g}"

    def _axis(self):
        v = self.rng.normal(size=3)
        if self.flat:
            v[2] = 0.0
        return " ".join(f"{c:.6g}" for c in v)

    def _choose_boundary(self):
        self.boundary, self.margin = [], []
        for d in range(3):
            if self.flat and d == 2:
                self.boundary.append("p")
                self.margin.append(0.0)
                continue
            word = self._pick("p", "p", "f", "s", "m", "fs", "fm")
            self.boundary.append(word)
            self.margin.append(0.0 if word == "p" else self._pick(0.05, 0.6))

    def _edit(self):
        spread = self._pick(1.0, 1.0, 1.5, 4.0)   # of the radii
        mass = self._pick(1.0, 1.0, 100.0)

        def edit(atoms, velocities):
            for a in atoms:
                a[2] /= spread ** self.rng.random()
                a[3] *= mass ** self.rng.random()
        return edit

    def _coefficients(self, style):
        k, g = ((self._number(2e4, 3e5), self._number(0, 800.0)) if "hertz" in style else
                (self._number(5e3, 5e4), self._number(0, 200.0)))
        kt = self._pick("NULL", self._number(1e3, 4e4))
        gt = self._pick("NULL", self._number(0, 50.0))
        return f"{k} {kt} {g} {gt} {self._pick('0.0', '0.5', self._number(0, 2))} {self._pick(0, 1)}"

    def _law(self):
        """Sub-models of pair granular, but rolling and twisting, whose springs stock LAMMPS turns round at rebuilds."""
        normal = self._pick(f"hooke {self._number(5e3, 5e4)} {self._number(0, 80)}",
                            f"hertz {self._number(2e4, 3e5)} {self._number(0, 80)}")
        tangential = self._pick("linear_nohistory {x} {mu}", "linear_history {k} {x} {mu}", "mindlin {k} {x} {mu}",
                                "mindlin_rescale {k} {x} {mu}", "mindlin/force {k} {x} {mu}")
        if normal.startswith("hooke"):
            tangential = self._pick("linear_nohistory {x} {mu}", "linear_history {k} {x} {mu}")
        tangential = tangential.format(k=self._number(1e3, 5e4), x=self._number(0, 1), mu=self._number(0, 1.5))
        damping = self._pick("", "damping velocity", "damping mass_velocity", "damping viscoelastic")
        return f"{normal} {damping} tangential {tangential}" + self._pick("", " limit_damping")

    def _pair(self):
        self.style = self._pick("gran/hooke", "gran/hooke/history", "gran/hooke/history", "gran/hertz/history",
                                "granular", "granular")
        if self.style == "granular":
            self.coeff = (f"* * {self._law()}",)
            return self.style
        self.coeff = ("* *",)
        return f"{self.style} {self._coefficients(self.style)}" + self._pick("", " limit_damping")

    def _wall_law(self):
        if self.style == "granular":
            return f"granular {self._law()}"
        return f"{self.style.replace('gran/', '')} {self._coefficients(self.style)}"

    def _neighbor(self):
        return self._pick("delay 0 every 1 check yes", "delay 0 every 1 check yes", "delay 0 every 1 check no")

    def _exclusions(self):
        return self._pick("", "", "", "neigh_modify exclude type 1 2\n")

    def _groups(self):
        high = int(np.prod(self.cells))
        a, b = sorted(int(i) for i in self.rng.integers(1, high + 1, 2))
        self.groups = ["all", "some", "one"]
        text = f"group some id {a}:{b}\ngroup one type 1\ngroup rest subtract all some\n"
        self.frozen = self._maybe(0.25)
        if self.frozen:
            # at rest: stock LAMMPS damps moving frozen grains by the mass of whichever comes first in its list
            text += "velocity some set 0 0 0\nset group some omega 0 0 0\n"
        return text

    def _motion(self):
        disc = " disc" if self.flat and self._maybe(0.5) else ""
        nve = f"nve/sphere{disc}"
        if self.frozen:
            return f"fix move all {nve}\nfix hold some freeze\n"
        kind = self._pick("all", "all", "all", "rest", "moved")
        if kind == "all":
            return f"fix move all {nve}\n"
        text = f"fix move rest {nve}\n"
        if kind == "moved":
            z = "0" if self.flat else self._number(-1, 1)
            text += "fix carried some move " + self._pick(
                f"linear {self._number(-1, 1)} {self._number(-1, 1)} {z}",
                f"wiggle 0.05 0.02 0 {self._number(0.05, 1)}") + "\n"
        return text

    def _terms(self):
        text = ""
        if self._maybe(0.6):
            text += f"fix down all gravity {self._number(1, 30)} vector {self._axis()}\n"
        if self._maybe(0.3):
            group = self._pick(*self.groups)
            text += f"fix drag {group} viscous {self._number(0, 5)}" + self._pick("", " scale 2 3.0") + "\n"
        if self._maybe(0.15):
            text += f"fix push one setforce {self._pick('NULL', '0.0', '5.0')} NULL {self._pick('NULL', '0.0')}\n"
        return text

    def _walls(self):
        text = ""
        for d, axis in enumerate("xyz"):
            if self.boundary[d] == "p" or not self._maybe(0.8):
                continue
            hi = self.cells[d] * 0.9
            sides = self._pick(f"0.02 {hi - 0.02:.6g}", "0.02 NULL", f"NULL {hi - 0.02:.6g}")
            motion = self._pick("", "", f" wiggle {axis} 0.05 0.2")
            if self._maybe(0.3):
                other = "y" if axis == "x" else "x"
                motion = f" shear {other} {self._number(-3, 3)}"
            text += (f"fix wall{axis} {self._pick('all', 'all', 'one')} wall/gran {self._wall_law()} "
                     f"{axis}plane {sides}{motion}\n")
        if self._maybe(0.25) and not self.flat:
            middle = " ".join(f"{0.45 * c:.6g}" for c in self.cells)
            radius = 0.45 * max(self.cells) * self._pick(1.1, 1.8)
            text += (f"region ball sphere {middle} {radius:.6g} units box\n"
                     f"fix wallr all wall/gran/region {self._wall_law()} region ball\n")
        if self.flat:
            text += "fix flat all enforce2d\n"
        return text

    def _host(self):
        text = ""
        if self._maybe(0.2):
            text += "compute touching all contact/atom\n"
            self.computes.append("c_touching")
        if self._maybe(0.2):
            text += "fix mean all ave/atom 2 5 30 vx fz\n"
            self.computes.append("f_mean[1] f_mean[2]")
        if self._maybe(0.15):
            text += f"fix pull one addforce {self._number(-3, 3)} 0.0 0.0\n"
        return text

    def _change(self):
        z = "0.0" if self.flat else self._number(-0.2, 0.2)
        return self._pick(
            "", "", f"velocity all scale {self._number(1, 20)}\n",
            f"velocity some set {self._number(-2, 2)} NULL NULL\n" if not self.frozen else "",
            f"displace_atoms all move {self._number(-0.2, 0.2)} {self._number(-0.2, 0.2)} {z} units box\n"
            if all(b == "p" for b in self.boundary) else "",
            "delete_atoms group some compress no\n" if self._maybe(0.5) and not self.computes else "",
            f"set group one density {self._number(0.5, 5)}\n",
            f"timestep {self._number(2e-5, 1.5e-4)}\n",
            # stock LAMMPS forgets springs across periodic faces there: it exchanges ghosts before it has kept the springs
            "write_restart middle.restart\n" if "p" not in self.boundary else "", "fix late all viscous 1.0\n", "neigh_modify exclude none\n")

    def _runs(self):
        text, steps, late = "", 0, False
        while steps < 120:
            n = int(self._pick(1, 7, 30, 60))
            text += f"run {n}" + self._pick("", "", " pre no" if steps else "") + "\n"
            steps += n
            change = self._change()
            if "fix late" in change:
                if late:
                    continue
                late = True
            text += change
            if change:   # 'pre no' does not see changes
                text += "run 1\n"
        return text
