# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Tolerances of the styles tests: relative to a stated magnitude, per quantity, each with its reason.

Positions are measured in grain diameters, every other quantity in the largest magnitude that stock LAMMPS
shows for the whole field (all three components together), because a component that should vanish has no
scale of its own.
"""
from dataclasses import dataclass


@dataclass(frozen=True)
class Tolerance:
    """Largest allowed difference of each kind of column."""
    position: float       # of a diameter
    velocity: float       # of the fastest grain
    spin: float           # of the fastest spin
    force: float          # of the largest force
    torque: float         # of the largest torque
    other: float          # of the column's largest magnitude (per-fix and per-compute columns)
    thermo: float         # of the thermo column's largest magnitude
    reason: str
    isolated_fraction: float = 0.0   # of the grains that may differ more ...
    isolated_factor: float = 1.0     # ... by this factor
    disturbed_thermo: float = 0.0    # as thermo, for sums over grains some of which differ more


def _uniform(value, reason):
    return Tolerance(value, value, value, value, value, value, value, reason)


# Different order of summation and x += dt v in another grouping: round-off, which grows by about a factor of
# ten per collision; the runs last two or three collisions.
DOUBLE = _uniform(1e-10, "double: round-off amplified by two or three collisions")

# No contact was evaluated twice: only the order of sums differs.
ROUND_OFF = _uniform(1e-12, "double: order of summation only")

# A per-step force term or a rotation formula of another grouping, over a few hundred steps of dense flow.
DOUBLE_LONG = _uniform(1e-8, "double: round-off amplified by about ten collisions")

# Forces in single precision (6e-8) from position differences that are exact far below the overlap: the velocity
# error is that of a force summed over the run, the position error one time step's worth of it per step.
# A force is a stiff spring on an overlap of about 1e-2 diameters and so amplifies a position error most.
# Measured: a tenth of these values.
MIXED = Tolerance(position=3e-6, velocity=2e-5, spin=2e-5, force=4e-5, torque=4e-5, other=4e-5, thermo=2e-6,
                  reason="mixed: single precision forces over two or three collisions",
                  # A pair whose gap is below the error of its coordinates makes contact one step sooner or later, and
                  # then differs by what the contact does in one step. It disturbs those it touches (seen: 12 of 367).
                  isolated_fraction=0.04, isolated_factor=300.0, disturbed_thermo=9e-5)

# bench/in.chute: stiffness 2e5 turns the round-off of a coordinate of 40 diameters into 5e-12 of the largest force at
# each step, and every rebuild regroups sums; forces follow positions with the factor stiffness * diameter / force = 1e3.
CHUTE_DOUBLE = Tolerance(position=1e-11, velocity=1e-10, spin=1e-10, force=1e-9, torque=1e-9, other=1e-10,
                         thermo=1e-11, reason="double: stiff contacts, 100 steps")
CHUTE_DOUBLE_LONG = Tolerance(position=1e-10, velocity=2e-9, spin=2e-8, force=4e-8, torque=4e-8, other=2e-9,
                              thermo=1e-10, reason="double: stiff contacts, 500 steps, ten collisions")

# A shrink-wrapped box is fitted when LAMMPS reneighbours, which GPUDEM does at other steps: each face may differ
# by what a grain moves between two rebuilds, less than this many skins.
SHRINK_WRAP_SKINS = 1.0

# Kinetic energy of the chute after 100 steps, mixed (relative).
CHUTE_MIXED_ENERGY = 1e-6

# Bulk of a poured heap, which is chaotic: means over thousands of grains, in different micro-states.
BULK_HEIGHT = 0.02          # relative, mean height of the heap
TUMBLED_HEIGHT = 0.2        # relative: 100 grains in a box turned over; stock runs that differ in skin only: 0.1
BULK_SIGMAS = 4.0           # contacts per grain c of n grains: standard error of a difference, sqrt(4 c / n), times this
BULK_FLOW_SPREAD = 0.13     # contacts per grain of the 3000 grains flowing: spread of stock runs that differ in skin only
BULK_ENERGY_BAND = 0.25     # relative, kinetic energy while pouring
BULK_LOST = 0.02            # of the grains, which leave an open container one by one at chaotic times

# A formula of two spheres evaluated in double against the code: round-off, and for rebounds the error of 1/80 of a
# collision as time step (measured 1e-5).
CLOSED_FORM = 1e-4
# What stock LAMMPS returns instead of a right value, known to three digits.
STOCK_DEFECT = 2e-3


@dataclass(frozen=True)
class ChungOoi:
    """Relative errors of a collision of 4000 time steps (2000 where every step is read) against its closed form."""
    peak: float = 1e-4
    duration: float = 1e-3      # known to one step on either side
    rebound: float = 3e-4       # measured 1e-5 to 1e-4 (damping at the first and last step); mixed the same
    sliding: float = 5e-4
    sticking: float = 5e-3      # the reference is that of two codes, which differ by this much
    psi_sliding: float = 8e-3   # psi is a small difference of large numbers; the codes have 4e-3
    psi_sticking: float = 8e-2  # Maw's continuum solution, which a Mindlin spring approaches to a few per cent
    tail: float = 1e-2
    exact: float = 1e-6         # mixed: single precision


CHUNG_OOI = ChungOoi()

# relative, double: 500 steps of dense powder after a restart file, as far as the log prints digits
CONTINUED_STROKE = 1e-6
