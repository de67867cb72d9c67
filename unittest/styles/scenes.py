# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Small scenes: random dense clouds of unequal grains, and the input around them."""
import numpy as np

# one grain diameter, to which position differences are compared
DIAMETER = 1.0


def cloud(cells=(8, 8, 8), spacing=0.9, speed=3.0, spin=5.0, seed=1, dimension=3, margin=(0.0, 0.0, 0.0),
          frozen_layer=False, centred=False, keep=None, edit=None):
    """Text of a LAMMPS data file: jittered lattice, radii 0.4-0.5, densities 1-3, two types, many overlaps.

    margin: empty space between the grains and the box, each side. frozen_layer: the lowest layer is type 2 and
    at rest. centred: x and y are measured from the middle of the box, grains outside a cylinder are left out.
    keep(x): is there a grain at x? edit(atoms, velocities): last changes to the rows of the file.
    """
    rng = np.random.default_rng(seed)
    cells = np.array(cells)
    if dimension == 2:
        cells[2] = 1
    n = int(np.prod(cells))
    grid = np.stack(np.meshgrid(*[np.arange(c) for c in cells], indexing="ij"), -1).reshape(-1, 3) + 0.5
    x = grid * spacing + rng.uniform(-0.06, 0.06, (n, 3))
    hi = cells * spacing
    if dimension == 2:
        x[:, 2] = 0.0
    lo = np.zeros(3)
    if centred:
        lo[:2] -= hi[:2] / 2
        hi = hi + lo
        x = x + lo
        x = x[np.hypot(x[:, 0], x[:, 1]) < hi[0] - 0.2]
        n = len(x)
    if keep:
        x = x[[bool(keep(p)) for p in x]]
        n = len(x)
    x = rng.permutation(x)   # atom-IDs in no spatial order
    radius = rng.uniform(0.4, 0.5, n)
    density = rng.uniform(1.0, 3.0, n)
    types = rng.integers(1, 3, n)
    v = rng.uniform(-speed, speed, (n, 3))
    w = rng.uniform(-spin, spin, (n, 3))
    if frozen_layer:
        bottom = x[:, 2] < spacing
        types = np.where(bottom, 2, 1)
        v[bottom] = 0.0
        w[bottom] = 0.0
    if dimension == 2:
        v[:, 2] = 0.0
        w[:, :2] = 0.0
    lo = lo - np.array(margin)
    hi = hi + np.array(margin)
    if dimension == 2:
        lo[2], hi[2] = -0.5, 0.5
    text = f"random cloud, seed {seed}\n\n{n} atoms\n2 atom types\n\n"
    for d, axis in enumerate("xyz"):
        text += f"{lo[d]:.17g} {hi[d]:.17g} {axis}lo {axis}hi\n"
    text += "\nAtoms # sphere\n\n"
    atoms = [[k + 1, types[k], 2 * radius[k], density[k], *x[k]] for k in range(n)]
    velocities = [[k + 1, *v[k], *w[k]] for k in range(n)]
    if edit:
        edit(atoms, velocities)
    text += "".join(f"{a[0]} {a[1]} {a[2]:.17g} {a[3]:.17g} {a[4]:.17g} {a[5]:.17g} {a[6]:.17g}\n" for a in atoms)
    text += "\nVelocities\n\n"
    text += "".join(f"{w[0]} " + " ".join(f"{c:.17g}" for c in w[1:]) + "\n" for w in velocities)
    return text


HOOKE = "gran/hooke 2.0e4 NULL 50.0 NULL 0.5 1"
HOOKE_HISTORY = "gran/hooke/history 2.0e4 NULL 50.0 NULL 0.5 1"
HERTZ_HISTORY = "gran/hertz/history 2.0e5 NULL 200.0 NULL 0.5 1"

DUMP_COLUMNS = "id type xu yu zu vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz"
THERMO = "step atoms ke c_spin vol"


def head(boundary="p p p", dimension=3, read="read_data cloud.data"):
    return (f"dimension {dimension}\n" +
            f"units lj\natom_style sphere\nboundary {boundary}\nnewton off\ncomm_modify vel yes\n{read}\n")


def middle(pair=HOOKE_HISTORY, skin=0.05, timestep=1.0e-4, neighbor="delay 0 every 1 check yes", coeff=("* *",)):
    coefficients = "".join(f"pair_coeff {c}\n" for c in coeff)
    return (f"pair_style {pair}\n{coefficients}neighbor {skin} bin\nneigh_modify {neighbor}\n"
            f"timestep {timestep}\n")


def output(every=50, columns="", thermo=THERMO, dump=True):
    text = ("compute spin all erotate/sphere\n"
            f"thermo_style custom {thermo}\nthermo_modify norm no lost ignore format float %.17g\nthermo {every}\n")
    if dump:
        text += (f"dump out all custom {every} dump.out {DUMP_COLUMNS} {columns}\n"
                 "dump_modify out sort id format float %.17g\n")
    return text


def scene(fixes="fix move all nve/sphere", boundary="p p p", dimension=3, pair=HOOKE_HISTORY, steps=200, every=50,
          columns="", thermo=THERMO, before="", after=None, **kw):
    """A whole input: box, pair style, fixes, output and a run."""
    return (head(boundary, dimension) + middle(pair, **kw) + before + fixes + "\n" +
            output(every, columns, thermo) + (f"run {steps}\n" if after is None else after))
