"""Figures of a run-out: the final shape, the energies over time, and the motion as an animation."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.collections import EllipseCollection

from section import BLUE, GREEN, GREY, ORANGE, colour_bar, draw_section, figure_for, legend_below


def frame_paths(directory):
    """Files of the frames, in the order of time."""
    return sorted((directory / "run_out").glob("frame_*.h5"))


def read_frame(path):
    """Position, total displacement and time of one frame."""
    with h5py.File(path, "r", locking=False) as frame:
        moved = frame["displacement"][()]
        return frame["position"][()], np.hypot(moved[:, 0], moved[:, 1]), frame.attrs["time_s"]


def draw_soil(ax, result, position, moved, highest):
    """Particles as discs as wide as their spacing, coloured by how far they moved."""
    width = np.full(len(position), result["stability"]["spacing_m"] * 1.25)
    soil = EllipseCollection(width, width, np.zeros(len(position)), units="xy", offsets=position,
                             transOffset=ax.transData, cmap="cividis", linewidths=0, zorder=2,
                             rasterized=True)
    soil.set_array(moved)
    soil.set_clim(0, highest if highest > 0 else 1)
    ax.add_collection(soil)
    draw_section(ax, result)
    left, right = ax.get_xlim()
    pad = 0.01 * (right - left)
    ax.set_xlim(min(left, position[:, 0].min() - pad), max(right, position[:, 0].max() + pad))
    return soil


def final_shape_figure(result, directory):
    """The soil at the end by total displacement, its surface, and the section as it was."""
    position, moved, time = read_frame(frame_paths(directory)[-1])
    run_out = result["runout"]
    fig, ax = figure_for(result)
    soil = draw_soil(ax, result, position, moved, moved.max())
    surface = np.array(run_out["surface_m"])
    ax.plot(*surface.T, color=ORANGE, lw=1.6, zorder=6, label="surface at the end")
    if run_out["tip_m"]:
        ax.plot(*run_out["toe_m"], "^", color=BLUE, ms=7, mec="white", zorder=8, label="toe as drawn")
        ax.plot(*run_out["tip_m"], "v", color=ORANGE, ms=7, mec="white", zorder=8, label="tip")
    end = f"at rest since {run_out['time_to_rest_s']:.3g} s" if run_out["at_rest"] else \
        f"STILL MOVING at {time:.3g} s"
    far = "" if run_out["run_out_m"] is None else f"; run-out {run_out['run_out_m']:.2f} m"
    ax.set_title(f"{result['title']}\nstrength / {run_out['factor']:.4g}, {end}{far}")
    legend_below(ax)
    colour_bar(fig, ax, soil, "total displacement [m]")
    return fig


def energy_figure(result):
    """Where the energy is and where it went, and how far the balance is off."""
    history = result["runout"]["history"]
    time = np.array([m["time_s"] for m in history])
    column = lambda name: np.array([m[name] for m in history]) / 1e3
    fig, (ax, below) = plt.subplots(2, 1, figsize=(7, 6), height_ratios=[3, 1], sharex=True,
                                    layout="constrained")
    potential = column("potential_J_m")
    ax.plot(time, potential - potential[0], color=BLUE, label="potential, change")
    for name, label, colour, style in (
            ("plastic_J_m", "dissipated by plastic flow", ORANGE, "-"),
            ("viscous_J_m", "dissipated by viscosity", GREEN, "-"),
            ("damping_J_m", "lost at walls and by damping", GREY, "--"),
            ("kinetic_J_m", "kinetic", "black", "-"),
            ("elastic_J_m", "elastic", "#CC79A7", "-"),
            ("water_work_J_m", "work of the water", "#56B4E9", "--"),
            ("shake_work_J_m", "work of the shake", "#E69F00", "--")):
        values = column(name)
        if np.abs(values).max() > 0:
            ax.plot(time, values, style, color=colour, label=label)
    ax.set_ylabel("energy [kJ per m]")
    ax.grid(alpha=0.3)
    ax.legend()
    ax.set_title(f"{result['title']}: energies of the run-out")
    below.plot(time, column("error_J_m"), color="black")
    below.set_ylabel("balance off by\n[kJ per m]")
    below.set_xlabel("time [s]")
    below.grid(alpha=0.3)
    return fig


def animation(result, directory, path):
    """All frames as an animated GIF: ten a second."""
    frames = [read_frame(p) for p in frame_paths(directory)]
    highest = max(moved.max() for _, moved, _ in frames)
    farthest = max(frames, key=lambda f: np.ptp(f[0][:, 0]))
    fig, ax = figure_for(result)
    soil = draw_soil(ax, result, farthest[0], farthest[1], highest)
    colour_bar(fig, ax, soil, "total displacement [m]")
    fig.canvas.draw()
    fig.set_layout_engine("none")

    def show(k):
        position, moved, time = frames[k]
        soil.set_offsets(position)
        soil.set_array(moved)
        ax.set_title(f"{result['title']}\nt = {time:.2f} s")

    film = FuncAnimation(fig, show, frames=len(frames))
    film.save(path, writer=PillowWriter(fps=10), dpi=72)
    plt.close(fig)
