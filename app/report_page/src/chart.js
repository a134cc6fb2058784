// SPDX-License-Identifier: GPL-3.0-or-later
// Curves and points on two axes.
import { axisBottom, axisLeft } from "d3-axis";
import { scaleLinear, scaleLog } from "d3-scale";
import { select } from "d3-selection";
import { h, s } from "./dom.js";
import { number, power } from "./numbers.js";
import { followWidth } from "./paper.js";
import { saveButtons } from "./save.js";
import { axisName, styleAxis } from "./axes.js";

const M = { left: 62, right: 16, top: 12, bottom: 44 };

/** The smallest and largest of an axis, with room; from zero where nothing is negative. */
function domain(values, axis) {
  let low = Math.min(...values),
    high = Math.max(...values);
  for (const v of axis.include ?? []) [low, high] = [Math.min(low, v), Math.max(high, v)];
  if (axis.log) return [low / 1.3, high * 1.5];
  if (axis.zero !== false && low >= 0) return [0, high * 1.06 || 1];
  const room = 0.06 * (high - low || Math.abs(high) || 1);
  return [low - room, high + room];
}

/** Texts of an axis's ticks: all with as many places; numbers far from 1 as powers of ten. */
function labels(axis, scale, count) {
  const most = Math.max(...scale.domain().map(Math.abs));
  if (axis.log) return (v) => power(Math.round(Math.log10(v)));
  return most >= 1e6 || most < 1e-3 ? (v) => number(v, 2) : scale.tickFormat(count);
}
const isPower = (v) => Math.abs(Math.log10(v) - Math.round(Math.log10(v))) < 1e-9;

/**
 * x, y: { title, log, zero, include }; series: { label, points [[x, y]], colour, dash, shape ("dot", "ring",
 * "cross"; without one: a line), tips }; bands and lines across: { from, to, colour }, { at, colour, text }.
 */
export function chart({ title, x, y, series, bands = [], verticals = [], height = 260 }) {
  const svg = s("svg", { role: "img", "aria-label": title });
  const stage = h("div", { class: "chart-stage" }, svg);
  const view = { svg, title, layers: [] };
  const legend = h("div", { class: "legend" });
  const drawn = series.filter((one) => one.points.length);
  for (const one of drawn.filter((o) => o.label)) {
    const layer = one.shape
      ? { label: one.label, shown: true, marks: [{ shape: one.shape, colour: one.colour }] }
      : {
          label: one.label,
          shown: true,
          lines: [[]],
          look: { stroke: one.colour, dash: one.dash, width: 2 },
        };
    view.layers.push(layer);
    legend.append(h("span", { class: "item" }, swatch(one), one.label));
  }
  const root = h(
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
    legend,
  );
  const draw = (width) => {
    Object.assign(view, { width, height });
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const all = drawn.flatMap((one) => one.points);
    const positive = (v, axis) => !axis.log || v > 0;
    const xs = (x.log ? scaleLog : scaleLinear)(
      domain(
        all.map((p) => p[0]).filter((v) => positive(v, x)),
        x,
      ),
      [M.left, width - M.right],
    );
    const ys = (y.log ? scaleLog : scaleLinear)(
      domain(
        all.map((p) => p[1]).filter((v) => positive(v, y)),
        y,
      ),
      [height - M.bottom, M.top],
    );
    svg.replaceChildren();
    for (const band of bands)
      svg.append(
        s("rect", {
          x: xs(band.from),
          y: M.top,
          width: Math.max(1, xs(band.to) - xs(band.from)),
          height: height - M.top - M.bottom,
          fill: band.colour,
          opacity: 0.5,
        }),
      );
    const gx = s("g", { transform: `translate(0,${height - M.bottom})` }),
      gy = s("g", { transform: `translate(${M.left},0)` });
    svg.append(gx, gy);
    const ticks = (axis, scale, count) =>
      axis.log ? scale.ticks(count).filter(isPower) : scale.ticks(count);
    select(gy).call(
      axisLeft(ys)
        .tickValues(ticks(y, ys, 5))
        .tickFormat(labels(y, ys, 5))
        .tickSize(-(width - M.left - M.right)),
    );
    select(gx).call(
      axisBottom(xs)
        .tickValues(ticks(x, xs, Math.max(3, width / 100)))
        .tickFormat(labels(x, xs, Math.max(3, width / 100))),
    );
    for (const g of [gx, gy]) styleAxis(select(g));
    select(gy).selectAll("line").attr("stroke", "#e3e7ea");
    axisName(gx, x.title, M.left + (width - M.left - M.right) / 2, 36, 0);
    axisName(gy, y.title, -(M.top + (height - M.top - M.bottom) / 2), -48, -90);
    for (const line of verticals) {
      svg.append(
        s("path", {
          d: `M${xs(line.at)},${M.top}V${height - M.bottom}`,
          stroke: line.colour,
          "stroke-dasharray": line.dash ?? "5 3",
          fill: "none",
        }),
      );
      if (line.text)
        svg.append(
          s("text", { x: xs(line.at) + 4, y: M.top + 11, "font-size": 11, fill: line.colour }, line.text),
        );
    }
    for (const one of drawn) svg.append(...curve(one, xs, ys, x, y));
  };
  followWidth(stage, draw);
  return root;
}

function curve(one, xs, ys, x, y) {
  const points = one.points.filter((p) => (!x.log || p[0] > 0) && (!y.log || p[1] > 0));
  if (!one.shape)
    return [
      s(
        "path",
        {
          d: "M" + points.map((p) => `${xs(p[0]).toFixed(1)},${ys(p[1]).toFixed(1)}`).join("L"),
          fill: "none",
          stroke: one.colour,
          "stroke-width": one.width ?? 1.8,
          "stroke-dasharray": one.dash ?? null,
          "stroke-linejoin": "round",
        },
        one.label ? s("title", {}, one.label) : null,
      ),
    ];
  return points.map((p, i) =>
    s(
      "g",
      { transform: `translate(${xs(p[0])},${ys(p[1])})` },
      sign(one),
      one.tips ? s("title", {}, one.tips[i]) : null,
    ),
  );
}

function sign(one) {
  if (one.shape === "cross")
    return s("path", {
      d: "M-4.5,-4.5L4.5,4.5M-4.5,4.5L4.5,-4.5",
      stroke: one.colour,
      "stroke-width": 2.2,
      fill: "none",
    });
  return s("circle", {
    r: 4.6,
    fill: one.shape === "ring" ? "white" : one.colour,
    stroke: one.colour,
    "stroke-width": 1.8,
  });
}

const swatch = (one) =>
  s(
    "svg",
    { width: 26, height: 12, class: "swatch", "aria-hidden": "true" },
    one.shape
      ? s("g", { transform: "translate(13,6)" }, sign(one))
      : s("path", {
          d: "M1 6H25",
          stroke: one.colour,
          "stroke-width": 2,
          "stroke-dasharray": one.dash ?? null,
        }),
  );
