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

# A run of 1200 steps in 40 parts, speed of 1: the limit counts from a normal force half a step apart, per part.
RUN_IN_PARTS = 1e-6
# A formula of two spheres evaluated in double against the code: round-off, and for rebounds the error of 1/80 of a
# collision as time step (measured 1e-5).
CLOSED_FORM = 1e-4
# What stock LAMMPS returns instead of a right value, known to three digits.
STOCK_DEFECT = 2e-3


@dataclass(frozen=True)
class Bound:
    """Relative error that a case with a known answer may have, and why."""
    relative: float
    reason: str


SAME = Bound(1e-6, "nothing acts: single precision in mixed, no error in double")
FREE_FLIGHT = Bound(2e-5, "single precision velocities, rounded without bias, over 10^5 steps")
FIRST_ORDER = Bound(1e-3, "the scheme is of first order in a dashpot and in where a contact begins and ends: 1/2000 of a collision")
LINEAR_RESPONSE = Bound(1e-3, "first order of the dashpot's velocity, half a step behind: 1/2000 of a period")
SLIDING = Bound(5e-4, "the impulse of the contact to a part of its 4000 steps")
SPRING = Bound(1e-3, "a contact of 4000 steps against the same law at 1/20 000; sliding begins and ends at whole steps")
SLIP_TO_ROLL = Bound(2e-4, "hard-sphere motion: the tangential spring stretches by mu m g/kt before the sphere slides or rolls")
DECAY = Bound(1e-3, "the rolling spring stretches first; measured after that")
DRAG = Bound(1e-4, "drag of the velocity half a step ago, 1/10 000 of the time constant")
PULL = Bound(1e-3, "single precision overlap near the largest pull; separation in steps of 1/400 of the gap")
BOUNCES = Bound(5e-3, "as above with 1/500 of a collision, twice for a height, three bounces")
HARD_SPHERE = Bound(2e-2, "hard-sphere limit: gravity acts during the contact, g tc/v")
ENERGY_GAIN = Bound(1e-4, "energy must not grow: the error of 4000 steps a collision")
STOCK_KNOWN = Bound(2e-3, "what stock LAMMPS returns instead, known to three digits")


def closed_system(code, steps, grains):
    """Bound of the momentum of a closed system relative to the sum of all magnitudes.

    Double: sums of round-off. Mixed: each velocity is rounded without bias to 6e-8 of itself at every step, so the errors add
    as a random walk over steps and grains: 6e-8 sqrt(steps/grains), three times that for safety and for fast grains."""
    if code == "mixed":
        return Bound(2e-7 * (steps / grains) ** 0.5, "random walk of single precision rounding: 2e-7 sqrt(steps/grains)")
    return Bound(1e-13, "sums of round-off in double precision")


@dataclass(frozen=True)
class ChungOoi:
    """Collisions of 4000 time steps (2000 where every step is read) against their closed form."""
    peak: Bound = Bound(1e-4, "the peak lies between two of 2000 steps")
    duration: Bound = Bound(1e-3, "known to one step on either side")
    rebound: Bound = Bound(3e-4, "damping at the first and last step; 1e-5 to 1e-4 are seen")
    sliding: Bound = Bound(5e-4, "the impulse of the contact to a part of its 4000 steps")
    sticking: Bound = Bound(5e-3, "the reference is that of two codes, which differ by this much")
    psi_sliding: Bound = Bound(8e-3, "psi is a small difference of large numbers; the codes have 4e-3")
    psi_sticking: Bound = Bound(8e-2, "Maw's continuum, which a Mindlin spring approaches to a few per cent")
    tail: Bound = Bound(1e-2, "the reference is that of two codes, to three digits")
    exact: Bound = Bound(1e-6, "nothing acts; mixed: single precision")


CHUNG_OOI = ChungOoi()

# relative, double: 500 steps of dense powder after a restart file, as far as the log prints digits
CONTINUED_STROKE = 1e-6
# Weight of a bed at rest read from the wall (relative): double rests to round-off; mixed sums forces of single precision.
WALL_WEIGHT = {"host": 1e-9, "double": 1e-9, "mixed": 1e-6}
# Sums over contacts against the same sums over the dumped grains: order of summation; single precision.
WALL_SUMS = {"host": 1e-12, "double": 1e-12, "mixed": 1e-6}
# A grain on a plane of facets against a plane, mixed: 2e4 steps in single precision, a tenth of a turn at most.
ROLLING_MIXED = 1e-4
# A servo at rest: what a single-precision overlap of 1e-3 leaves, and the tail of its approach.
SERVO = 1e-4
# A drum of facets against a round one (position, diameters): the sagitta, of second order in the facet's length.
DRUM_FACETS = 0.02
# Slices are refined to an imbalance of 1.01 at most, or to single grains; grains then move on until the next balancing.
SLICE_IMBALANCE = 1.01
PARTICLE_SHARE = 1.5        # grains: a position on a cut may round to the other side

# Random scripts: 200 steps of dense, partly very fast grains; round-off grows by about ten per collision.
FUZZ = _uniform(1e-7, "double: round-off amplified by several collisions")

# Hundreds of restart files in double precision: positions lose nothing, sums are regrouped at every start.
CONTINUATIONS = _uniform(1e-7, "double: round-off of regrouped sums, amplified by several collisions")

# The same contact law in LIGGGHTS and in GPUDEM, along 800 steps of one contact (any field, of its largest magnitude; positions of a radius).
SAME_LAW = {"double": Bound(2e-11, "round-off of another order of operations; a soft touch amplifies it: 1e-12 seen"),
            "mixed": Bound(3e-5, "forces in single precision, small where the spheres just touch: 7e-6 seen")}
# Another reading of the law makes at least this difference, so that agreement decides between them.
OTHER_READING = 1e-4
# A sphere rolling to rest on a plane, velocity and spin of their first value: at a plane LIGGGHTS' rolling spring is stiffer by overlap/(2R) = 7e-5.
ROLLS_ALIKE = Bound(2e-4, "overlap/(2R), and single precision: cdt at rest jumps between two values")
ROLLING_DISTANCE = Bound(5e-4, "closed form without the landing and the stretching of the rolling spring")
# Means of two programs over so many seeds, apart in standard errors: by chance once in 2000 (Student, 10 degrees of freedom).
BULK_SEEDS = 6
BULK_APART = 5.0
