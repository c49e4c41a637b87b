#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Plots phase functions of droplets and the dome of the sky; like a notebook, by cells (`# %%`).

sky_and_phase.py [FOLDER]    writes phase.png and sky.png there (default: here)
Needs python3-cffi, python3-numpy and python3-matplotlib.
"""
import pathlib
import sys

import matplotlib
import numpy as np

import welkin as wlk

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")

# %% What a droplet does to light: Mie theory beside the closed form of [J23]
context = wlk.Context()
angle = np.radians(np.concatenate([np.geomspace(0.01, 1, 60), np.linspace(1, 180, 1200)[1:]]))
figure, axes = plt.subplots(figsize=(8, 4.5))
for diameter, colour in ((5, "tab:orange"), (10, "tab:blue"), (40, "tab:green")):
    for model, style in ((wlk.lib.WLK_PHASE_TABLE, "-"), (wlk.lib.WLK_PHASE_ANALYTIC, ":")):
        medium = context.create_medium(wlk.make("WlkMediumInfo", diameter_um=diameter,
                                                phaseModel=model))
        name = f"{diameter} um" + (", closed form" if style == ":" else "")
        axes.semilogy(np.degrees(angle), context.phase(medium, angle)[:, 1], style, color=colour,
                      label=name, linewidth=1)
axes.set(xlabel="scattering angle, degrees", ylabel="phase function at 550 nm, 1/sr",
         xlim=(0, 180), title="Cloud droplets: bows and glory need the table")
axes.legend()
figure.tight_layout()
figure.savefig(folder / "phase.png", dpi=110)

# %% The sky above, by the height of the sun
context.set_atmosphere(wlk.lib.WLK_ATMOSPHERE_EARTH_CLEAR)
side = 160
y, x = np.mgrid[1:-1:side * 1j, -1:1:side * 1j]
radius = np.hypot(x, y)
zenith = np.minimum(radius, 1) * np.pi / 2  # the zenith in the middle, the horizon at the rim
dome = np.stack([np.sin(zenith) * np.where(radius > 0, x / np.maximum(radius, 1e-9), 0),
                 np.cos(zenith),
                 -np.sin(zenith) * np.where(radius > 0, y / np.maximum(radius, 1e-9), 0)], axis=-1)
figure, panels = plt.subplots(1, 4, figsize=(12, 3.4))
for panel, elevation in zip(panels, (60, 20, 3, -4)):
    sun = np.radians(elevation)
    context.set_lights(wlk.make("WlkLight", direction=(0, np.sin(sun), -np.cos(sun)),
                                irradiance=(1, 1, 1)))
    radiance, _ = context.sky((0, 2, 0), dome)
    radiance[radius > 1] = 0
    exposure = 1 / np.percentile(radiance[radius <= 1], 97)
    panel.imshow(np.clip(1 - np.exp(-1.5 * exposure * radiance), 0, 1) ** (1 / 2.2))
    panel.set_title(f"sun at {elevation} degrees, exposure {exposure:.3g}", fontsize=9)
    panel.axis("off")
figure.tight_layout()
figure.savefig(folder / "sky.png", dpi=110)

# %% Numbers: what falls on the ground
for elevation in (60, 20, 3):
    sun = np.radians(elevation)
    context.set_lights(wlk.make("WlkLight", direction=(0, np.sin(sun), -np.cos(sun)),
                                irradiance=(1, 1, 1)))
    direct, diffuse = context.irradiance((0, 2, 0), (0, 1, 0))
    print(f"sun at {elevation:2} degrees: direct {np.round(direct, 3)}, sky {np.round(diffuse, 3)}")
context.close()
