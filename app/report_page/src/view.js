// SPDX-License-Identifier: GPL-3.0-or-later
// A view of the section, true to scale: a field in pixels, lines and marks over it, axes in metres.
import { axisBottom, axisLeft } from "d3-axis";
import { scaleLinear } from "d3-scale";
import { select } from "d3-selection";
import { zoom, zoomIdentity } from "d3-zoom";
import { axisName, styleAxis } from "./axes.js";
import { drawBar } from "./colour_bar.js";
import { h, s } from "./dom.js";
import { drawLayer, swatchOf } from "./layers.js";
import { fixed } from "./numbers.js";
import { followWidth } from "./paper.js";
import { Raster } from "./raster.js";
import { saveButtons } from "./save.js";

const MARGIN = { left: 46, right: 14, top: 12, bottom: 40 };
const BAR = 52,
  BAR_NARROW = 68; // height of the colour bar with its text
let views = 0;

export class View {
  /**
   * box: { x: [min, max], y: [min, max] } that the view shows at first [m]; title: for files and
   * screen readers; controls: elements above the picture.
   */
  constructor({ box, title, controls = [], bar = true }) {
    Object.assign(this, { box, title, field: null, layers: [], hasBar: bar, transform: zoomIdentity });
    this.id = `view-${++views}`;
    this.canvas = h("canvas", { "aria-hidden": "true" });
    this.plotArea = s("g", { "clip-path": `url(#${this.id}-clip)` });
    this.clipBox = s("rect", {});
    this.axes = { x: s("g", { class: "axis" }), y: s("g", { class: "axis" }) };
    this.frame = s("rect", { fill: "none", stroke: "#9aa3a9" });
    this.barGroup = s("g", {});
    this.svg = s(
      "svg",
      { role: "img", "aria-label": title, tabindex: "0", class: "overlay" },
      s("defs", {}, s("clipPath", { id: `${this.id}-clip` }, this.clipBox)),
      this.plotArea,
      this.frame,
      this.axes.x,
      this.axes.y,
      this.barGroup,
    );
    this.readout = h("div", { class: "readout", hidden: true });
    this.stage = h("div", { class: "stage" }, this.canvas, this.svg, this.readout);
    this.legend = h("div", { class: "legend", role: "group", "aria-label": "Lines shown" });
    const button = (label, text, act) =>
      h("button", { type: "button", title: label, "aria-label": label, onclick: act }, text);
    const zoomButtons = h(
      "span",
      { class: "buttons" },
      button("Zoom in", "+", () => this.zoomBy(1.6)),
      button("Zoom out", "\u2212", () => this.zoomBy(1 / 1.6)),
      button("Show all", "\u2922", () => this.reset()),
    );
    this.root = h(
      "figure",
      { class: "view" },
      h(
        "div",
        { class: "controls" },
        controls,
        h("span", { class: "push" }),
        h("span", { class: "tools" }, zoomButtons, saveButtons(this)),
      ),
      this.stage,
      this.legend,
    );
    this.listen();
    followWidth(this.stage, (width) => this.layout(width));
  }

  listen() {
    this.zoom = zoom()
      .scaleExtent([1, 400])
      .filter((event) => {
        if (event.type === "wheel")
          return event.ctrlKey || event.metaKey || document.activeElement === this.svg;
        if (event.type === "touchstart") return event.touches.length > 1 || this.transform.k > 1;
        return !event.button && !event.ctrlKey;
      })
      .on("zoom", ({ transform }) => {
        this.transform = transform;
        this.svg.style.touchAction = transform.k > 1 ? "none" : "pan-y";
        this.redrawSoon();
      });
    select(this.svg).call(this.zoom).on("dblclick.zoom", null);
    this.svg.style.touchAction = "pan-y";
    this.svg.addEventListener("pointerdown", () => this.svg.focus({ preventScroll: true }));
    this.svg.addEventListener("pointermove", (event) => this.tell(event));
    this.svg.addEventListener("pointerleave", () => (this.readout.hidden = true));
    this.svg.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const by = 40 / this.transform.k;
    const moves = { ArrowLeft: [by, 0], ArrowRight: [-by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] };
    if (event.key === "+" || event.key === "=") this.zoomBy(1.6);
    else if (event.key === "-") this.zoomBy(1 / 1.6);
    else if (event.key === "0" || event.key === "Escape") this.reset();
    else if (moves[event.key] && this.transform.k > 1)
      select(this.svg).call(this.zoom.translateBy, ...moves[event.key]);
    else return;
    event.preventDefault();
  }

  zoomBy(k) {
    select(this.svg).call(this.zoom.scaleBy, k);
  }
  reset() {
    select(this.svg).call(this.zoom.transform, zoomIdentity);
  }

  /** field: { draw(raster), colours, title, tick(value), value(value) -> text }, or null. */
  setField(field) {
    this.field = field;
    this.redrawSoon();
  }

  /** Lines and marks over the field, from below upwards (layers.js). */
  setLayers(layers) {
    this.layers = layers.filter(
      (l) => (l.lines && l.lines.length) || (l.marks && l.marks.length) || l.circle,
    );
    this.plotArea.replaceChildren();
    this.legend.replaceChildren();
    for (const layer of this.layers) {
      layer.shown = layer.on ?? true;
      layer.group = s("g", { display: layer.shown ? null : "none" });
      this.plotArea.append(layer.group);
      if (layer.label) this.legend.append(this.legendItem(layer));
    }
    this.redrawSoon();
  }

  legendItem(layer) {
    const swatch = s(
      "svg",
      { width: 26, height: 12, "aria-hidden": "true", class: "swatch" },
      swatchOf(layer),
    );
    if (layer.fixed) return h("span", { class: "item" }, swatch, layer.label);
    const box = h("input", {
      type: "checkbox",
      checked: layer.shown,
      onchange: () => {
        layer.shown = box.checked;
        layer.group.setAttribute("display", box.checked ? "inline" : "none");
      },
    });
    return h("label", { class: "item" }, box, swatch, layer.label);
  }

  layout(width) {
    this.width = width;
    const { x, y } = this.box,
      plotWidth = width - MARGIN.left - MARGIN.right;
    const ratio = (y[1] - y[0]) / (x[1] - x[0]);
    const plotHeight = Math.round(Math.max(120, Math.min(plotWidth * ratio, 560)));
    this.plot = { width: plotWidth, height: plotHeight };
    this.height =
      MARGIN.top + plotHeight + MARGIN.bottom + (this.hasBar ? (plotWidth < 480 ? BAR_NARROW : BAR) : 0);
    this.fit = Math.min(plotWidth / (x[1] - x[0]), plotHeight / (y[1] - y[0]));
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.stage.style.aspectRatio = `${width} / ${this.height}`;
    const position = { x: MARGIN.left, y: MARGIN.top, width: plotWidth, height: plotHeight };
    for (const rect of [this.clipBox, this.frame])
      for (const [name, value] of Object.entries(position)) rect.setAttribute(name, value);
    Object.assign(this.canvas.style, {
      left: `${(100 * MARGIN.left) / width}%`,
      top: `${(100 * MARGIN.top) / this.height}%`,
      width: `${(100 * plotWidth) / width}%`,
      height: `${(100 * plotHeight) / this.height}%`,
    });
    const extent = [
      [MARGIN.left, MARGIN.top],
      [MARGIN.left + plotWidth, MARGIN.top + plotHeight],
    ];
    this.zoom.extent(extent).translateExtent(extent);
    this.redraw();
  }

  redrawSoon() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.redraw();
    });
  }

  /** Pixel = scale * x + left, top - scale * y, in the SVG's coordinates. */
  mapping() {
    const { x, y } = this.box,
      { k, x: tx, y: ty } = this.transform;
    const left = MARGIN.left + (this.plot.width - this.fit * (x[1] - x[0])) / 2 - this.fit * x[0];
    const top = MARGIN.top + (this.plot.height - this.fit * (y[1] - y[0])) / 2 + this.fit * y[1];
    return { scale: k * this.fit, left: k * left + tx, top: k * top + ty };
  }

  redraw() {
    if (!this.plot) return;
    const m = (this.map = this.mapping());
    this.drawField(m);
    for (const layer of this.layers) drawLayer(layer, m);
    const { width, height } = this.plot;
    const xs = scaleLinear(
      [(MARGIN.left - m.left) / m.scale, (MARGIN.left + width - m.left) / m.scale],
      [MARGIN.left, MARGIN.left + width],
    );
    const ys = scaleLinear(
      [(m.top - MARGIN.top - height) / m.scale, (m.top - MARGIN.top) / m.scale],
      [MARGIN.top + height, MARGIN.top],
    );
    styleAxis(
      select(this.axes.x)
        .attr("transform", `translate(0,${MARGIN.top + height})`)
        .call(
          axisBottom(xs)
            .ticks(Math.max(3, width / 90))
            .tickSizeOuter(0),
        ),
    );
    styleAxis(
      select(this.axes.y)
        .attr("transform", `translate(${MARGIN.left},0)`)
        .call(
          axisLeft(ys)
            .ticks(Math.max(2, height / 45))
            .tickSizeOuter(0),
        ),
    );
    axisName(this.axes.x, "x [m]", MARGIN.left + width / 2, 33, 0);
    axisName(this.axes.y, "y [m]", -MARGIN.top - height / 2, -34, -90);
    this.barGroup.replaceChildren();
    if (!this.field || !this.hasBar) return;
    const left = width < 480 ? 8 : MARGIN.left;
    drawBar(
      this.barGroup,
      this.field,
      left,
      MARGIN.top + height + MARGIN.bottom,
      Math.min(this.width - left - MARGIN.right, 520),
    );
  }

  drawField(m) {
    const density = Math.max(1.5, Math.min(2, window.devicePixelRatio || 1));
    const width = Math.round(this.plot.width * density),
      height = Math.round(this.plot.height * density);
    if (this.canvas.width !== width || this.canvas.height !== height)
      Object.assign(this.canvas, { width, height });
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, width, height);
    this.raster = null;
    if (!this.field) return;
    this.raster = new Raster(
      width,
      height,
      m.scale * density,
      (m.left - MARGIN.left) * density,
      (m.top - MARGIN.top) * density,
    );
    this.raster.density = density;
    this.field.draw(this.raster);
    context.putImageData(this.raster.image(this.field.colours), 0, 0);
  }

  tell(event) {
    if (!this.map || (event.pointerType === "touch" && !event.isPrimary)) return;
    const box = this.svg.getBoundingClientRect(),
      ratio = this.width / box.width;
    const px = (event.clientX - box.left) * ratio,
      py = (event.clientY - box.top) * ratio;
    const inside =
      px >= MARGIN.left &&
      px <= MARGIN.left + this.plot.width &&
      py >= MARGIN.top &&
      py <= MARGIN.top + this.plot.height;
    this.readout.hidden = !inside;
    if (!inside) return;
    const x = (px - this.map.left) / this.map.scale,
      y = (this.map.top - py) / this.map.scale;
    let text = `x ${fixed(x, 2)} m, y ${fixed(y, 2)} m`;
    if (this.raster) {
      const d = this.raster.density;
      const value =
        this.raster.values[
          Math.floor((py - MARGIN.top) * d) * this.raster.width + Math.floor((px - MARGIN.left) * d)
        ];
      if (value === value) text += `\n${this.field.value(value)}`;
    }
    this.readout.textContent = text;
    const right = px > this.width / 2;
    this.readout.style.left = right ? "" : `${(100 * (px + 14)) / this.width}%`;
    this.readout.style.right = right ? `${100 - (100 * (px - 14)) / this.width}%` : "";
    this.readout.style.top = `${(100 * Math.max(0, py - 44)) / this.height}%`;
  }
}
