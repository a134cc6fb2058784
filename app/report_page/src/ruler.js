// SPDX-License-Identifier: GPL-3.0-or-later
// Factors of safety on one scale: brackets, what they may be off by, others' factors to compare with.
import { axisBottom } from "d3-axis";
import { scaleLinear } from "d3-scale";
import { select } from "d3-selection";
import { INK, RED } from "./colours.js";
import { h, s } from "./dom.js";
import { factor } from "./numbers.js";
import { followWidth } from "./paper.js";
import { axisName, styleAxis } from "./axes.js";

/** rows: { label, colour, factor, stands, fails, low, high, marks: [{ at, text }] }. */
export function ruler(rows, title) {
  const svg = s("svg", { role: "img", "aria-label": title });
  const stage = h("div", { class: "chart-stage" }, svg);
  const all = rows
    .flatMap((r) => [r.low, r.high, r.stands, r.fails, r.factor, ...(r.marks ?? []).map((m) => m.at)])
    .filter((v) => v !== null && v !== undefined);
  const draw = (width) => {
    const narrow = width < 560,
      step = narrow ? 46 : 34,
      left = narrow ? 12 : 12 + 7.3 * Math.max(...rows.map((r) => r.label.length)),
      right = 58;
    const height = rows.length * step + 44,
      low = Math.min(1, ...all),
      high = Math.max(1, ...all),
      room = 0.04 * (high - low);
    const x = scaleLinear([low - room, high + room], [left, width - right]);
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren();
    const gx = s("g", { transform: `translate(0,${rows.length * step + 6})` });
    svg.append(gx);
    select(gx).call(
      axisBottom(x)
        .ticks(Math.max(3, width / 110))
        .tickSize(-(rows.length * step))
        .tickPadding(6),
    );
    styleAxis(select(gx));
    select(gx).selectAll("line").attr("stroke", "#e3e7ea");
    axisName(gx, "factor of safety F [-]", (left + width - right) / 2, 32, 0);
    svg.append(
      s("path", {
        d: `M${x(1)},0V${rows.length * step + 6}`,
        stroke: RED,
        "stroke-width": 1.4,
        fill: "none",
      }),
      s("text", { x: x(1) + 4, y: 10, "font-size": 10.5, fill: RED }, narrow ? "" : "F = 1"),
    );
    rows.forEach((row, i) => {
      const y = i * step + (narrow ? 30 : 20);
      svg.append(
        s(
          "text",
          narrow
            ? {
                x: left,
                y: y - 13,
                "font-size": 11.5,
                fill: INK,
                stroke: "white",
                "stroke-width": 3,
                "paint-order": "stroke",
              }
            : { x: left - 12, y: y + 4, "text-anchor": "end", "font-size": 12, fill: INK },
          row.label,
        ),
      );
      if (row.low !== null && row.low !== undefined)
        svg.append(
          s("rect", {
            x: x(row.low),
            y: y - 6,
            width: Math.max(1, x(row.high) - x(row.low)),
            height: 12,
            fill: row.colour,
            opacity: 0.22,
          }),
        );
      if (row.stands && row.fails)
        svg.append(
          s("rect", {
            x: x(row.stands) - 1,
            y: y - 6,
            width: Math.max(3, x(row.fails) - x(row.stands) + 2),
            height: 12,
            fill: row.colour,
          }),
        );
      for (const m of row.marks ?? [])
        svg.append(
          s(
            "g",
            { transform: `translate(${x(m.at)},${y})` },
            s(
              "path",
              { d: "M0,-8L5,0L0,8L-5,0Z", fill: "white", stroke: INK, "stroke-width": 1.3 },
              s("title", {}, m.text),
            ),
          ),
        );
      svg.append(
        s(
          "text",
          { x: width - right + 8, y: y + 4, "font-size": 13, "font-weight": 600, fill: INK },
          row.factor === null ? "none" : factor(row.factor),
        ),
      );
    });
  };
  followWidth(stage, draw);
  return h("figure", { class: "view chart" }, stage);
}
