# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Compare dumps and thermodynamic output against stock LAMMPS, relative to the scale of each field."""
import os

import numpy as np

# columns that form one field share one scale
FIELDS = {
    "position": ("xu", "yu", "zu"),
    "velocity": ("vx", "vy", "vz"),
    "spin": ("omegax", "omegay", "omegaz"),
    "force": ("fx", "fy", "fz"),
    "torque": ("tqx", "tqy", "tqz"),
}
EXACT = ("id", "type", "radius", "mass", "diameter")
FORCE_SUMS = ("f_ice", "f_set")   # fixes whose vector is a sum of forces on grains
THERMO_FIELDS = (("Press", "Pxx", "Pyy", "Pzz", "Pxy", "Pxz", "Pyz"), ("PotEng", "TotEng", "KinEng"))
THERMO_EXACT = ("Step", "Atoms")


def _field(name):
    for field, columns in FIELDS.items():
        if name in columns:
            return field
    return name


def _say(what, measured):
    if os.environ.get("GPUDEM_TEST_REPORT"):
        print(what + ": " + ", ".join(f"{k} {v:.1e}" for k, v in measured.items()))


def compare_dumps(test, stock, ours, tolerance, diameter=1.0, first=0, what=""):
    """Every snapshot of both dumps; returns whether isolated grains differ more than the others may."""
    test.assertEqual(sorted(stock), sorted(ours), "the dumps hold different steps")
    test.assertTrue(stock, "the dump is empty")
    measured, problems, isolated = {}, [], False
    for step in sorted(stock):
        if step < first:
            continue
        names, a = stock[step]
        names2, b = ours[step]
        test.assertEqual(names, names2)
        test.assertEqual(a.shape, b.shape, f"different numbers of grains at step {step}")
        test.assertTrue(np.array_equal(a[:, names.index("id")], b[:, names.index("id")]), f"other grains at {step}")
        test.assertTrue(np.all(np.isfinite(a)) and np.all(np.isfinite(b)), f"not a number at step {step}")
        for field in dict.fromkeys(_field(n) for n in names):
            columns = [k for k, n in enumerate(names) if _field(n) == field]
            difference = np.abs(a[:, columns] - b[:, columns]).max(initial=0.0)
            if field in EXACT:
                allowed, scale = 0.0, 1.0
            else:
                scale = diameter if field == "position" else np.abs(a[:, columns]).max(initial=0.0)
                allowed = getattr(tolerance, field if field in FIELDS else "other")
            relative = difference / scale if scale > 0.0 else (0.0 if difference == 0.0 else np.inf)
            measured[field] = max(measured.get(field, 0.0), relative)
            if relative > allowed and relative <= allowed * tolerance.isolated_factor:
                beyond = np.abs(a[:, columns] - b[:, columns]).max(axis=1) > allowed * scale
                if beyond.sum() <= tolerance.isolated_fraction * len(a):
                    isolated = True
                    continue
            if relative > allowed:
                worst = np.unravel_index(np.abs(a[:, columns] - b[:, columns]).argmax(), (len(a), len(columns)))
                problems.append(f"step {step}: {field} differs by {relative:.3e} of {scale:.3g} (allowed {allowed:g}), "
                                f"worst at atom {int(a[worst[0], names.index('id')])}: stock {a[worst[0], columns]} "
                                f"GPUDEM {b[worst[0], columns]}; {(np.abs(a[:, columns] - b[:, columns]).max(axis=1) > allowed * scale).sum()} "
                                f"of {len(a)} grains")
    _say(f"{test.id()} {what} dump", measured)
    if problems:
        test.fail(f"{what} ({tolerance.reason})\n" + "\n".join(problems[:12]))
    return isolated


def compare_thermo(test, stock, ours, tolerance, what="", skip=(), special=None, disturbed=False):
    """Every line of every run of two logs.

    special: {column: its own relative tolerance}; disturbed: what compare_dumps() returned for these runs.
    """
    test.assertEqual(len(stock), len(ours), "the logs hold different numbers of runs")
    test.assertTrue(stock, "the log holds no thermodynamic output")
    measured, problems = {}, []
    for (names, a), (names2, b) in zip(stock, ours):
        test.assertEqual(names, names2)
        test.assertEqual(a.shape, b.shape, "different numbers of thermo lines")
        for k, name in enumerate(names):
            if name in skip:
                continue
            group = next((g for g in THERMO_FIELDS if name in g), (name,))
            stem = name.split("[")[0]
            if stem in FORCE_SUMS:
                group = tuple(n for n in names if n.startswith(stem))
            scale = np.abs(a[:, [j for j, n in enumerate(names) if n in group]]).max()
            difference = np.abs(a[:, k] - b[:, k]).max()
            relative = difference / scale if scale > 0.0 else (0.0 if difference == 0.0 else np.inf)
            if not np.isfinite(b[:, k]).all():
                relative = np.inf
            ordinary = tolerance.force if stem in FORCE_SUMS else tolerance.thermo
            if disturbed:
                ordinary = max(ordinary, tolerance.disturbed_thermo)
            allowed = 0.0 if name in THERMO_EXACT else (special or {}).get(name, ordinary)
            measured[name] = max(measured.get(name, 0.0), relative)
            if relative > allowed:
                problems.append(f"{name} differs by {relative:.3e} of {scale:.3g} (allowed {allowed:g}): stock "
                                f"{a[:, k][:6]} GPUDEM {b[:, k][:6]}")
    _say(f"{test.id()} {what} thermo", measured)
    if problems:
        test.fail(f"{what} ({tolerance.reason})\n" + "\n".join(problems))
