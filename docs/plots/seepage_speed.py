# SPDX-License-Identifier: GPL-3.0-or-later
"""Error of the discharge against CPU seconds, from the table of bench_seepage.

    bench_seepage > table.csv && python3 docs/plots/seepage_speed.py table.csv picture.png
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# Okabe and Ito's colours, with a marker each: told apart without colour, too.
LOOKS = {"uniform": ("#D55E00", "s", "--"), "adaptive": ("#0072B2", "o", "-")}


def main(table, picture):
    with open(table, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = list(dict.fromkeys(r["row"] for r in rows))
    figure, axes = plt.subplots(1, len(names), figsize=(13, 3.8), sharey=True)
    for name, ax in zip(names, axes):
        for look, (colour, marker, line) in LOOKS.items():
            points = [r for r in rows if r["row"] == name and r["meshes"] == look]
            seconds = [float(r["cpu_s"]) for r in points]
            error = [max(abs(float(r["error_percent"])), 1e-3) for r in points]
            ax.plot(seconds, error, color=colour, marker=marker, linestyle=line, label=look)
            if look == "adaptive":
                told = [(s, float(r["estimated_percent"])) for s, r in zip(seconds, points)]
                ax.plot(*zip(*told), color=colour, marker="x", linestyle=":", label="its estimate")
        ax.set_title(name, fontsize=10)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("CPU time [s]")
        ax.grid(True, linewidth=0.3)
    axes[0].set_ylabel("error of the discharge [%]")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:3])
