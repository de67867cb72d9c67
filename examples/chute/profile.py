#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""profile.py OUT.png LABEL=DUMP ...: mean velocity down the slope against height, one line per dump (id type x y z vx vz)."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def profile(path, height=1.0):
    """Mean of vx in slabs of the given height (diameters); slabs with fewer than 50 grains are left out."""
    a = np.loadtxt(path, skiprows=9)
    a = a[a[:, 1] == 1]
    slab = np.clip(np.floor(a[:, 4] / height).astype(int), 0, None)
    count = np.bincount(slab)
    mean = np.bincount(slab, a[:, 5]) / np.maximum(count, 1)
    kept = count >= 50
    return mean[kept], (np.arange(len(count)) + 0.5)[kept] * height


out, *runs = sys.argv[1:]
figure, ax = plt.subplots(figsize=(4.6, 3.4))
for run, style in zip(runs, ("k-", "k:", "ro", "bx")):
    label, path = run.split("=", 1)
    ax.plot(*profile(path), style, label=label, mfc="none", ms=5)
ax.set_xlabel(r"velocity down the slope ($\sqrt{g d}$)")
ax.set_ylabel("height above the base (d)")
ax.legend(fontsize=8, loc="lower right")
figure.tight_layout()
figure.savefig(out, dpi=110)
