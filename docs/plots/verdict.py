#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Courses of trials around the knee, measure by measure: docs/figures/verdict.png.

    bench_verdict courses.json && /usr/bin/python3 docs/plots/verdict.py courses.json
"""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from section import BLUE, GREY, ORANGE

SHOWN = (("F-1 straight line", 40), ("F-2", 40))  # row, particles over the slope's height
MEASURES = (
    (0, "velocity\nmeasure s [-]", "log"),
    (1, "largest displacement\n/ d_ref [-]", "log"),
    (3, "kinetic / elastic\nenergy [-]", "log"),
    (4, "growth of plastic strain\nin a window / (γH/E) [-]", "log"),
    (5, "height of connected\nplastic zone / H [-]", "linear"),
)
STYLES = {
    "stands": (BLUE, "-", "comes to rest"),
    "fails": (ORANGE, "--", "moves on beyond 8 d_ref"),
    "creeps": (GREY, ":", "neither after 240 T0"),
}


def draw(ax, courses, measure, scale):
    """One measure of all courses of a row; the verdict as a dot."""
    for course in courses:
        windows = course["windows"]
        colour, style, label = STYLES[course["end"]]
        time = range(1, len(windows) + 1)
        values = [window[measure] for window in windows]
        ax.plot(time, values, style, color=colour, lw=1.3, alpha=0.85, label=label)
        when = course["after"]
        wrong = course["end"] != "creeps" and course["end"] != course["verdict"]
        ax.plot(when, values[when - 1], "X" if wrong else "o", color="black" if wrong else colour,
                ms=8 if wrong else 4, mec="white", mew=0.6, zorder=5,
                label="verdict, wrong" if wrong else "verdict")
    ax.set_xscale("log")
    ax.set_yscale(scale)
    ax.grid(alpha=0.3)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("courses", type=pathlib.Path, help="what bench_verdict wrote")
    parser.add_argument("--out", type=pathlib.Path, default="verdict.png")
    options = parser.parse_args()
    courses = json.loads(options.courses.read_text(encoding="utf-8"))["courses"]
    fig, axes = plt.subplots(len(MEASURES), len(SHOWN), figsize=(11, 13), sharex="col",
                             sharey="row", layout="constrained")
    labels = {}
    for column, (row, count) in zip(axes.T, SHOWN):
        shown = [c for c in courses if c["row"] == row and c["H_over_dx"] == count]
        for ax, (measure, name, scale) in zip(column, MEASURES):
            draw(ax, shown, measure, scale)
            ax.set_ylabel(name if ax in axes[:, 0] else "")
            for handle, label in zip(*ax.get_legend_handles_labels()):
                labels.setdefault(label, handle)
        column[0].axhline(1e-3, color=GREY, lw=0.8)
        column[0].set_ylim(8e-5, 0.2)
        column[1].axhline(4, color=GREY, lw=0.8)
        column[2].set_ylim(1e-8, 0.1)
        column[3].set_ylim(1e-5, 0.3)
        column[0].set_title(f"{row}, H/dx = {count}: F less and plus 0.25 to 5 %")
        column[-1].set_xlabel("time since the strength was reduced [T0]")
    axes[1, 0].legend(labels.values(), labels.keys(), fontsize=9)
    fig.savefig(options.out, dpi=90)


if __name__ == "__main__":
    main()
