// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and marks over a field: { label, look: { stroke, dash, width, fill, halo, opacity }, lines: [[[x, y], ...],
// ...], closed, circle: { centre, radius }, marks: [{ at, shape, text, colour }], on, fixed (no switch) }.
import { INK } from "./colours.js";
import { s } from "./dom.js";

/** What stands for a layer in a legend. */
export function swatchOf(layer) {
  if (layer.symbol) return layer.symbol();
  const look = layer.look ?? {};
  if (layer.lines || layer.circle)
    return s("path", {
      d: layer.closed && look.fill !== "none" ? "M1 1H25V11H1Z" : "M1 6H25",
      fill: layer.closed ? (look.fill ?? "none") : "none",
      stroke: look.stroke ?? "none",
      "stroke-width": Math.min(look.width ?? 1.2, 4),
      "stroke-dasharray": look.dash ?? null,
    });
  return mark({ at: [0, 0], ...layer.marks[0], text: "" }, 13, 6);
}

const pathOf = (line, closed) => "M" + line.map((p) => `${p[0]},${p[1]}`).join("L") + (closed ? "Z" : "");

/** Draw a layer into its group, for a mapping of the view. */
export function drawLayer(layer, m) {
  const look = layer.look ?? {};
  if (!layer.lineGroup || !layer.lineGroup.parentNode) {
    const style = {
      fill: layer.closed ? (look.fill ?? "none") : "none",
      "fill-opacity": look.opacity ?? null,
      stroke: look.stroke ?? "none",
      "stroke-width": look.width ?? 1.2,
      "stroke-dasharray": look.dash ?? null,
      "stroke-linejoin": "round",
      "stroke-opacity": look.strokeOpacity ?? null,
    };
    const paths = (more) =>
      (layer.lines ?? []).map((line) =>
        s("path", { d: pathOf(line, layer.closed), "vector-effect": "non-scaling-stroke", ...more }),
      );
    layer.lineGroup = s(
      "g",
      style,
      look.halo ? paths({ stroke: look.halo, "stroke-width": (look.width ?? 1.2) + 1.6 }) : [],
      paths({}),
      layer.circle
        ? s("circle", {
            cx: layer.circle.centre[0],
            cy: layer.circle.centre[1],
            r: layer.circle.radius,
            "vector-effect": "non-scaling-stroke",
          })
        : null,
    );
    layer.markGroup = s("g", {});
    layer.group.replaceChildren(layer.lineGroup, layer.markGroup);
  }
  layer.lineGroup.setAttribute("transform", `translate(${m.left},${m.top}) scale(${m.scale},${-m.scale})`);
  if (layer.marks)
    layer.markGroup.replaceChildren(
      ...layer.marks.map((item) => mark(item, m.left + m.scale * item.at[0], m.top - m.scale * item.at[1])),
    );
}

/** A sign of fixed size at a place, with a text beside it. */
function mark(item, x, y) {
  const shapes = {
    dot: () => s("circle", { r: 4, fill: item.colour ?? INK, stroke: "white", "stroke-width": 1.2 }),
    ring: () => s("circle", { r: 4.2, fill: "white", stroke: item.colour ?? INK, "stroke-width": 1.8 }),
    cross: () =>
      s("path", { d: "M-4,-4L4,4M-4,4L4,-4", fill: "none", stroke: item.colour ?? INK, "stroke-width": 2 }),
    level: () =>
      s("path", { d: "M0,0L-6,-9H6Z", fill: "white", stroke: item.colour ?? INK, "stroke-width": 1.3 }),
    none: () => null,
  };
  const text = item.text
    ? s(
        "text",
        {
          x: item.dx ?? 8,
          y: item.dy ?? -6,
          "text-anchor": item.anchor ?? "start",
          "font-size": 11.5,
          fill: item.colour ?? INK,
          stroke: "white",
          "stroke-width": 3,
          "paint-order": "stroke",
          "stroke-linejoin": "round",
        },
        item.text,
      )
    : null;
  return s("g", { transform: `translate(${x},${y})` }, shapes[item.shape ?? "dot"](), text);
}
