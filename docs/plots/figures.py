#!/usr/bin/python3
"""Draw a run beside its result.json and results.h5: seepage.png, lines.png, exit_gradient.png,
slip.png, trials.png, curves.png, and of a run-out run_out.png, run_out_energy.png and run_out.gif.

    /usr/bin/python3 docs/plots/figures.py DIR [--out DIR] [--formats png svg]

A figure whose stage the run does not have is not drawn. Needs numpy, h5py and matplotlib
(Debian: python3-numpy python3-h5py python3-matplotlib).
"""

import json
import pathlib

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

import readings
import run_out
from section import (BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, YELLOW, colour_bar, command_line,
                     draw_section, draw_tiles, figure_for, legend_below, save)


def draw_water_line(ax, result):
    """The phreatic line of the seepage solve, or the given line of the hydrostatic mode."""
    lines = result.get("seepage", {}).get("phreatic_lines_m", [])
    label = "phreatic line"
    if not lines and result.get("stability", {}).get("free_surface_m"):
        lines, label = [level_beyond_ends(result)], "free surface (given)"
    for i, line in enumerate(lines):
        ax.plot(*np.array(line).T, color="white", lw=3.5, zorder=6)
        ax.plot(*np.array(line).T, color=BLUE, lw=2, zorder=7, label=label if i == 0 else None)


def level_beyond_ends(result):
    """The hydrostatic line goes on level beyond its ends, as far as there is ground above it."""
    line = np.array(result["stability"]["free_surface_m"])
    section = result["section"]
    x = np.linspace(section["x_min_m"], section["x_max_m"], 2000)
    y = np.interp(x, *line.T)
    ground = np.array(section["ground_m"])
    inside = y <= np.interp(x, *ground.T) + 1e-9
    return np.column_stack([x, y])[inside]


def seepage_figure(result, fields):
    """Head, phreatic line and flow net."""
    fig, ax = figure_for(result)
    x, y = fields["mesh/nodes"][()].T
    triangles = fields["mesh/triangles"][()]
    head, pressure = fields["mesh/head"][()], fields["mesh/pore_pressure"][()]
    # Above the phreatic line there is no flow to speak of: it stays grey.
    ax.fill(*np.array(result["section"]["outline_m"]).T, facecolor="#e6e6e6", lw=0, zorder=0)
    wet = pressure[triangles].max(axis=1) > 0
    levels = head_levels(head[np.unique(triangles[wet])])
    net = Triangulation(x, y, triangles[wet])
    filled = ax.tricontourf(net, head, levels=levels, cmap="Blues", alpha=0.75)
    draw_flow_net(ax, result, net, fields, levels)
    draw_section(ax, result)
    draw_water_line(ax, result)
    exit_point = result["seepage"]["exit_point_m"]
    if exit_point:
        ax.plot(*exit_point, "o", color=ORANGE, ms=6, zorder=7, label="exit point")
    probes = result["seepage"]["probes"]
    if probes:
        at = np.array([[p["x_m"], p["y_m"]] for p in probes])
        ax.plot(*at.T, "+", color=ORANGE, ms=7, mew=1.5, zorder=7, label="probes")
    readings.draw_lines(ax, result)
    readings.draw_heave(ax, result)
    q = result["seepage"]["discharge_m2_s"]
    ax.set_title(f"{result['title']}\ndischarge {q:.4g} m²/s per metre run")
    legend_below(ax)
    colour_bar(fig, ax, filled, "hydraulic head [m]")
    return fig


def head_levels(head):
    """About twenty round levels; a few about the value where the water stands still."""
    low, high = head.min(), head.max()
    if high - low < 1e-6 * max(abs(high), 1):
        return np.linspace(low - 0.5, high + 0.5, 5)
    return MaxNLocator(nbins=20).tick_values(low, high)


STREAM_TUBES = 5


def draw_flow_net(ax, result, net, fields, levels):
    """Equipotentials in equal drops, dashed; stream lines between equal tubes, solid, with an arrow.
    Where water passes through a line in the soil there is no stream function to draw."""
    head = fields["mesh/head"][()]
    q = result["seepage"]["discharge_m2_s"]
    drop = levels[1] - levels[0]
    ax.tricontour(net, head, levels=levels, colors="black", linewidths=0.6, linestyles=[(0, (4, 3))],
                  zorder=3)
    ax.plot([], [], color="black", lw=0.6, ls=(0, (4, 3)), label=f"equipotentials, drop {drop:.4g} m")
    if q == 0 or "stream_function" not in fields["mesh"]:
        return
    psi = fields["mesh/stream_function"][()]
    tube = q / STREAM_TUBES
    lines = ax.tricontour(net, psi, levels=tube * np.arange(1, STREAM_TUBES), colors="black",
                          linewidths=1.1, linestyles="solid", zorder=4)
    ax.plot([], [], color="black", lw=1.1, label=f"stream lines, tube {tube:.3g} m²/s")
    centres = fields["mesh/nodes"][()][fields["mesh/triangles"][()]].mean(axis=1)
    flux = fields["mesh/flux"][()][:, :2]
    for level in lines.allsegs:
        for line in level:
            add_arrow(ax, line, centres, flux)


def add_arrow(ax, line, centres, flux):
    """An arrow head in the middle of a stream line, with the flow; none on mere specks."""
    way = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    if way[-1] < 0.05 * np.ptp(ax.dataLim.intervalx):
        return
    before, middle, after = (np.array([np.interp(t * way[-1], way, x) for x in line.T])
                             for t in (0.47, 0.5, 0.53))
    if flux[np.argmin(((centres - middle) ** 2).sum(axis=1))] @ (after - before) < 0:
        before, after = after, before
    along = (after - before) / max(np.hypot(*(after - before)), 1e-300)
    ax.annotate("", middle + 1e-3 * along, middle, zorder=4,
                arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 1.1, "shrinkA": 0,
                            "shrinkB": 0, "mutation_scale": 11})


def where_reduced(stability):
    """Which of several searches governs, and is drawn."""
    return f" ({stability['region']})" if "searches" in stability else ""


def draw_regions(ax, stability):
    """Outlines of where the strength is reduced, and of where it is not."""
    for key, style in (("search_region_m", "-"), ("exclude_region_m", ":")):
        for i, polygon in enumerate(stability[key]):
            label = {"-": "search region", ":": "excluded"}[style] if i == 0 else None
            closed = np.array([*polygon, polygon[0]])
            ax.plot(*closed.T, style, color=GREEN, lw=1.4, zorder=5, label=label)


def draw_slip_lines(ax, stability):
    """Slip line and critical circle of every search, the governing one last and strongest."""
    searches = stability.get("searches", [stability])
    others = [s for s in searches if s["region"] != stability["region"]]
    colours = iter([PURPLE, GREEN, YELLOW])
    for search in [*others, stability]:
        governs = search is stability
        colour = ORANGE if governs else next(colours)
        where = "" if len(searches) == 1 else f", {search['region']}"
        if where and search["complete"]:
            where += f": F = {search['factor']:.3f}"
        if search["mechanism"]:
            line = np.array(search["mechanism"]["slip_line_m"])
            ax.plot(*line.T, color="white", lw=4 if governs else 3, zorder=6)
            ax.plot(*line.T, color=colour, lw=2 if governs else 1.5, zorder=7,
                    label=f"slip line{where}")
        circle = search["limit_equilibrium"]
        if circle:
            x = np.linspace(circle["x_left_m"], circle["x_right_m"], 200)
            (x_c, y_c), radius = circle["centre_m"], circle["radius_m"]
            y = y_c - np.sqrt(np.maximum(radius**2 - (x - x_c) ** 2, 0))
            ax.plot(x, y, color="0.75" if governs else colour, lw=1.5, ls="--", zorder=6,
                    label=f"critical circle (Bishop {circle['bishop']:.3f})")


def slip_figure(result, fields):
    """Plastic strain where the slope fails, the slip line through it, and the water."""
    stability = result["stability"]
    name = next((n for n in ("failing", "standing") if n in fields["particles"]), None)
    if name is None:
        return None
    fig, ax = figure_for(result)
    position = fields["particles/position"][()]
    volume = fields["particles/volume"][()]
    strain = fields[f"particles/{name}/plastic_strain"][()]
    factor = fields[f"particles/{name}"].attrs["factor"]
    tiles = draw_tiles(ax, result, position, volume, strain, "cividis")
    top = np.quantile(strain, 0.995)
    tiles.set_clim(0, top if top > 0 else 1)
    draw_section(ax, result)
    draw_water_line(ax, result)
    draw_regions(ax, stability)
    draw_slip_lines(ax, stability)
    found = stability["factor"]
    answer = f"F = {found:.3f}" if stability["complete"] else "factor of safety undecided"
    answer += where_reduced(stability)
    ax.set_title(f"{result['title']}\n{answer}; drawn: strength / {factor:.4g}, {name}")
    legend_below(ax)
    colour_bar(fig, ax, tiles, "equivalent plastic strain [-]")
    return fig


def trials_figure(result):
    """Every trial: how far the soil moved, and what was made of it."""
    stability = result["stability"]
    trials = [t for t in stability["trials"] if not t["interrupted"]]
    if not trials:
        return None
    fig, ax = plt.subplots(figsize=(7, 4.5), layout="constrained")
    looks = {"stands": ("o", GREEN), "fails": ("X", ORANGE), "undecided": ("D", GREY)}
    moved = sorted((t["factor"], t["max_displacement_m"]) for t in trials)
    ax.plot(*np.array(moved).T, color="#bbbbbb", lw=1, zorder=1)
    for outcome, (marker, colour) in looks.items():
        some = [(t["factor"], t["max_displacement_m"]) for t in trials if t["outcome"] == outcome]
        if some:
            ax.plot(*np.array(some).T, marker, color=colour, ms=9, mec="black", mew=0.6,
                    label=outcome, zorder=3)
    if stability["stands"] is not None and stability["fails"] is not None:
        label = f"bracket {stability['stands']:.3f} to {stability['fails']:.3f}"
        ax.axvspan(stability["stands"], stability["fails"], color=SKY, alpha=0.5, lw=0, label=label)
    if min(d for _, d in moved) > 0 and max(d for _, d in moved) > 30 * min(d for _, d in moved):
        ax.set_yscale("log")
    else:
        ax.set_ylim(bottom=0)
    ax.set_xlabel("trial factor on strength [-]")
    ax.set_ylabel("largest displacement at the end of the trial [m]")
    found = stability["factor"]
    answer = f"F = {found:.3f}" if stability["complete"] else "factor of safety undecided"
    ax.set_title(f"{result['title']}: {answer}{where_reduced(stability)}")
    ax.grid(alpha=0.3)
    ax.legend()
    return fig


def draw_curves(ax, result):
    """Every trial: largest displacement over time. It levels off, or keeps growing."""
    stability = result["stability"]
    trials = sorted(stability["trials"], key=lambda t: t["factor"])
    trials = [t for t in trials if t["history"]["time_s"]]
    looks = {"stands": (GREEN, "-"), "fails": (ORANGE, "--"), "undecided": (GREY, ":")}
    end = 1.15 * max(t["history"]["time_s"][-1] for t in trials)
    for trial in trials:
        colour, style = looks[trial["outcome"]]
        time = np.array([0, *trial["history"]["time_s"]])
        moved = np.array([0, *trial["history"]["max_displacement_m"]])
        bracket = trial["factor"] in (stability["stands"], stability["fails"])
        ax.plot(time, moved, style, color=colour, lw=2.4 if bracket else 1.2)
        if trial["outcome"] == "stands":
            ax.plot([time[-1], end], [moved[-1]] * 2, color=colour, lw=0.6, alpha=0.6)
        ax.annotate(f"{trial['factor']:.4g}", (time[-1], moved[-1]), color=colour, fontsize=8,
                    xytext=(3, 2), textcoords="offset points")
    for outcome, (colour, style) in looks.items():
        if any(t["outcome"] == outcome for t in trials):
            ax.plot([], [], style, color=colour, label=outcome)
    ax.set_xlim(0, end)
    ax.set_ylim(bottom=0)
    ax.set_xlabel("time since the strength was reduced [s]")
    ax.set_ylabel("largest displacement [m]")
    ax.grid(alpha=0.3)
    ax.legend(loc="upper left")


def curves_figure(result):
    """The course of every trial, with its factor at its end."""
    if not any(t["history"]["time_s"] for t in result["stability"]["trials"]):
        return None
    fig, ax = plt.subplots(figsize=(7.5, 5), layout="constrained")
    draw_curves(ax, result)
    ax.set_title(result["title"] + where_reduced(result["stability"]))
    return fig


def main():
    parser = command_line(__doc__)
    parser.add_argument("--out", type=pathlib.Path, help="where to put the figures [beside them]")
    options = parser.parse_args()
    out = options.out or options.directory
    result = json.loads((options.directory / "result.json").read_text(encoding="utf-8"))
    with h5py.File(options.directory / "results.h5", "r", locking=False) as fields:
        figures = {
            "seepage": seepage_figure(result, fields) if "mesh" in fields else None,
            "slip": slip_figure(result, fields) if "particles" in fields else None,
            "trials": trials_figure(result) if "stability" in result else None,
            "curves": curves_figure(result) if "stability" in result else None,
        }
    if "seepage" in result:
        figures["lines"] = readings.lines_figure(result, options.directory)
        figures["exit_gradient"] = readings.exit_gradient_figure(result, options.directory)
    if "runout" in result and run_out.frame_paths(options.directory):
        figures["run_out"] = run_out.final_shape_figure(result, options.directory)
        figures["run_out_energy"] = run_out.energy_figure(result)
        run_out.animation(result, options.directory, out / "run_out.gif")
    for name, figure in figures.items():
        if figure is not None:
            save(figure, out / name, options.formats, bbox_inches="tight")


if __name__ == "__main__":
    main()
