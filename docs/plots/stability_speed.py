# SPDX-License-Identifier: GPL-3.0-or-later
"""Error of the factor of safety against CPU seconds, from the table of bench_stability.

    bench_stability > table.csv && python3 docs/plots/stability_speed.py table.csv picture.png
"""

import csv
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's colours, with a marker each: told apart without colour, too.
LOOKS = {
    "psi = 0": ("#0072B2", "o", "-"),
    "psi = phi": ("#D55E00", "s", "--"),
    "paper": ("#009E73", "^", ":"),
}


def main(table, picture):
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = list(dict.fromkeys(r["row"] for r in rows))
    columns = 5
    figure, axes = plt.subplots(
        math.ceil(len(names) / columns), columns, figsize=(13, 5.6), sharex=True, sharey=True
    )
    for name, ax in zip(names, axes.flat):
        ax.axhspan(-2.5, 2.5, color="0.92")
        ax.axhline(0, color="0.5", linewidth=0.8)
        for look, (colour, marker, line) in LOOKS.items():
            points = [
                r for r in rows
                if r["row"] == name and r["formulation"] == look and math.isfinite(float(r["F"]))
            ]
            if not points:
                continue
            seconds = [float(r["cpu_s"]) for r in points]
            reference = float(points[0]["reference"])
            error = [100 * (float(r["F"]) / reference - 1) for r in points]
            down = [100 * (float(r["F"]) - float(r["low"])) / reference for r in points]
            up = [100 * (float(r["high"]) - float(r["F"])) / reference for r in points]
            ax.errorbar(seconds, error, yerr=[down, up], color=colour, marker=marker, linestyle=line,
                        markersize=5, linewidth=1.3, elinewidth=0.7, capsize=2, label=look)
        ax.set_title(name, fontsize=10)
        ax.set_xscale("log")
        ax.set_ylim(-12, 12)
        ax.grid(True, linewidth=0.3)
    for ax in axes[-1]:
        ax.set_xlabel("CPU time [s]")
    for ax in axes[:, 0]:
        ax.set_ylabel("F against reference [%]")
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, frameon=False)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:3])
