// SPDX-License-Identifier: GPL-3.0-or-later
// A view or chart as a file of its own: SVG, or PNG at twice the size.
import { h, s } from "./dom.js";
import { swatchOf } from "./layers.js";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', Arial, sans-serif";

function standalone(view) {
  const svg = view.svg.cloneNode(true),
    width = view.width;
  const rows = [];
  let x = 12,
    y = view.height + 16;
  for (const layer of (view.layers ?? []).filter((l) => l.label && l.shown)) {
    const wide = 44 + 6.7 * layer.label.length;
    if (x > 12 && x + wide > width) [x, y] = [12, y + 18];
    rows.push(
      s(
        "g",
        { transform: `translate(${x},${y - 6})` },
        swatchOf(layer),
        s("text", { x: 31, y: 10, "font-size": 11.5, fill: "#1d2327" }, layer.label),
      ),
    );
    x += wide;
  }
  const height = rows.length ? y + 14 : view.height;
  for (const [name, value] of Object.entries({
    xmlns: "http://www.w3.org/2000/svg",
    viewBox: `0 -26 ${width} ${height + 26}`,
    width,
    height: height + 26,
    "font-family": FONT,
  }))
    svg.setAttribute(name, value);
  svg.prepend(
    s("rect", { x: 0, y: -26, width, height: height + 26, fill: "white" }),
    s("text", { x: 12, y: -8, "font-size": 14, "font-weight": 600, fill: "#1d2327" }, view.title),
    view.canvas && view.field
      ? s("image", {
          x: 46,
          y: 12,
          width: view.plot.width,
          height: view.plot.height,
          href: view.canvas.toDataURL("image/png"),
        })
      : s("g", {}),
  );
  svg.append(...rows);
  svg.querySelectorAll('g[transform*="scale"]').forEach(fixStrokes);
  return { text: new XMLSerializer().serializeToString(svg), width, height: height + 26 };
}

/** Widths in the drawing's own units: not every program knows strokes that do not scale. */
function fixStrokes(group) {
  const scale = Number(/scale\(([\d.e+-]+)/.exec(group.getAttribute("transform"))[1]);
  for (const element of [group, ...group.querySelectorAll("*")]) {
    element.removeAttribute("vector-effect");
    for (const name of ["stroke-width", "stroke-dasharray"]) {
      const value = element.getAttribute(name);
      if (value)
        element.setAttribute(
          name,
          value
            .split(/[ ,]+/)
            .map((v) => Number(v) / scale)
            .join(" "),
        );
    }
  }
}

function download(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const fileName = (view) =>
  view.title
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "-")
    .replace(/^-|-$/g, "");

function savePng(view) {
  const { text, width, height } = standalone(view);
  const image = new Image();
  image.onload = () => {
    const canvas = h("canvas", { width: 2 * width, height: 2 * height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0, 2 * width, 2 * height);
    canvas.toBlob((blob) => download(blob, `${fileName(view)}.png`), "image/png");
  };
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(text);
}

export const saveButtons = (view) =>
  h(
    "span",
    { class: "buttons" },
    h(
      "button",
      {
        type: "button",
        "aria-label": `Save as PNG: ${view.title}`,
        title: "Save this picture as PNG",
        onclick: () => savePng(view),
      },
      "PNG",
    ),
    h(
      "button",
      {
        type: "button",
        "aria-label": `Save as SVG: ${view.title}`,
        title: "Save this picture as SVG",
        onclick: () =>
          download(new Blob([standalone(view).text], { type: "image/svg+xml" }), `${fileName(view)}.svg`),
      },
      "SVG",
    ),
  );
