#!/usr/bin/python3
"""Draw comparison.png: the slip lines and water lines of each water on one section, and the seepage
pressure minus the assumed one in the soil.

    /usr/bin/python3 docs/plots/comparison.py DIR

DIR is what `berm compare` wrote: comparison.json, and a run in each of its folders.
"""

import json
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Polygon, Rectangle

from section import BLUE, GREY, ORANGE, PURPLE, colour_bar, draw_section

LOOKS = {"seepage": (BLUE, "-"), "phreatic": (PURPLE, "--"), "hydrostatic": (ORANGE, "-."),
         "dry": (GREY, ":")}


def slip_lines(ax, comparison, results):
    """One line each, with its factor."""
    for water in comparison["waters"]:
        result = results[water["name"]]
        mechanism = result.get("stability", {}).get("mechanism")
        colour, style = LOOKS[water["name"]]
        answer = f"F = {water['factor']:.3f}" if water["complete"] else "undecided"
        line = np.array(mechanism["slip_line_m"]) if mechanism else np.empty((0, 2))
        ax.plot(*line.T, color=colour, ls=style, lw=2.4, zorder=7,
                label=f"{water['title']}: {answer}")


def water_lines(ax, results):
    """Thin: the phreatic line, and the line that was assumed."""
    for line in results["seepage"]["seepage"]["phreatic_lines_m"]:
        ax.plot(*np.array(line).T, color=BLUE, lw=1.1, zorder=6)
    if "hydrostatic" in results:
        line = np.array(results["hydrostatic"]["stability"]["free_surface_m"])
        ax.plot(*line.T, color=ORANGE, lw=1.1, zorder=6)


def pressures(directory, name):
    """Position, volume and pore pressure of the particles."""
    with h5py.File(directory / name / "results.h5", "r", locking=False) as fields:
        particles = fields["particles"]
        return [particles[key][()] for key in ("position", "volume", "pore_pressure")]


def pressure_map(fig, ax, directory, other, results):
    """Seepage minus the other pressure, in a scale about zero."""
    position, volume, seepage = pressures(directory, "seepage")
    difference = (seepage - pressures(directory, other)[2]) / 1e3
    width = results["seepage"]["stability"]["spacing_m"]
    boxes = [Rectangle((x - width / 2, y - v / width / 2), width, v / width)
             for (x, y), v in zip(position, volume)]
    tiles = PatchCollection(boxes, cmap="PuOr_r", linewidths=0.4, edgecolors="face", zorder=2)
    tiles.set_array(difference)
    largest = np.abs(difference).max() or 1
    tiles.set_clim(-largest, largest)
    ax.add_collection(tiles)
    draw_section(ax, results["seepage"])
    tiles.set_clip_path(Polygon(np.array(results["seepage"]["section"]["outline_m"]),
                                transform=ax.transData))
    colour_bar(fig, ax, tiles, f"seepage minus {other} pore pressure [kPa]")


def main(directory):
    comparison = json.loads((directory / "comparison.json").read_text(encoding="utf-8"))
    results = {w["name"]: json.loads((directory / w["directory"] / "result.json").read_text("utf-8"))
               for w in comparison["waters"]}
    section = results["seepage"]["section"]
    ratio = (section["y_max_m"] - section["y_min_m"]) / (section["x_max_m"] - section["x_min_m"])
    others = [n for n in ("hydrostatic", "phreatic") if n in results]
    rows = 1 + (1 if others else 0)
    fig, axes = plt.subplots(rows, squeeze=False, layout="constrained",
                             figsize=(11, min(max(11 * ratio + 2, 3), 11) * rows))
    draw_section(axes[0, 0], results["seepage"])
    water_lines(axes[0, 0], results)
    slip_lines(axes[0, 0], comparison, results)
    axes[0, 0].legend(loc="upper right", framealpha=0.9, fontsize=8)
    axes[0, 0].set_title(comparison["title"])
    if others:
        pressure_map(fig, axes[1, 0], directory, others[0], results)
        water_lines(axes[1, 0], results)
    fig.savefig(directory / "comparison.png", dpi=150, bbox_inches="tight")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
