#!/usr/bin/python3
"""Draw comparison.png: the slip lines and water lines of each water on one section, the seepage
pressure minus the assumed one in the soil, the seepage force, and the pressure of each water along
the slip line under seepage.

    /usr/bin/python3 docs/plots/comparison.py DIR [--formats png svg]

DIR is what `berm compare` wrote: comparison.json, and a run in each of its folders.
"""

import json

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from section import (BLUE, GREY, ORANGE, PURPLE, colour_bar, command_line, draw_section, draw_tiles,
                     save)

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
    tiles = draw_tiles(ax, results["seepage"], position, volume, difference, "PuOr_r")
    largest = np.abs(difference).max() or 1
    tiles.set_clim(-largest, largest)
    draw_section(ax, results["seepage"])
    water_lines(ax, results)
    colour_bar(fig, ax, tiles, f"seepage minus {other} pore pressure [kPa]")


WATER_UNIT_WEIGHT = 9.81  # [kN/m3]
ARROWS = 56  # along the section


def force_map(fig, ax, directory, result):
    """Seepage force, the unit weight of water times the hydraulic gradient, where the soil is wet."""
    with h5py.File(directory / "seepage" / "results.h5", "r", locking=False) as fields:
        x, y = fields["mesh/nodes"][()].T
        net = Triangulation(x, y, fields["mesh/triangles"][()])
        head = LinearTriInterpolator(net, fields["mesh/head"][()])
        pressure = LinearTriInterpolator(net, fields["mesh/pore_pressure"][()])
    section = result["section"]
    step = (section["x_max_m"] - section["x_min_m"]) / ARROWS
    at = np.meshgrid(np.arange(section["x_min_m"] + step / 2, section["x_max_m"], step),
                     np.arange(section["y_min_m"] + step / 2, section["y_max_m"], step))
    wet = np.ma.filled(pressure(*at) > 0, False)
    at = [a[wet] for a in at]
    force = -WATER_UNIT_WEIGHT * np.ma.filled(head.gradient(*at), 0)
    size = np.hypot(*force)
    top = np.quantile(size, 0.99) if size.size and size.max() > 0 else 1
    arrows = ax.quiver(*at, *force, size, cmap="viridis_r", angles="xy", scale_units="xy",
                       scale=top / (1.3 * step), width=0.0016, zorder=4)
    arrows.set_clim(0, top)
    draw_section(ax, result)
    colour_bar(fig, ax, arrows, "seepage force [kN/m³]; longest arrow as the scale's end")


def along_slip_line(ax, comparison, directory, results):
    """Pore pressure of each water along the slip line under seepage, between the particles."""
    mechanism = results["seepage"].get("stability", {}).get("mechanism")
    if not mechanism:
        ax.set_axis_off()
        return
    line = np.array(mechanism["slip_line_m"])
    way = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0, way[-1], 200)
    points = np.column_stack([np.interp(at, way, c) for c in line.T])
    for water in comparison["waters"]:
        position, _, pressure = pressures(directory, water["name"])
        on_line = LinearTriInterpolator(Triangulation(*position.T), pressure / 1e3)(*points.T)
        colour, style = LOOKS[water["name"]]
        ax.plot(at, on_line, color=colour, ls=style, lw=1.8, label=water["title"])
    ax.set_xlabel("distance along the slip line under seepage, from uphill [m]")
    ax.set_ylabel("pore pressure [kPa]")
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8)


def main(directory, formats):
    comparison = json.loads((directory / "comparison.json").read_text(encoding="utf-8"))
    results = {w["name"]: json.loads((directory / w["directory"] / "result.json").read_text("utf-8"))
               for w in comparison["waters"]}
    section = results["seepage"]["section"]
    ratio = (section["y_max_m"] - section["y_min_m"]) / (section["x_max_m"] - section["x_min_m"])
    particles = "stability" in results["seepage"]
    others = [n for n in ("hydrostatic", "phreatic") if n in results] if particles else []
    plain = min(max(10 * ratio * 1.16 + 0.2, 1.8), 10)  # height of a panel [in]
    heights = [*[plain + 0.6] * (3 if others else 2), *([3.2] if particles else [])]
    fig, axes = plt.subplots(len(heights), layout="constrained", height_ratios=heights,
                             figsize=(11, sum(heights) + 0.8))
    rest = iter(axes)
    top = next(rest)
    draw_section(top, results["seepage"])
    water_lines(top, results)
    slip_lines(top, comparison, results)
    top.legend(loc="upper right", framealpha=0.9, fontsize=8)
    top.set_title(comparison["title"])
    if others:
        pressure_map(fig, next(rest), directory, others[0], results)
    force_map(fig, next(rest), directory, results["seepage"])
    if particles:
        along_slip_line(next(rest), comparison, directory, results)
    save(fig, directory / "comparison", formats)


if __name__ == "__main__":
    options = command_line(__doc__).parse_args()
    main(options.directory, options.formats)
