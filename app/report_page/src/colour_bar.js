// SPDX-License-Identifier: GPL-3.0-or-later
import { axisBottom } from "d3-axis";
import { scaleLinear } from "d3-scale";
import { select } from "d3-selection";
import { s } from "./dom.js";

/** A text in lines of at most `most` letters. */
function wrapped(text, most) {
  const lines = [""];
  for (const word of text.split(" ")) {
    const line = lines[lines.length - 1];
    if (line && line.length + 1 + word.length > most) lines.push(word);
    else lines[lines.length - 1] = line ? `${line} ${word}` : word;
  }
  return lines;
}

/** Title, colours and ticks of a field, at (left, top) of an SVG group. */
export function drawBar(group, field, left, top, width) {
  const { colours } = field,
    bar = s("g", { transform: `translate(${left},${top})` });
  group.append(bar);
  const parts = wrapped(field.title, width / 6.4);
  parts.forEach((part, i) =>
    bar.append(s("text", { x: 0, y: 11 + 15 * i, "font-size": 12, fill: "#1d2327" }, part)),
  );
  const y = 2 + 15 * parts.length,
    height = 11;
  if (colours.steps) {
    let x = 0;
    field.names.forEach((name, i) => {
      bar.append(
        s("rect", { x, y, width: 16, height, fill: colours.css[i], stroke: "#9aa3a9", "stroke-width": 0.6 }),
      );
      bar.append(s("text", { x: x + 21, y: y + 10, "font-size": 11, fill: "#3d464d" }, name));
      x += 34 + 6.6 * name.length;
    });
    return;
  }
  const from = colours.belowCss ? 22 : 0;
  if (from)
    bar.append(
      s("rect", {
        x: 0,
        y,
        width: 16,
        height,
        fill: colours.belowCss,
        stroke: "#9aa3a9",
        "stroke-width": 0.6,
      }),
    );
  if (from)
    bar.append(
      s(
        "text",
        { x: 8, y: y + height + 12, "font-size": 10.5, "text-anchor": "middle", fill: "#3d464d" },
        "<",
      ),
    );
  const n = 128,
    step = (width - from) / n;
  for (let i = 0; i < n; ++i)
    bar.append(
      s("rect", {
        x: from + i * step,
        y,
        width: step + 0.6,
        height,
        fill: colours.css[Math.round((i / (n - 1)) * 255)],
      }),
    );
  const ticks = scaleLinear(colours.domain, [from, width]);
  const axis = axisBottom(ticks).tickSizeOuter(0).tickSize(3);
  if (field.ticks) axis.tickValues(field.ticks);
  else axis.ticks(Math.max(3, Math.min(8, width / 70)));
  if (field.tick) axis.tickFormat(field.tick);
  const g = s("g", { transform: `translate(0,${y + height})` });
  bar.append(g);
  select(g).call(axis).attr("font-family", "inherit").attr("font-size", 10.5);
  select(g).selectAll("text").attr("fill", "#3d464d");
  select(g).selectAll("line").attr("stroke", "#9aa3a9");
  select(g).select(".domain").attr("stroke", "none");
}
