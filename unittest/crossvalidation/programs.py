# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Runs a scene in LIGGGHTS and in GPUDEM (resident, CPU, one core each)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "styles"))
from lammps import read_dump  # noqa: E402


class Failed(RuntimeError):
    """A program that did not end well, with the end of its output."""


@dataclass
class Result:
    steps: np.ndarray     # [snapshot]
    rows: np.ndarray      # [snapshot][grain][x 3, v 3, omega 3, force 3, torque 3], or one array per snapshot if grains are lost
    seconds: float        # of all runs of the input
    text: str


class Programs:
    def __init__(self, gpudem=None, liggghts=None):
        self.gpudem = gpudem or os.environ.get("GPUDEM_LMP", "lmp_gpudem")
        self.liggghts = liggghts or os.environ.get("LIGGGHTS") or shutil.which("liggghts")

    def missing(self):
        """What to say if one of the programs is not there."""
        if not (self.liggghts and shutil.which(self.liggghts)):
            return f"liggghts not found ({self.liggghts}): install it (Debian's package liggghts), or name it with --liggghts"
        if not shutil.which(self.gpudem):
            return f"{self.gpudem} is missing: build with scripts/build, or name it with --gpudem"
        return ""

    def run(self, scene, program):
        """program: liggghts, double or mixed (precision of GPUDEM)."""
        liggghts = program == "liggghts"
        command = [self.liggghts] if liggghts else [self.gpudem, "-sf", "gpudem", "-nocite"]
        with tempfile.TemporaryDirectory(prefix="gpudem-crossvalidation-") as folder:
            environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                               GPUDEM_DEVICE="cpu", GPUDEM_THREADS="1", GPUDEM_PRECISION="double" if liggghts else program,
                               OMPI_MCA_ess_singleton_isolated="1", OMPI_MCA_btl="self", OMPI_MCA_pml="ob1", OMPI_MCA_osc="^ucx",
                               OMPI_MCA_orte_tmpdir_base=folder, OMP_WAIT_POLICY="passive")
            script = scene.liggghts() if liggghts else scene.gpudem()
            for name, text in (("data.scene", scene.data(liggghts and scene.planar)), ("in.scene", script), *scene.files()):
                pathlib.Path(folder, name).write_text(text)
            done = subprocess.run([*command, "-in", "in.scene", "-log", "none"], cwd=folder, env=environment,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
            dump = pathlib.Path(folder, "dump.out")
            if done.returncode or "Loop time" not in done.stdout or not dump.exists():
                raise Failed(f"{scene.name}, {program}: status {done.returncode}\n{done.stdout[-3000:]}")
            if not liggghts and ("GPUDEM resident run" not in done.stdout or "not resident" in done.stdout):
                raise Failed(f"{scene.name}: GPUDEM left the device\n{done.stdout[-3000:]}")
            snapshots = read_dump(dump)
        steps = sorted(snapshots)
        rows = [snapshots[s][1][:, 1:] for s in steps]
        same = all(len(r) == len(rows[0]) for r in rows)
        return Result(np.array(steps), np.array(rows) if same else rows,
                      sum(map(float, re.findall(r"Loop time of ([0-9.e+-]+)", done.stdout))), done.stdout)
