// SPDX-License-Identifier: GPL-3.0-or-later
// One key at a time: how far each moves F and discharge from what the case itself has.
import { axisBottom } from "d3-axis";
import { scaleLinear } from "d3-scale";
import { select } from "d3-selection";
import { axisName, styleAxis } from "./axes.js";
import { BLUE, INK, ORANGE } from "./colours.js";
import { chapter, h, s } from "./dom.js";
import { number } from "./numbers.js";
import { followWidth } from "./paper.js";
import { saveButtons } from "./save.js";
import { DISCHARGE, FACTOR, namesOf, valueText } from "./study_values.js";

const STEP = 46,
  LETTER = 6.2; // px: a row, and the width of a letter of a value

/** Of each varied key the members at its least and its largest result, the key that moves most first. */
export function tornadoRows(study, quantity) {
  const base = quantity.of(study.members[0]);
  const rows = namesOf(study).map((name) => {
    const some = study.members
      .filter((m) => m.varied.length === 1 && m.varied[0] === name && quantity.of(m) !== null)
      .map((m) => ({ value: m.values[name], result: quantity.of(m) }))
      .sort((a, b) => a.result - b.result);
    return { name, ends: some.length > 1 ? [some[0], some.at(-1)] : some };
  });
  const reach = (row) => Math.max(...row.ends.map(({ result }) => Math.abs(result - base)));
  return rows
    .filter((row) => row.ends.length)
    .sort((a, b) => reach(a) - reach(b))
    .reverse();
}

export function tornado(study) {
  if (study.design !== "one-at-a-time") return null;
  const [base] = study.members;
  const figures = [FACTOR, DISCHARGE]
    .filter((quantity) => quantity.of(base) !== null)
    .map((quantity) => [quantity, tornadoRows(study, quantity)])
    .filter(([, rows]) => rows.length)
    .map(([quantity, rows]) => figure(study, quantity, rows));
  if (!figures.length) return null;
  const missing = study.members.filter((m) => m.status !== "complete").length;
  return chapter(
    "tornado",
    "What matters most",
    figures,
    h(
      "p",
      { class: "note" },
      "One key at a time: from the case's own answer to the least and the largest that the key's values give; the values stand at the ends. Grey: what the case's own answer may be off by.",
      missing ? ` ${missing} of ${study.members.length} members have no answer.` : "",
    ),
  );
}

function figure(study, quantity, rows) {
  const [member] = study.members,
    base = quantity.of(member),
    title = `One key at a time: ${quantity.title}`;
  const svg = s("svg", { role: "img", "aria-label": title }),
    stage = h("div", { class: "chart-stage" }, svg);
  const view = { svg, title };
  const bars = rows.map((row) => sides(row, base));
  followWidth(stage, (width) => {
    const height = rows.length * STEP + 48,
      bottom = height - 42;
    Object.assign(view, { width, height });
    const most = Math.floor((0.28 * width) / LETTER);
    const room = (side) =>
      14 +
      LETTER *
        Math.max(0, ...bars.map((row) => Math.min(most, row.find((b) => b.side === side)?.text.length ?? 0)));
    const [low, high] = quantity.range(member),
      ends = [low, high, ...rows.flatMap((row) => row.ends.map((e) => e.result))];
    const least = Math.min(...ends),
      largest = Math.max(...ends),
      air = largest > least ? 0 : 0.01 * Math.abs(base) || 1;
    const x = scaleLinear([least - air, largest + air], [room(-1), width - room(1)]);
    const axis = s("g", { transform: `translate(0,${bottom})` });
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren(
      s("rect", {
        x: x(low),
        y: 4,
        width: Math.max(1, x(high) - x(low)),
        height: bottom - 4,
        fill: "#d9dde0",
      }),
      axis,
    );
    const ticks = Math.max(2, width / 130);
    select(axis).call(
      axisBottom(x)
        .ticks(ticks)
        .tickSize(4 - bottom)
        .tickPadding(7)
        .tickFormat(Math.abs(base) < 1e-3 ? (v) => number(v, 3) : x.tickFormat(ticks)),
    );
    styleAxis(select(axis));
    select(axis).selectAll("line").attr("stroke", "#e3e7ea");
    axisName(axis, `${quantity.title} [${quantity.unit}]`, width / 2, 36, 0);
    svg.append(s("path", { d: `M${x(base)},4V${bottom}`, stroke: INK, "stroke-width": 1.2 }));
    rows.forEach((row, i) => svg.append(...drawRow(row, bars[i], 4 + i * STEP, x, base, most, member)));
  });
  const drawn = h(
    "figure",
    { class: "view chart" },
    h(
      "div",
      { class: "controls" },
      h("strong", { class: "figure-title" }, `${title}; the case itself ${number(base, 4)}`),
      h("span", { class: "push" }),
      saveButtons(view),
    ),
    stage,
  );
  drawn.id = `${quantity.id}-tornado`;
  return drawn;
}

/** A bar to each side of the base where a result lies there; values on one side share it. */
const sides = (row, base) =>
  [-1, 1]
    .map((side) => {
      const some = row.ends
        .filter(({ result }) => (result - base) * side > 0)
        .sort((a, b) => Math.abs(b.result - base) - Math.abs(a.result - base));
      return {
        side,
        end: some[0]?.result,
        text: [...new Set(some.map((e) => valueText(e.value)))].join("; "),
      };
    })
    .filter((bar) => bar.text);

const text = (attributes, ...content) =>
  s(
    "text",
    {
      fill: INK,
      stroke: "white",
      "stroke-width": 3,
      "paint-order": "stroke",
      "font-size": 11.5,
      ...attributes,
    },
    ...content,
  );

function drawRow(row, bars, top, x, base, most, member) {
  const own = valueText(member.values[row.name]);
  const middle = top + 30;
  return [
    ...bars.flatMap(({ side, end, text: values }) => [
      s("rect", {
        class: "bar",
        x: Math.min(x(end), x(base)),
        y: middle - 9,
        width: Math.max(1, Math.abs(x(end) - x(base))),
        height: 18,
        fill: side < 0 ? ORANGE : BLUE,
      }),
      text(
        { x: x(end) + 4 * side, y: middle + 4, "text-anchor": side < 0 ? "end" : "start" },
        values.length > most ? `${values.slice(0, most - 1)}…` : values,
        s("title", {}, `${values}: ${number(end, 4)}`),
      ),
    ]),
    bars.length ? null : text({ x: x(base) + 6, y: middle + 4 }, "no effect"),
    text({ x: 4, y: top + 14, "font-size": 12 }, own === null ? row.name : `${row.name} (the case: ${own})`),
  ].filter(Boolean);
}
