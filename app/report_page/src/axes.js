// SPDX-License-Identifier: GPL-3.0-or-later
import { s } from "./dom.js";

/** Presentation as attributes: a saved SVG has no style sheet. */
export function styleAxis(group) {
  group.attr("font-family", "inherit").attr("font-size", 11);
  group.selectAll("text").attr("fill", "#3d464d");
  group.selectAll("line").attr("stroke", "#9aa3a9");
  group.select(".domain").attr("stroke", "none");
}

export function axisName(group, text, x, y, turned) {
  group.querySelector(".name")?.remove();
  group.append(
    s(
      "text",
      {
        class: "name",
        transform: `rotate(${turned})`,
        x,
        y,
        fill: "#3d464d",
        "text-anchor": "middle",
        "font-size": 11.5,
      },
      text,
    ),
  );
}
