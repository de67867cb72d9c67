# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""One process of lmp_gpudem for a benchmark: how it is started, and what its log says of each run."""
import os
import re
import statistics
import subprocess
import sys
from dataclasses import dataclass

HERE = os.path.dirname(os.path.abspath(__file__))
BLOCK = re.compile(r"^Step .*?^Loop time of \S+ on .*?$.*?^Dangerous builds", re.M | re.S)


@dataclass
class Loop:
    """One run command of an input."""
    seconds: float
    steps: int
    grains: int
    rebuilds: int
    first: dict  # thermo keyword: value at the first step
    last: dict   # and at the last

    @property
    def per_step(self):
        return self.seconds / max(1, self.steps)


@dataclass
class Log:
    loops: list
    bytes_per_grain: float  # on the device, 0 if the log does not say
    device: str
    text: str


def add_program(parser):
    """Options that say which program runs, and where."""
    parser.add_argument("--lmp", default=os.path.join(HERE, "..", "build", "lmp_gpudem"), help="launcher of GPUDEM")
    parser.add_argument("--device", default=os.environ.get("GPUDEM_DEVICE", "cpu"), choices=["cpu", "gpu"])
    parser.add_argument("--precision", default="mixed", choices=["mixed", "double"])
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="on the CPU")
    parser.add_argument("--csv", default="", help="write the table into this file too")
    parser.add_argument("--scratch", default=None, help="folder for data and dumps, default the system's")


def start(arguments, words, folder):
    """Run an input with these words and return its Log."""
    # a process of its own needs no daemon of MPI
    environment = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_ess_singleton_isolated": "1",
                   **os.environ, "GPUDEM_DEVICE": arguments.device, "GPUDEM_PRECISION": arguments.precision,
                   "GPUDEM_THREADS": str(arguments.threads)}
    command = [os.path.abspath(arguments.lmp), "-sf", "gpudem", "-log", "none", *map(str, words)]
    done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace")
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-3000:]}")
    if "not resident" in done.stdout or "at every step" in done.stdout:
        sys.exit(f"{' '.join(command)} did not stay on the device:\n" +
                 "\n".join(line for line in done.stdout.split("\n") if "GPUDEM" in line or "on host" in line))
    return read(done.stdout)


def read(text):
    loops = []
    for block in BLOCK.findall(text):
        lines = block.split("\n")
        names = lines[0].split()
        rows = [line.split() for line in lines[1:] if re.fullmatch(r"(\s+[-+.\deinfa]+)+\s*", line)]
        rows = [row for row in rows if len(row) == len(names)]
        time, steps, grains = re.search(r"Loop time of (\S+) on .* for (\d+) steps with (\d+) atoms", block).groups()
        loops.append(Loop(float(time), int(steps), int(grains),
                          int(re.search(r"Neighbor list builds = (\d+)", block)[1]),
                          *(dict(zip(names, map(float, rows[k]))) if rows else {} for k in (0, -1))))
    memory = re.findall(r"GPUDEM memory: (\d+) bytes per grain", text)
    device = re.findall(r"^  device +: (.*)$", text, re.M)
    return Log(loops, float(memory[-1]) if memory else 0.0, device[-1] if device else "", text)


@dataclass
class Compared:
    """Two series of the same length, measured in turn."""
    first: float   # median
    second: float
    low: float     # smallest and largest ratio of two measured one after the other
    high: float

    @property
    def ratio(self):
        return self.second / self.first

    def text(self):
        return f"{self.ratio:.3f} ({self.low:.3f} to {self.high:.3f})"


def compare(first, second):
    ratios = [b / a for a, b in zip(first, second)]
    return Compared(statistics.median(first), statistics.median(second), min(ratios), max(ratios))


def markdown(names, rows):
    print("| " + " | ".join(names) + " |\n" + "|---" * len(names) + "|")
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print(flush=True)
