#!/usr/bin/python3
"""Draw a study beside its study.json: study_factor.png, study_discharge.png, study_tornado.png and
study_phreatic.png, as far as there is something to draw.

    /usr/bin/python3 docs/plots/study.py DIR [--formats png svg]

DIR is what `berm study` wrote. Points of DIR/reference.csv (columns x, F or discharge_m2_s, source)
are drawn over the results.
"""

import csv
import json
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize

from section import (BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, colour_bar, command_line, draw_section,
                     figure_for, save)

COLOURS = [BLUE, ORANGE, GREEN, PURPLE, SKY, GREY]
LOOKS = [(colour, marker, style) for style in ("-", "--", ":")
         for colour, marker in zip(COLOURS, ["o", "s", "^", "D", "v", "P"])]
UNITS = {"kN_m3": "kN/m³", "kPa": "kPa", "deg": "°", "m_s": "m/s", "1_m": "1/m", "m": "m", "s": "s",
         "g": "g"}


def split_unit(key):
    """The key's words and its unit: "soil.core.cohesion_kPa" gives "cohesion of core", "kPa"."""
    path, _, last = key.rpartition(".")
    unit = next((u for u in UNITS if last.endswith("_" + u)), None)
    words = (last[: -len(unit) - 1] if unit else last).replace("_", " ")
    owner = re.fullmatch(r"soil\.(.+)", path)
    where = re.search(r"(\w+)\[(\d+)\]$", path)
    if owner:
        words += f" of {owner[1]}"
    elif where:
        words += f" of {where[1]} {where[2]}"
    elif path == "water":
        words = words.replace("left level", "left pool level").replace("right level",
                                                                       "right pool level")
    return words, UNITS.get(unit, "")


def words_of(name):
    """A variation's keys in words, with the unit of the first."""
    parts = [split_unit(key) for key in name.split("+")]
    return " and ".join(words for words, _ in parts), parts[0][1]


def label(name):
    words, unit = words_of(name)
    return f"{words} [{unit}]" if unit else words


def value_text(value):
    text = f"{value:.4g}" if isinstance(value, (int, float)) else str(value)
    return text if len(text) < 40 else text[:37] + "..."


def short(name, value):
    """One value in a legend."""
    return f"{words_of(name)[0]} {value_text(value)} {words_of(name)[1]}"


class Quantity:
    """What is drawn upwards: where its value, its bar and its file come from."""

    def __init__(self, key, title, bars, low, high, reference):
        self.key, self.title, self.bars, self.reference = key, title, bars, reference
        self.low, self.high = low, high

    def bar(self, member):
        """Least and largest value; the value itself where nothing is known of its error."""
        value = member[self.key]
        return self.low(member) or value, self.high(member) or value


def error_bar(sign):
    def end(member):
        error = member["discharge_error_m2_s"]
        return member["discharge_m2_s"] + sign * error if error is not None else None
    return end


FACTOR = Quantity("factor", "factor of safety [-]", "bars: from low to high", lambda m: m["low"],
                  lambda m: m["high"], "F")
DISCHARGE = Quantity("discharge_m2_s", "discharge [m²/s per metre run]", "bars: estimated error",
                     error_bar(-1), error_bar(1), "discharge_m2_s")


def is_numeric(study, name):
    """More than one value, all of them numbers."""
    values = [member["values"][name] for member in study["members"]]
    return all(isinstance(v, (int, float)) for v in values) and len(set(values)) > 1


def by_ratios(values):
    """Whether the values call for a logarithmic axis."""
    values = sorted(set(values))
    return values[0] > 0 and values[-1] / values[0] >= 30


def axis_of_values(ax, study, name):
    """The place of each value along x: the value, or the number of a text, with texts as ticks."""
    values = [member["values"][name] for member in study["members"]]
    ax.set_xlabel(label(name))
    if is_numeric(study, name):
        if by_ratios(values):
            ax.set_xscale("log")
        return dict(zip(values, values))
    different = list(dict.fromkeys(values))
    ax.set_xticks(range(len(different)), [str(v).replace("],", "],\n") for v in different],
                  fontsize=8, rotation=30 if len(different) > 3 else 0)
    return {value: i for i, value in enumerate(different)}


def draw_family(ax, members, x, quantity, look, name):
    """A curve with bars. A member without an answer breaks the line."""
    colour, marker, style = look
    line, at, bars = [], [], []
    for member in sorted(members, key=lambda m: x[m["x"]]):
        value = member[quantity.key]
        line.append((x[member["x"]], np.nan if value is None else value))
        if value is not None:
            low, high = quantity.bar(member)
            at.append((x[member["x"]], value))
            bars.append((value - low, high - value))
    if len(line) > 1:
        ax.plot(*np.array(line).T, style, color=colour, lw=1.2, zorder=2)
    if at:
        ax.errorbar(*np.array(at).T, yerr=np.abs(np.array(bars)).T, fmt=marker, color=colour, ms=6,
                    mec="black", mew=0.5, capsize=4, lw=1.4, zorder=3, label=name)
    for member in members:
        if member[quantity.key] is None:
            draw_missing(ax, x[member["x"]], member, quantity, colour)


def draw_missing(ax, x, member, quantity, colour):
    """What is known without an answer: dashes where it stood and where it failed, or a cross."""
    stands, fails = member["stands"], member["fails"]
    if quantity is FACTOR and (stands or fails):
        ends = [at for at in (stands, fails) if at]
        ax.plot([x] * len(ends), ends, ":", marker="_", ms=14, mew=1.5, color=colour, zorder=3)
        ax.annotate(member["status"], (x, ends[-1]), fontsize=8, ha="center", va="bottom",
                    xytext=(0, 4), textcoords="offset points")
    else:
        ax.plot(x, 0.02, "x", color="black", ms=7, transform=ax.get_xaxis_transform(), zorder=4)
        ax.annotate(member["status"], (x, 0.04), xycoords=ax.get_xaxis_transform(), fontsize=7,
                    rotation=90, ha="center", va="bottom")


def read_reference(directory, column):
    """(source, x, value) of each reference point; empty without a file or such a column."""
    path = directory / "reference.csv"
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    return [(row.get("source") or "reference", float(row["x"]), float(row[column]))
            for row in rows if row.get(column)]


def draw_reference(ax, points):
    """Hollow, a marker for each source."""
    looks = iter(["D", "s", "^", "v", "P", "*"] * 9)
    for source in dict.fromkeys(point[0] for point in points):
        some = np.array([point[1:] for point in points if point[0] == source])
        ax.plot(*some.T, next(looks), mfc="none", mec="black", mew=1.3, ms=9, zorder=5,
                label=source)


def curves_figure(study, directory, quantity):
    """The quantity against the first key; a curve for every combination of the others."""
    names = list(study["members"][0]["values"])
    paired = study["design"] == "pairs"
    x_name = next((n for n in names if is_numeric(study, n)), names[0])
    others = [] if paired else [n for n in names if n != x_name]
    fig, ax = plt.subplots(figsize=(8, 5.2), layout="constrained")
    x = axis_of_values(ax, study, x_name)
    families = {}
    for member in study["members"]:
        key = tuple(member["values"][n] for n in others)
        families.setdefault(key, []).append(member | {"x": member["values"][x_name]})
    curves = {}  # families of the same values are one curve of several names
    for key, members in families.items():
        curve = tuple((m["x"], m[quantity.key], m["status"]) for m in members)
        names_of_curve = curves.setdefault(curve, ([], members))[0]
        names_of_curve.append(", ".join(short(n, v) for n, v in zip(others, key)) or "berm")
    for i, (names_of_curve, members) in enumerate(curves.values()):
        draw_family(ax, members, x, quantity, LOOKS[i % len(LOOKS)], "\n".join(names_of_curve))
    points = read_reference(directory, quantity.reference) if is_numeric(study, x_name) else []
    draw_reference(ax, points)
    values = [m[quantity.key] for m in study["members"] if m[quantity.key]]
    if quantity is DISCHARGE and values and by_ratios(values):
        ax.set_yscale("log")
    if quantity is FACTOR:
        low, high = ax.get_ylim()
        if low < 1 < high:
            ax.axhline(1, color="black", lw=0.8, ls="--", zorder=1)
    ax.set_ylabel(f"{quantity.title}\n({quantity.bars})")
    ax.set_title(study["title"])
    ax.grid(alpha=0.3)
    if points or len(families) > 1:
        ax.legend(fontsize=8)
    return fig


def tornado_rows(study, quantity):
    """(name, [(value, result)]) of each varied key, at its least and its largest result."""
    rows = []
    for name in study["members"][0]["values"]:
        some = [(m["values"][name], m[quantity.key]) for m in study["members"]
                if m["varied"] == [name] and m[quantity.key] is not None]
        if some:
            some.sort(key=lambda pair: pair[1])
            rows.append((name, [some[0], some[-1]] if len(some) > 1 else some))
    base = study["members"][0][quantity.key]
    rows.sort(key=lambda row: max(abs(result - base) for _, result in row[1]))
    return rows


def draw_bars(ax, row, ends, base):
    """A bar to each side of the base, values at their ends; those on one side share the bar."""
    for side, colour in ((-1, ORANGE), (1, BLUE)):
        some = [(value, result) for value, result in ends if (result - base) * side > 0]
        if not some:
            continue
        some.sort(key=lambda pair: -abs(pair[1] - base))
        ax.barh(row, some[0][1] - base, left=base, height=0.55, color=colour, zorder=2)
        text = "; ".join(dict.fromkeys(value_text(value) for value, _ in some))
        ax.annotate(text, (some[0][1], row), fontsize=8, va="center", zorder=4,
                    ha="right" if side < 0 else "left", xytext=(4 * side, 0),
                    textcoords="offset points")
    if all(result == base for _, result in ends):
        ax.annotate("no effect", (base, row), fontsize=8, va="center", color=GREY, xytext=(4, 0),
                    textcoords="offset points")


def tornado_figure(study, quantities):
    """How far each key alone moves each quantity from the base."""
    base_member = study["members"][0]
    quantities = [q for q in quantities
                  if base_member[q.key] is not None and tornado_rows(study, q)]
    if not quantities:
        return None
    count = len(base_member["values"])
    fig, axes = plt.subplots(1, len(quantities), squeeze=False, layout="constrained",
                             figsize=(8.5 * len(quantities), 1.8 + 0.75 * count))
    for ax, quantity in zip(axes[0], quantities):
        base = base_member[quantity.key]
        rows = tornado_rows(study, quantity)
        for row, (name, ends) in enumerate(rows):
            draw_bars(ax, row, ends, base)
        low, high = quantity.bar(base_member)
        ax.axvspan(low, high, color="0.85", zorder=0, label="uncertainty of the base")
        ax.axvline(base, color="black", lw=1, zorder=3, label=f"base {base:.4g}")
        ax.set_yticks(range(len(rows)), [base_label(study, name) for name, _ in rows])
        ax.set_ylim(-0.6, len(rows) - 0.4)
        ax.margins(x=0.14)
        ax.set_xlabel(quantity.title)
        ax.grid(axis="x", alpha=0.3)
        ax.legend(loc="lower right", fontsize=8)
    missing = sum(m["status"] != "complete" for m in study["members"])
    fig.suptitle(f"{study['title']}: one key at a time"
                 + (f" ({missing} members without an answer)" if missing else ""))
    return fig


def base_label(study, name):
    """A key with its unit and the value that the case gives it."""
    value = study["members"][0]["values"][name]
    return label(name) + (f"\n(base {value_text(value)})" if value is not None else "")


def seepage_results(study, directory):
    """(member, result.json) of the members with a phreatic line that no earlier one has."""
    found = []
    for member in study["members"]:
        path = directory / member["directory"] / "result.json"
        if member["discharge_m2_s"] is None or not path.exists():
            continue
        result = json.loads(path.read_text(encoding="utf-8"))
        lines = result["seepage"]["phreatic_lines_m"]
        if lines and all(lines != other["seepage"]["phreatic_lines_m"] for _, other in found):
            found.append((member, result))
    return found


def phreatic_figure(study, directory):
    """The phreatic lines of all members on one section, coloured by the first numeric key."""
    found = seepage_results(study, directory)
    if not found:
        return None
    fig, ax = figure_for(found[0][1])
    names = list(study["members"][0]["values"])
    name = next((n for n in names if is_numeric(study, n)), None)
    one_by_one = study["design"] == "one-at-a-time"
    bar = None
    if name and not one_by_one:
        values = [member["values"][name] for member in study["members"]]
        norm = (LogNorm if by_ratios(values) else Normalize)(min(values), max(values))
        bar = ScalarMappable(norm, plt.get_cmap("viridis"))
    for i, (member, result) in enumerate(found):
        colour, _, style = LOOKS[i % len(LOOKS)]
        text = ", ".join(short(n, member["values"][n]) for n in member["varied"])
        if bar:
            colour, style, text = bar.to_rgba(member["values"][name]), "-", None
        elif not member["varied"]:
            colour, text = "black", "base"
        for k, line in enumerate(result["seepage"]["phreatic_lines_m"]):
            ax.plot(*np.array(line).T, ls=style, color=colour, lw=1.6, zorder=6,
                    label=None if k else text)
    draw_section(ax, without_pools_that_differ([r for _, r in found]))
    ax.set_title(f"{study['title']}: phreatic lines")
    if bar:
        colour_bar(fig, ax, bar, label(name))
    else:
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22), fontsize=8, ncol=3)
    return fig


def without_pools_that_differ(results):
    """The first member's section, with the pools and inner lines that all members share."""
    section = dict(results[0]["section"])
    for side in ("left_level_m", "right_level_m"):
        if any(r["section"][side] != section[side] for r in results):
            section[side] = None
    if any(r["section"]["inner_lines"] != section["inner_lines"] for r in results):
        section["inner_lines"] = []
    return {"section": section}


def main(directory, formats):
    study = json.loads((directory / "study.json").read_text(encoding="utf-8"))
    some = [q for q in (FACTOR, DISCHARGE)
            if any(member[q.key] is not None for member in study["members"])]
    figures = {}
    if study["design"] == "one-at-a-time":
        figures["tornado"] = tornado_figure(study, some)
    else:
        for quantity, name in ((FACTOR, "factor"), (DISCHARGE, "discharge")):
            if quantity in some:
                figures[name] = curves_figure(study, directory, quantity)
    if DISCHARGE in some:
        figures["phreatic"] = phreatic_figure(study, directory)
    for name in ("factor", "discharge", "tornado", "phreatic"):
        path = directory / f"study_{name}"
        for old in ("png", "svg"):
            path.with_suffix(f".{old}").unlink(missing_ok=True)
        if figures.get(name) is not None:
            save(figures[name], path, formats, bbox_inches="tight")


if __name__ == "__main__":
    options = command_line(__doc__).parse_args()
    main(options.directory, options.formats)
