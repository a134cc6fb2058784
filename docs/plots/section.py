"""What every figure shares: the section as drawn, pools, axes, colours; where it is saved."""

import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Polygon

# Okabe and Ito's colours: told apart by colour-blind readers too.
BLUE, SKY, ORANGE, GREEN, GREY = "#0072B2", "#56B4E9", "#D55E00", "#009E73", "#666666"
PURPLE, YELLOW = "#CC79A7", "#F0E442"


def pool_polygon(ground, level, side, crest=None):
    """Water on the ground from one end of the section to the first point above the level, or to the
    crest that it runs over."""
    ground = ground if side == "left" else ground[::-1]
    wet = [ground[0]]
    for a, b in zip(ground[:-1], ground[1:]):
        if crest and level > crest[1] and a[0] == crest[0] and a[1] == crest[1]:
            break
        if b[1] > level:
            t = (level - a[1]) / (b[1] - a[1])
            wet.append(a + t * (b - a))
            break
        wet.append(b)
    return np.array([[wet[0][0], level], *wet, [wet[-1][0], level]])


def draw_section(ax, result):
    """Outline, pools, true aspect, axes in metres."""
    section = result["section"]
    outline = np.array(section["outline_m"])
    ax.fill(*outline.T, facecolor="none", edgecolor="black", lw=1.2, zorder=5)
    ground = np.array(section["ground_m"])
    for side in ("left", "right"):
        level = section[f"{side}_level_m"]
        if level is not None:
            pool = pool_polygon(ground, level, side, section["overflow_crest_m"])
            ax.fill(*pool.T, facecolor=SKY, alpha=0.35, lw=0, zorder=1)
            surface = pool[[0, -1]]
            ax.plot(*surface.T, color=BLUE, lw=1.2, zorder=1)
    draw_inner_lines(ax, section)
    width = section["x_max_m"] - section["x_min_m"]
    height = section["y_max_m"] - section["y_min_m"]
    ax.set_xlim(section["x_min_m"] - 0.01 * width, section["x_max_m"] + 0.01 * width)
    ax.set_ylim(section["y_min_m"] - 0.06 * height, section["y_max_m"] + 0.10 * height)
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")


def draw_inner_lines(ax, section):
    """Walls thick and black; what water may pass through coloured."""
    looks = {"impervious": ("black", "wall"), "head": (PURPLE, "given head"),
             "seepage_face": (GREEN, "drain"), "inflow": (YELLOW, "inflow")}
    drawn = set()
    for line in section["inner_lines"]:
        colour, label = looks[line["kind"]]
        ax.plot(*np.array(line["line_m"]).T, color=colour, lw=3.2, solid_capstyle="butt", zorder=6,
                label=None if label in drawn else label)
        drawn.add(label)


def figure_for(result):
    """A figure in the section's own proportions, with room for title, legend and colour bar."""
    section = result["section"]
    ratio = (section["y_max_m"] - section["y_min_m"]) / (section["x_max_m"] - section["x_min_m"])
    return plt.subplots(figsize=(11, min(max(11 * ratio + 2.4, 3), 11)), layout="constrained")


def draw_tiles(ax, result, position, volume, values, cmap):
    """Each particle as a rectangle of its own volume, cut off at the outline."""
    width = result["stability"]["spacing_m"]
    half = np.column_stack([np.full(len(volume), width / 2), volume / width / 2])
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    tiles = PolyCollection(position[:, None, :] + corners * half[:, None, :], cmap=cmap,
                           linewidths=0.4, edgecolors="face", zorder=2, rasterized=True)
    tiles.set_array(values)
    ax.add_collection(tiles)
    tiles.set_clip_path(Polygon(np.array(result["section"]["outline_m"]), transform=ax.transData))
    return tiles


def colour_bar(fig, ax, mappable, label):
    bar = fig.colorbar(mappable, ax=ax, orientation="horizontal", shrink=0.6, aspect=40, pad=0.02)
    bar.set_label(label)


def legend_below(ax):
    """Under the axis' own label, where it covers nothing of the section."""
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4.2, ncol=6,
                  frameon=False, fontsize=8)


def command_line(doc):
    """What berm calls each script with: the directory of results, and how to save its figures."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("directory", type=pathlib.Path, help="what berm wrote")
    parser.add_argument("--formats", nargs="+", choices=["png", "svg"], default=["png"])
    return parser


def save(figure, path, formats, **options):
    """One file a format: path.png, path.svg. The same figure gives the same bytes."""
    for name in formats:
        plt.rcParams["svg.hashsalt"] = path.name
        metadata = {"Date": None} if name == "svg" else None
        figure.savefig(f"{path}.{name}", dpi=150, metadata=metadata, **options)
