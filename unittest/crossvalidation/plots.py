# SPDX-License-Identifier: GPL-2.0-only
# Copyright (c) 2026 The GPUDEM developers
"""Figures of doc/crossvalidation.md."""
import os

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from collisions import ALONG, RADII, SIDE  # noqa: E402
from scene import FIELDS  # noqa: E402


def both(ax, abscissa, curves, label):
    """LIGGGHTS as a line, GPUDEM as every twentieth point; abscissa and curves are one array per program."""
    line, = ax.plot(abscissa[0], curves[0], lw=1.2, label=label)
    ax.plot(abscissa[1][::20], curves[1][::20], color=line.get_color(), ls="none", marker="o", ms=2.8)


def contacts(curves, folder):
    figure, ((a, b), (c, d)) = plt.subplots(2, 2, figsize=(9.0, 6.4))
    for name in ("hertz", "hooke/stiffness", "sjkr"):
        rows = curves[name][1:3]
        overlap = [1.0e6 * (RADII.sum() - np.linalg.norm(r[:, 1, :3] - r[:, 0, :3], axis=1)) for r in rows]
        force = [r[:, 1, FIELDS["force"]] @ ALONG for r in rows]
        both(a, overlap, force, name)
    a.set(xlabel="overlap (um)", ylabel="normal force (N)", xlim=(-5.0, None))
    for name in ("hertz oblique", "hertz dashpot", "hertz slides", "hooke/stiffness oblique"):
        scene, *rows = curves[name][:3]
        time = np.arange(len(rows[0])) * scene.dt * 1.0e6
        both(b, [time, time], [r[:, 0, FIELDS["force"]] @ SIDE for r in rows], name)
    b.set(xlabel="time (us)", ylabel="tangential force (N)")
    for name in ("cdt", "epsd", "epsd2", "epsd3"):
        scene, *rows = curves[name][:3]
        time = np.arange(len(rows[0])) * scene.dt * 1.0e6
        both(c, [time, time], [1.0e3 * r[:, 0, FIELDS["torque"]][:, 1] for r in rows], name)
    c.set(xlabel="time (us)", ylabel="torque about y (mN m)")
    for name in ("hertz dashpot", "epsd", "sjkr"):
        scene, reference, double, mixed = curves[name]
        scale = np.linalg.norm(reference[:, :, FIELDS["force"]], axis=2).max()
        for rows, style in ((double, "-"), (mixed, ":")):
            error = np.linalg.norm((rows - reference)[:, 0, FIELDS["force"]], axis=1) / scale
            d.semilogy(np.arange(len(error)) * scene.dt * 1.0e6, np.maximum(error, 1e-18), style, lw=0.8,
                       label=f"{name}, {'double' if style == '-' else 'mixed'}")
    d.set(xlabel="time (us)", ylabel="difference of forces / largest force", ylim=(1e-18, 1e-4))
    for ax in (a, b, c, d):
        ax.legend(fontsize=6)
    figure.suptitle("LIGGGHTS 3.8 (lines) and GPUDEM (points)", fontsize=10)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "crossvalidation_contacts.png"), dpi=90)


def rolls(curves, folder):
    figure, (a, b) = plt.subplots(1, 2, figsize=(9.0, 3.4))
    for model, (scene, runs) in curves.items():
        time = runs["liggghts"].steps * scene.dt
        both(a, [time, time], [runs[p].rows[:, 0, 3] for p in ("liggghts", "double")], model)
        for program, style in (("double", "-"), ("mixed", ":")):
            error = np.abs(runs[program].rows[:, 0, 3] - runs["liggghts"].rows[:, 0, 3]) / runs["liggghts"].rows[0, 0, 3]
            b.semilogy(time, np.maximum(error, 1e-18), style, lw=0.8, label=f"{model}, {program}")
    a.set(xlabel="time (s)", ylabel="velocity (m/s)")
    b.set(xlabel="time (s)", ylabel="difference of velocities / first velocity", ylim=(1e-18, 1e-2))
    for ax in (a, b):
        ax.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "crossvalidation_rolling.png"), dpi=90)


def in_bulk(found, names, folder):
    """Every seed, and the means with their standard errors."""
    figure, axes = plt.subplots(2, (len(found) + 1) // 2, figsize=(9.0, 5.6))
    for ax, (quantity, values) in zip(axes.flat, found.items()):
        for k, (program, of) in enumerate(values.items()):
            ax.plot([k + 0.15] * len(of), of, ".", color=f"C{k}", ms=4)
            ax.errorbar(k - 0.1, np.mean(of), np.std(of, ddof=1) / np.sqrt(len(of)), fmt="o", color=f"C{k}", capsize=4)
        ax.set_xticks(range(len(values)), [names[p].replace(" ", "\n") for p in values], fontsize=7)
        ax.set_title(quantity, fontsize=8)
        ax.set_xlim(-0.5, 2.5)
    for ax in axes.flat[len(found):]:
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "crossvalidation_bulk.png"), dpi=90)
