// SPDX-License-Identifier: GPL-3.0-or-later
// Curves and points on two axes.
import { axisBottom, axisLeft } from "d3-axis";
import { scaleLinear, scaleLog } from "d3-scale";
import { select } from "d3-selection";
import { axisName, styleAxis } from "./axes.js";
import { INK } from "./colours.js";
import { h, s } from "./dom.js";
import { number, power } from "./numbers.js";
import { followWidth } from "./paper.js";
import { saveButtons } from "./save.js";

const PALE = 0.18;
const HOLLOW = {
  diamond: "M0,-6.5L5.5,0L0,6.5L-5.5,0Z",
  square: "M-4.5,-4.5H4.5V4.5H-4.5Z",
  triangle: "M0,-5.5L5.5,4.5H-5.5Z",
};
const M = { left: 62, right: 16, top: 12, bottom: 44 };

/** The smallest and largest of an axis, with room; from zero where nothing is negative, unless `zero` is false. */
function domain(values, { zero = true, log = false }) {
  const low = Math.min(...values),
    high = Math.max(...values);
  if (log) return [low * (low / high) ** 0.06, high * (high / low) ** 0.06];
  if (zero && low >= 0) return [0, high * 1.06 || 1];
  const room = 0.06 * (high - low || Math.abs(high) || 1);
  return [low - room, high + room];
}

/** Texts of an axis's ticks: all with as many places; numbers far from 1 as powers of ten. */
function labels(scale, count) {
  const exponent = (v) => Math.round(Math.log10(v));
  if (scale.base) return (v) => (Math.abs(v / 10 ** exponent(v) - 1) < 1e-9 ? power(exponent(v)) : "");
  const most = Math.max(...scale.domain().map(Math.abs));
  return most >= 1e6 || most < 1e-3 ? (v) => number(v, 2) : scale.tickFormat(count);
}

/**
 * x, y: { title, zero, log }; series: { label, points [[x, y]], colour, dash, shape ("dot", "ring", "cross", "diamond",
 * "square", "triangle"; "band": a pale area; without one: a line), tips: a text for each point }; bands: { from, to,
 * colour } along x; level: a y to be dashed across, if it is within.
 */
export function chart({ title, x, y, series, bands = [], level = null, height = 260 }) {
  const svg = s("svg", { role: "img", "aria-label": title }),
    readout = h("div", { class: "readout", hidden: true });
  const stage = h("div", { class: "chart-stage" }, svg, readout);
  const drawn = series.filter((one) => one.points.length);
  const view = { svg, title, layers: drawn.filter((one) => one.label).map(legendLayer) };
  const legend = drawn
    .filter((one) => one.label)
    .map((one) => h("span", { class: "item" }, swatch(one), one.label));
  let scales;
  const draw = (width) => {
    Object.assign(view, { width, height });
    const right = width - M.right,
      bottom = height - M.bottom,
      all = drawn.flatMap((one) => one.points);
    const xs = (x.log ? scaleLog : scaleLinear)(
      domain(
        all.map((p) => p[0]),
        x,
      ),
      [M.left, right],
    );
    const ys = (y.log ? scaleLog : scaleLinear)(
      domain(
        all.map((p) => p[1]),
        y,
      ),
      [bottom, M.top],
    );
    const gx = s("g", { transform: `translate(0,${bottom})` }),
      gy = s("g", { transform: `translate(${M.left},0)` });
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren(
      ...bands.map((b) =>
        s("rect", {
          x: xs(b.from),
          y: M.top,
          width: Math.max(1, xs(b.to) - xs(b.from)),
          height: bottom - M.top,
          fill: b.colour,
          opacity: 0.5,
        }),
      ),
      gx,
      gy,
    );
    const across = Math.max(3, width / 100);
    select(gy).call(
      axisLeft(ys)
        .ticks(5)
        .tickFormat(labels(ys, 5))
        .tickSize(M.left - right),
    );
    select(gx).call(axisBottom(xs).ticks(across).tickFormat(labels(xs, across)));
    for (const g of [gx, gy]) styleAxis(select(g));
    select(gy).selectAll("line").attr("stroke", "#e3e7ea");
    axisName(gx, x.title, (M.left + right) / 2, 36, 0);
    axisName(gy, y.title, -(M.top + bottom) / 2, -48, -90);
    const [bottomValue, topValue] = ys.domain();
    if (level !== null && bottomValue < level && level < topValue)
      svg.append(
        s("path", { d: `M${M.left},${ys(level)}H${right}`, stroke: INK, "stroke-dasharray": "5 3" }),
      );
    for (const one of drawn) svg.append(...curve(one, xs, ys));
    scales = { xs, ys };
  };
  followWidth(stage, draw);
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect(),
      ratio = view.width / box.width;
    tell(
      readout,
      nearest(drawn, scales, (event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio),
      { x, y },
      view,
    );
  });
  svg.addEventListener("pointerleave", () => (readout.hidden = true));
  return h(
    "figure",
    { class: "view chart" },
    h(
      "div",
      { class: "controls" },
      h("strong", { class: "figure-title" }, title),
      h("span", { class: "push" }),
      saveButtons(view),
    ),
    stage,
    h("div", { class: "legend" }, legend),
  );
}

/** The point of all series that is nearest to a place, within 40 pixels. */
function nearest(drawn, { xs, ys }, px, py) {
  let best = null,
    least = 40;
  for (const one of drawn)
    one.points.forEach((p, i) => {
      const left = xs(p[0]),
        top = ys(p[1]),
        distance = Math.hypot(left - px, top - py);
      if (distance < least) [best, least] = [{ one, p, i, left, top }, distance];
    });
  return best;
}

/** Its values beside it, each with the name and unit of its axis. */
function tell(readout, found, { x, y }, view) {
  readout.hidden = !found;
  if (!found) return;
  const { one, p, i, left, top } = found;
  const value = (axis, v) => {
    const [, name, unit = "-"] = /^(.*?)(?: \[(.*)\])?$/.exec(axis.title);
    return `${name} ${number(v, 4)}${unit === "-" ? "" : ` ${unit}`}`;
  };
  readout.textContent = [one.tips?.[i] ?? one.label, value(x, p[0]), value(y, p[1])]
    .filter(Boolean)
    .join("\n");
  const onRight = left > view.width / 2;
  readout.style.left = onRight ? "" : `${(100 * (left + 12)) / view.width}%`;
  readout.style.right = onRight ? `${100 - (100 * (left - 12)) / view.width}%` : "";
  readout.style.top = `${(100 * Math.max(0, top - 30)) / view.height}%`;
}

function curve(one, xs, ys) {
  const d = "M" + one.points.map((p) => `${xs(p[0]).toFixed(1)},${ys(p[1]).toFixed(1)}`).join("L");
  if (one.shape === "band")
    return [s("path", { d: d + "Z", fill: one.colour, stroke: one.colour, opacity: PALE })];
  if (one.shape)
    return one.points.map((p) => s("g", { transform: `translate(${xs(p[0])},${ys(p[1])})` }, sign(one)));
  return [
    s("path", {
      d,
      fill: "none",
      stroke: one.colour,
      "stroke-width": one.width ?? 1.8,
      "stroke-dasharray": one.dash ?? null,
      "stroke-linejoin": "round",
    }),
  ];
}

function sign(one) {
  if (one.shape === "cross")
    return s("path", {
      d: "M-4.5,-4.5L4.5,4.5M-4.5,4.5L4.5,-4.5",
      stroke: one.colour,
      "stroke-width": 2.2,
      fill: "none",
    });
  if (HOLLOW[one.shape])
    return s("path", { d: HOLLOW[one.shape], stroke: one.colour, "stroke-width": 1.6, fill: "none" });
  return s("circle", {
    r: 4.6,
    fill: one.shape === "ring" ? "white" : one.colour,
    stroke: one.colour,
    "stroke-width": 1.8,
  });
}

/** What stands for a series in a legend. */
function symbol(one) {
  if (one.shape === "band")
    return s("rect", { x: 1, y: 1, width: 24, height: 10, fill: one.colour, opacity: 2 * PALE });
  if (one.shape) return s("g", { transform: "translate(13,6)" }, sign(one));
  return s("path", {
    d: "M1 6H25",
    stroke: one.colour,
    "stroke-width": 2,
    "stroke-dasharray": one.dash ?? null,
  });
}

const swatch = (one) =>
  s("svg", { width: 26, height: 12, class: "swatch", "aria-hidden": "true" }, symbol(one));

/** For the legend of a saved picture. */
const legendLayer = (one) => ({ label: one.label, shown: true, symbol: () => symbol(one) });
