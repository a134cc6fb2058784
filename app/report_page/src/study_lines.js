// SPDX-License-Identifier: GPL-3.0-or-later
// The phreatic lines of all members on one section.
import { colourScale, INK } from "./colours.js";
import { chapter, h } from "./dom.js";
import { logTicks } from "./fields.js";
import { boxOf, outlineLayers, poolLayers } from "./section.js";
import { look } from "./study_curves.js";
import { byRatios, firstNumeric, label } from "./study_values.js";
import { unpack } from "./unpack.js";
import { View } from "./view.js";

/** A colour for each value of the first key with numbers, and its bar; nothing where each member has a look of its own. */
function scaleOf(study) {
  const name = firstNumeric(study);
  if (!name || study.design === "one-at-a-time") return null;
  const values = study.members.map((m) => m.values[name]),
    log = byRatios(values),
    on = log ? Math.log10 : (v) => v;
  const [low, high] = [Math.min(...values), Math.max(...values)].map(on);
  const colours = colourScale("lines", [low, high]);
  return {
    colour: (member) => colours.css[Math.round((255 * (on(member.values[name]) - low)) / (high - low))],
    bar: { title: name, colours, draw: () => {}, ...(log ? logTicks(low, high) : {}) },
  };
}

export function phreaticLines(study, phreatic) {
  if (!phreatic) return null;
  const { section } = phreatic,
    scale = scaleOf(study);
  const found = phreatic.members.map(({ index, lines }) => ({
    member: study.members[index],
    lines: lines.map(({ x, y }) => {
      const ys = unpack(y);
      return Array.from(unpack(x), (v, i) => [round(v), round(ys[i])]);
    }),
  }));
  const layers = found.map(({ member, lines }, i) => {
    if (scale) return { lines, look: { stroke: scale.colour(member), width: 2 } };
    const { colour, dash } = member.varied.length ? look(i) : { colour: INK, dash: null };
    return { label: label(member), lines, look: { stroke: colour, dash, width: 2 } };
  });
  const title = "Phreatic lines of the members";
  const view = new View({
    box: boxOf(
      section,
      found.flatMap(({ lines }) => lines.flatMap(corners)),
    ),
    title,
    controls: [h("strong", { class: "figure-title" }, title)],
    bar: Boolean(scale),
  });
  view.root.id = "phreatic-view";
  if (scale) view.setField(scale.bar);
  view.setLayers([...poolLayers(section), ...outlineLayers({ section }), ...layers]);
  return chapter(
    "phreatic",
    "Where the water is",
    view.root,
    h(
      "p",
      { class: "note" },
      "The same line is drawn once. Pools and inner lines are drawn where all these members have them.",
    ),
  );
}

const round = (v) => Number(v.toPrecision(6));

/** Of the box around a line. */
function corners(line) {
  const low = [Infinity, Infinity],
    high = [-Infinity, -Infinity];
  for (const p of line)
    for (const k of [0, 1]) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  return [low, high];
}
