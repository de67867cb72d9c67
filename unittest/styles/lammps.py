# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Run stock LAMMPS and GPUDEM on one input and read what they wrote."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "testing"))

GPUDEM = os.environ.get("GPUDEM_LMP", "lmp_gpudem")
STOCK = os.environ.get("STOCK_LMP") or shutil.which("lmp") or "lmp"
SOURCE = pathlib.Path(os.environ.get("LAMMPS_SOURCE_DIR", "."))
MPIRUN = os.environ.get("MPIRUN") or shutil.which("mpirun")

# full digits for everything that is compared
DUMP_FORMAT = "%.17g"


class Run:
    """A finished LAMMPS process: exit status, log, and the files in its directory."""

    def __init__(self, directory, status, text):
        self.directory = directory
        self.status = status
        self.text = text

    def path(self, name):
        return self.directory / name

    def dump(self, name="dump.out"):
        return read_dump(self.path(name))

    def thermo(self):
        return read_thermo(self.text)


class StylesTest(unittest.TestCase):
    """Each test owns a temporary directory; each run a directory within it."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="gpudem-styles-"))
        self.runs = 0

    def tearDown(self):
        outcome = self._outcome
        failed = not getattr(outcome, "success", True)
        if failed and os.environ.get("GPUDEM_KEEP"):
            print("kept", self.root)
            return
        shutil.rmtree(self.root, ignore_errors=True)

    def run_lammps(self, text, files=(), gpudem=None, threads=1, ranks=1, environment=None, arguments=None,
                   executable=None, name=None, succeed=True, timeout=240):
        """Run an input. gpudem: None for stock, 'double' or 'mixed' for the resident run.

        files: (name, content) pairs or paths that are put beside the input.
        """
        self.runs += 1
        directory = self.root / (name or f"{self.runs:02d}-{gpudem or 'stock'}")
        directory.mkdir(exist_ok=True)
        for f in files:
            if isinstance(f, tuple):
                content = f[1]
                (directory / f[0]).write_text(content) if isinstance(content, str) else \
                    (directory / f[0]).write_bytes(content)
            else:
                shutil.copy(f, directory)
        (directory / "in.test").write_text(text)
        env = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMP_NUM_THREADS="1")
        for key in ("GPUDEM_PRECISION", "GPUDEM_THREADS"):
            env.pop(key, None)
        if gpudem:
            env["GPUDEM_PRECISION"] = gpudem
            env["GPUDEM_THREADS"] = str(threads)
        env.update(environment or {})
        if arguments is None:
            arguments = ["-sf", "gpudem"] if gpudem else []
        command = [executable or (GPUDEM if gpudem else STOCK), *arguments, "-in", "in.test", "-log", "log.test",
                   "-nocite"]
        if ranks == 1:   # a process of its own needs no daemon and no network: starts in a tenth of the time
            env.update(OMPI_MCA_ess_singleton_isolated="1", OMPI_MCA_btl="self", OMPI_MCA_pml="ob1", OMPI_MCA_osc="^ucx")
        else:
            command = [MPIRUN, "--oversubscribe", "-np", str(ranks), *command]
        # Open MPI's launchers share a session directory, and one that ends can remove it under one that starts
        env["OMPI_MCA_orte_tmpdir_base"] = str(directory)
        try:
            done = subprocess.run(command, cwd=directory, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL, timeout=timeout, text=True, errors="replace")
        except subprocess.TimeoutExpired as stuck:
            self.fail(f"{command} did not end within {timeout} s; last output:\n{(stuck.stdout or b'')[-2000:]}")
        log = directory / "log.test"
        text = log.read_text(errors="replace") if log.exists() else ""
        result = Run(directory, done.returncode, text + "\n" + done.stdout)
        result.log = text
        result.screen = done.stdout
        result.text = text or done.stdout
        result.everything = text + "\n" + done.stdout
        if succeed and done.returncode != 0:
            self.fail(f"{' '.join(command)} ended with status {done.returncode}:\n{done.stdout[-3000:]}")
        return result

    def assertResident(self, run):
        self.assertIn("GPUDEM resident run", run.everything)
        self.assertNotIn("not resident", run.everything)


def source_file(*parts):
    """A file of the LAMMPS source package, used in place and never copied into this repository."""
    path = SOURCE.joinpath(*parts)
    if not path.exists():
        raise unittest.SkipTest(f"{path} is missing: set LAMMPS_SOURCE_DIR")
    return path


def read_dump(path):
    """{step: (column names, array sorted by atom-ID)} of a text dump with an id column."""
    snapshots = {}
    lines = pathlib.Path(path).read_text().split("\n")
    k = 0
    while k < len(lines):
        if lines[k].startswith("ITEM: TIMESTEP"):
            step = int(lines[k + 1])
        elif lines[k].startswith("ITEM: NUMBER OF"):
            count = int(lines[k + 1])
        elif lines[k].startswith("ITEM: ATOMS") or lines[k].startswith("ITEM: ENTRIES"):
            names = lines[k].split()[2:]
            rows = [line.split() for line in lines[k + 1:k + 1 + count]]
            table = np.array(rows, dtype=float).reshape(count, len(names))
            if "id" in names:
                table = table[np.argsort(table[:, names.index("id")])]
            snapshots[step] = (names, table)
            k += count
        k += 1
    return snapshots


def read_thermo(text):
    """One (column names, array) per run of a log."""
    runs, names, rows = [], None, []
    for line in text.split("\n"):
        words = line.split()
        if words[:1] == ["Step"]:
            names, rows = words, []
        elif words[:2] == ["Loop", "time"] and names:
            runs.append((names, np.array(rows, dtype=float).reshape(len(rows), len(names))))
            names = None
        elif names and len(words) == len(names):
            try:
                rows.append([float(w) for w in words])
            except ValueError:
                pass
    return runs


def make_tests(base, groups, namespace):
    """One test class per group, one method per case that calls base.check(case); *base* itself leaves *namespace*."""
    def method(case):
        def test(self):
            self.check(case)
        return test

    for group, cases in groups.items():
        methods = {"test_" + name: method(case) for name, case in cases.items()}
        namespace[group] = type(group, (base,), {**methods, "__module__": namespace["__name__"]})
    del namespace[base.__name__]
