"""What is read of the seepage: head and pore pressure along the lines, exit gradients, heave."""

import csv

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import patheffects

from section import BLUE, GREEN, GREY, ORANGE, PURPLE

MOST_PANELS = 8  # a figure stays readable; all lines and outlets are in the CSV files


def read_csv(path):
    """Columns by name: arrays of numbers, or of text where a column holds text."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    columns = {}
    for name, *cells in zip(*rows):
        try:
            columns[name] = np.array(cells, dtype=float)
        except ValueError:
            columns[name] = np.array(cells)
    return columns


def draw_lines(ax, result):
    """The lines on the section, from a dot to an arrow head."""
    halo = [patheffects.withStroke(linewidth=2.5, foreground="white")]
    for i, line in enumerate(result["seepage"]["lines"]):
        points = np.array(line["points_m"])
        label = "lines" if i == 0 else None
        ax.plot(*points.T, color=PURPLE, lw=1.6, zorder=8, label=label, path_effects=halo)
        ax.plot(*points[0], "o", color=PURPLE, ms=4, zorder=8)
        ax.annotate("", points[-1], points[-2], zorder=8,
                    arrowprops={"arrowstyle": "-|>", "color": PURPLE, "lw": 1.6, "shrinkA": 0,
                                "shrinkB": 0, "mutation_scale": 10})
        ax.annotate(line["name"], points[0], fontsize=8, zorder=9, path_effects=halo,
                    xytext=(4, 4), textcoords="offset points")


def draw_heave(ax, result):
    """Where the factor against heave is least."""
    heave = result["seepage"]["heave"]
    if heave["factor"] is None:
        return
    column, surface = heave["column"], heave["surface"]
    worst = min((h for h in (column, surface) if h), key=lambda h: h["factor"])
    x, y = worst["at_m"]
    label = f"least factor against heave, {heave['factor']:.2f}"
    ax.plot(x, y, "v", color=ORANGE, mec="black", mew=0.6, ms=8, zorder=9, label=label)
    if "depth_m" in worst:
        ax.plot([x, x], [y, y - worst["depth_m"]], color=ORANGE, lw=2, zorder=8)


def lines_figure(result, directory):
    """Head and pore pressure along each line."""
    lines = result["seepage"]["lines"][:MOST_PANELS]
    if not lines:
        return None
    fig, panels = plt.subplots(len(lines), 2, figsize=(10, 0.8 + 2.6 * len(lines)), squeeze=False,
                               layout="constrained")
    for (left, right), line in zip(panels, lines):
        table = read_csv(directory / line["file"])
        distance, pressure = table["distance_m"], table["pore_pressure_kPa"]
        left.plot(distance, table["head_m"], color=BLUE, lw=1.8, label="hydraulic head")
        left.plot(distance, table["y_m"], color=GREY, lw=1.2, ls="--", label="height of the line")
        left.set_ylabel("head, height [m]")
        left.set_title(f"{line['name']}: {line['discharge_m2_s']:.4g} m²/s to its left", fontsize=10)
        left.legend(fontsize=8)
        right.plot(distance, pressure, color=BLUE, lw=1.8)
        right.fill_between(distance, 0, np.maximum(pressure, 0), color=BLUE, alpha=0.15, lw=0)
        right.axhline(0, color="black", lw=0.8)
        right.set_ylabel("pore pressure [kPa]")
        force = line["water_force"]
        push = float(np.hypot(*force["force_kN_m"]))
        right.set_title(f"water pushes with {push:.1f} kN/m", fontsize=10)
        if force["distance_m"] is not None:
            right.axvline(force["distance_m"], color=ORANGE, lw=1.4, ls=":",
                          label=f"centre, {force['distance_m']:.4g} m")
            right.legend(fontsize=8)
        for ax in (left, right):
            ax.set_xlabel("distance along the line [m]")
            ax.set_xlim(distance[0], distance[-1])
            ax.grid(alpha=0.3)
    fig.suptitle(result["title"])
    return fig


def exit_gradient_figure(result, directory):
    """Gradient along the outside normal where water leaves, with the critical one."""
    outlets = result["seepage"]["exit_gradients"][:MOST_PANELS]
    if not outlets:
        return None
    table = read_csv(directory / "exit_gradients.csv")
    fig, panels = plt.subplots(len(outlets), 1, figsize=(9, 0.8 + 3 * len(outlets)), squeeze=False,
                               layout="constrained")
    for number, (ax, outlet) in enumerate(zip(panels[:, 0], outlets), 1):
        mine = table["outlet"] == number
        distance, gradient = table["distance_m"][mine], table["normal_gradient"][mine]
        critical = table["critical_gradient"][mine]
        counts = table["counts"][mine] == 1
        ax.plot(distance, np.where(counts, gradient, np.nan), color=BLUE, lw=1.8,
                label="gradient along the outside normal")
        upward = table["upward_gradient"][mine]
        if np.any(counts & (np.abs(upward - gradient) > 1e-6)):
            ax.plot(distance, np.where(counts, upward, np.nan), color=GREEN, lw=1.4, ls="-.",
                    label="upwards")
        ax.plot(distance, critical, color=ORANGE, lw=1.6, ls="--", label="critical gradient γ'/γw")
        if not counts.all():
            ax.plot(distance, np.where(counts, np.nan, gradient), ".", color=GREY, ms=4,
                    label="beside a singularity: does not count")
        top = max(np.max(critical), np.max(gradient, where=counts, initial=0))
        bottom = min(0, np.min(upward, where=counts, initial=0), np.min(critical))
        ax.set_ylim(1.1 * bottom, 1.15 * top)
        ax.set_xlim(distance[0], distance[-1])
        ax.set_xlabel("distance along the outlet [m]")
        ax.set_ylabel("hydraulic gradient [-]")
        found = outlet["gradient"]
        answer = "" if found is None else f": {found:.3f} at ({outlet['at_m'][0]:.2f}, " \
                                          f"{outlet['at_m'][1]:.2f})"
        start, end = ("({:.4g}, {:.4g})".format(*outlet[key]) for key in ("from_m", "to_m"))
        ax.set_title(f"{outlet['stretch']}{answer}; from {start} to {end} m", fontsize=10)
        ax.grid(alpha=0.3)
        ax.legend(fontsize=8)
    fig.suptitle(result["title"])
    return fig
