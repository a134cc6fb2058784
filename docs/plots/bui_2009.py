#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figs. 2 and 3 of Bui et al. (2009) from runs of cases/bui_2009.

    berm run cases/bui_2009/dry.toml && berm run cases/bui_2009/hydrostatic.toml
    cd results && /usr/bin/python3 ../docs/plots/bui_2009.py bui_2009_dry bui_2009_hydrostatic
"""

import argparse
import json
import pathlib

import h5py
import matplotlib.pyplot as plt

from figures import draw_curves, slip_figure


def displacement_figure(results):
    """Fig. 2: convergent and unconvergent trials, one panel for each run."""
    fig, axes = plt.subplots(1, len(results), figsize=(6 * len(results), 4.5), squeeze=False,
                             layout="constrained")
    for ax, result in zip(axes[0], results):
        draw_curves(ax, result)
        stability = result["stability"]
        ax.set_title(f"{result['title'].split(', ')[-1]}: stands at {stability['stands']:.3f}, "
                     f"fails at {stability['fails']:.3f}")
    return fig


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=pathlib.Path, nargs="+", help="results of runs")
    parser.add_argument("--out", type=pathlib.Path, default=".", help="where to put the figures")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    results = [json.loads((run / "result.json").read_text(encoding="utf-8"))
               for run in options.runs]
    displacement_figure(results).savefig(options.out / "bui_2009_fig2.png", dpi=100)
    # Fig. 3: plastic strain at failure, and the critical circle as a dashed line.
    for run, result in zip(options.runs, results):
        with h5py.File(run / "results.h5", "r", locking=False) as fields:
            figure = slip_figure(result, fields)
        if figure is not None:
            name = f"bui_2009_fig3_{run.name.removeprefix('bui_2009_')}.png"
            figure.savefig(options.out / name, dpi=100, bbox_inches="tight")


if __name__ == "__main__":
    main()
