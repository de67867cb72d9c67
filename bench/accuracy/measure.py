# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Runs scenes in GPUDEM and in the extended-precision reference, and turns their states into errors."""
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import numpy as np

from scenes import E_STAR, TC

DUMP = ("dump state all custom {every} dump.state id xu yu zu vx vy vz omegax omegay omegaz\n"
        "dump_modify state sort id format float %.17g\n")


class Programs:
    """lmp_gpudem, the reference, and how they are run."""

    def __init__(self, gpudem, reference, device, threads, repeat):
        self.gpudem, self.reference = (str(pathlib.Path(p).resolve()) for p in (gpudem, reference))
        self.repeat = repeat
        self.environment = {**os.environ, "GPUDEM_DEVICE": device, "GPUDEM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}

    def run(self, text, precision, files=(), repeat=1):
        """States [snapshot][grain][x 3, v 3, omega 3], seconds of the last run of the input (median), its log, files by name."""
        seconds = []
        for _ in range(repeat):
            with tempfile.TemporaryDirectory() as folder:
                for name, content in files:
                    path = pathlib.Path(folder, name)
                    path.write_bytes(content if isinstance(content, bytes) else content.encode())
                pathlib.Path(folder, "in.scene").write_text(text)
                done = subprocess.run([self.gpudem, "-sf", "gpudem", "-in", "in.scene", "-log", "none", "-nocite"], cwd=folder,
                                      env={**self.environment, "GPUDEM_PRECISION": precision}, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, text=True)
                if done.returncode or "not resident" in done.stdout:
                    sys.exit(f"lmp_gpudem failed or left the device:\n{done.stdout[-3000:]}")
                seconds.append(float(re.findall(r"Loop time of ([0-9.e+-]+)", done.stdout)[-1]))
                dump = pathlib.Path(folder, "dump.state")
                states = read_states(dump.read_text()) if dump.exists() else None
                restart = pathlib.Path(folder, "restart.scene")
                kept = restart.read_bytes() if restart.exists() else None
        return states, statistics.median(seconds), done.stdout, kept

    def exact(self, scene, steps_per_collision):
        """State [grain][x 3, v 3, omega 3] after the scene's duration, in extended precision."""
        steps = scene.duration * steps_per_collision
        done = subprocess.run([self.reference, str(steps), f"{TC / steps_per_collision:.20g}"], input=scene.reference_input(),
                              stdout=subprocess.PIPE, text=True, check=True)
        return np.array(done.stdout.split(), dtype=np.longdouble).reshape(-1, 9)


def read_states(text):
    states = []
    for part in text.split("ITEM: TIMESTEP\n")[1:]:
        rows = part[part.index("ITEM: ATOMS"):].split("\n")[1:]
        table = np.array([row.split() for row in rows if row], dtype=float)
        states.append(table[:, 1:])
    return states


def root_mean_square(a):
    return float(np.sqrt((np.asarray(a, float) ** 2).sum(-1).mean()))


def trajectory_errors(scene, state, exact):
    """Root mean square over the grains: position in diameters, velocity and surface speed R omega in the speed 1 of the scene."""
    difference = state - exact
    return {"position": root_mean_square(difference[:, :3]), "velocity": root_mean_square(difference[:, 3:6]),
            "spin": root_mean_square(difference[:, 6:] * scene.radius[:, None])}


def energy(scene, state):
    """Kinetic energy and that of the Hertzian contacts, 8/15 E* sqrt(R*) overlap^2.5."""
    total = 0.5 * (scene.mass * (state[:, 3:6] ** 2).sum(1)).sum()
    for i in range(len(state) - 1):
        d = state[i + 1:, :3] - state[i, :3]
        d -= np.array(scene.box) * np.round(d / np.array(scene.box))
        r, other = scene.radius[i], scene.radius[i + 1:]
        overlap = r + other - np.sqrt((d * d).sum(1))
        touch = overlap > 0.0
        total += (8.0 / 15.0 * E_STAR * np.sqrt(r * other / (r + other))[touch] * overlap[touch] ** 2.5).sum()
    return total


def trajectory(programs, scene, precision, per_collision, exact, repeat):
    steps = scene.duration * per_collision
    text = scene.head(TC / per_collision) + DUMP.format(every=steps) + f"thermo {steps}\nrun {steps}\n"
    states, seconds, _, _ = programs.run(text, precision, [("data.scene", scene.data())], repeat)
    return trajectory_errors(scene, states[-1], exact), seconds, steps


def energy_drift(programs, scene, precision, per_collision, steps):
    text = scene.head(TC / per_collision) + DUMP.format(every=steps) + f"thermo {steps}\nrun {steps}\n"
    states, seconds, _, _ = programs.run(text, precision, [("data.scene", scene.data())])
    before, after = energy(scene, states[0]), energy(scene, states[-1])
    return {"energy": abs(after / before - 1.0)}, seconds


def settle(programs, scene):
    """Restart file of the bed at rest: dropped with drag, then left without."""
    dt = TC / 30.0
    text = (scene.head(dt) + "fix drag all viscous 0.3\nthermo 20000\nrun 60000\nunfix drag\nrun 60000\n"
            "write_restart restart.scene\n")
    return programs.run(text, "double", [("data.scene", scene.data())])[3]


def rest(programs, scene, restart, precision, per_collision, steps):
    """What a bed at rest does when left alone: largest motion (diameters), weight on the floor (of the weight), speed."""
    # without rolling friction a grain may roll on for ever: all are stopped; the springs are those of the bed at rest
    text = (scene.head(TC / per_collision, "read_restart restart.in") +
            "velocity all set 0.0 0.0 0.0\nset group all omega 0.0 0.0 0.0\n" + DUMP.format(every=steps) +
            "compute push all reduce sum f_floor[4]\nthermo_style custom step ke c_push\n"
            f"thermo_modify norm no format float %.15g\nthermo {steps}\nrun {steps}\n")
    states, seconds, log, _ = programs.run(text, precision, [("restart.in", restart)])
    last = re.findall(r"^ *(\d+) +(\S+) +(\S+) *$", log, re.M)[-1]
    moved = states[-1][:, :3] - states[0][:, :3]
    return {"largest motion": float(np.sqrt((moved ** 2).sum(1)).max()), "motion": root_mean_square(moved),
            "weight on the floor": abs(float(last[2]) / (scene.mass.sum() * scene.gravity) - 1.0),
            "speed": root_mean_square(states[-1][:, 3:6])}, seconds
