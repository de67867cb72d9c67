#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Draws modular_coordinates.png for Howto_precision.md: the window, and the spacing of representable coordinates."""
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

WINDOW = 9.0  # diameters: eight cells of 1.125


def draw_windows(ax):
    """A box of three windows; two touching grains on both sides of a seam."""
    for k in range(3):
        ax.add_patch(plt.Rectangle((k * WINDOW, -1.2), WINDOW, 2.4, fc="#eef3f8" if k % 2 else "#dbe6f0", ec="none"))
        ax.annotate("", ((k + 1) * WINDOW - 0.1, -1.9), (k * WINDOW + 0.1, -1.9), arrowprops=dict(arrowstyle="<->"))
        ax.text((k + 0.5) * WINDOW, -3.0, "one window: 0 ... $2^{32}-1$", ha="center", fontsize=8)
        for c in range(8):
            ax.plot([k * WINDOW + c * WINDOW / 8] * 2, [-1.2, 1.2], lw=0.4, color="#9bb")
    a, b = WINDOW - 0.36, WINDOW + 0.62
    for x, colour, name, dy in ((a, "#c0392b", "a", 1.6), (b, "#2c6e9f", "b", 1.6)):
        ax.add_patch(plt.Circle((x, 0), 0.5, fc=colour, ec="k", lw=0.5))
        count = round((x % WINDOW) / WINDOW * 2**32)
        ax.text(x + (-0.3 if name == "a" else 0.3), dy, f"${name}$ = {count}", ha="right" if name == "a" else "left",
                color=colour, fontsize=9)
    counts = [round((x % WINDOW) / WINDOW * 2**32) for x in (a, b)]
    difference = (counts[1] - counts[0]) % 2**32
    ax.text(1.5 * WINDOW, 3.0, f"$b - a$ mod $2^{{32}}$ = {difference}  =  {difference * WINDOW / 2**32:.9f} d: "
            "one subtraction, across any seam", ha="center", fontsize=9)
    ax.set_xlim(-0.3, 3 * WINDOW + 0.3)
    ax.set_ylim(-3.6, 3.8)
    ax.set_aspect("equal")
    ax.axis("off")


def draw_spacing(ax):
    """Distance between neighbouring representable coordinates against the distance from the origin."""
    x = np.logspace(-1, 6, 400)
    ax.loglog(x, np.spacing(x.astype(np.float32)), color="#c0392b", label="absolute, single precision")
    ax.loglog(x, np.spacing(x), color="#888", label="absolute, double precision")
    ax.loglog(x, np.full_like(x, WINDOW / 2.0**32), color="#2c6e9f", lw=2, label="mixed: window/$2^{32}$")
    ax.loglog(x, np.full_like(x, WINDOW / 2.0**64), color="#1b3a57", lw=2, ls="--", label="double: window/$2^{64}$")
    ax.axhspan(1e-4, 1e-2, color="#f4d58d", alpha=0.5, lw=0)
    ax.text(0.13, 1.0e-3, "typical overlap", fontsize=8, va="center")
    ax.set_xlabel("distance from the origin (d)")
    ax.set_ylabel("spacing of coordinates (d)")
    ax.set_xlim(0.1, 1e6)
    ax.legend(fontsize=7.5, loc="lower right", bbox_to_anchor=(1.0, 0.06))


figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.2, 5.6), height_ratios=[1, 2.3])
draw_windows(top)
draw_spacing(bottom)
figure.tight_layout()
figure.savefig(os.path.join(os.path.dirname(os.path.abspath(__file__)), "modular_coordinates.png"), dpi=110)
