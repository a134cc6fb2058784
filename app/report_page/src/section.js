// SPDX-License-Identifier: GPL-3.0-or-later
// What every view shares: the section as understood, as layers of lines and marks.
import { AMBER, BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY, soilColour } from "./colours.js";
import { number, plain } from "./numbers.js";

const WALLS = {
  impervious: { stroke: INK, label: "wall" },
  head: { stroke: PURPLE, label: "line of given head" },
  seepage_face: { stroke: GREEN, label: "drain" },
  inflow: { stroke: AMBER, label: "line of inflow" },
};
const BOUNDARIES = {
  impervious: [INK, "impervious"],
  head: [PURPLE, "given head"],
  seepage_face: [GREEN, "seepage face"],
  inflow: [AMBER, "inflow"],
};

/** The view's box: the section with a little air, and room for `more` points. */
export function boxOf(section, more = []) {
  const xs = [section.x_min_m, section.x_max_m, ...more.map((p) => p[0])];
  const ys = [section.y_min_m, section.y_max_m, ...more.map((p) => p[1])];
  for (const level of [section.left_level_m, section.right_level_m]) if (level !== null) ys.push(level);
  const range = (v, low, high) => {
    const a = Math.min(...v),
      b = Math.max(...v);
    return [a - low * (b - a), b + high * (b - a)];
  };
  return { x: range(xs, 0.01, 0.01), y: range(ys, 0.06, 0.14) };
}

/** Water on the ground from one end to where the ground rises above the level, or to the crest. */
function pool(section, side) {
  const level = section[`${side}_level_m`],
    crest = section.overflow_crest_m;
  if (level === null) return null;
  const ground = side === "left" ? section.ground_m : [...section.ground_m].reverse();
  const wet = [ground[0]];
  for (let i = 1; i < ground.length; ++i) {
    const a = ground[i - 1],
      b = ground[i];
    if (crest && level > crest[1] && a[0] === crest[0] && a[1] === crest[1]) break;
    if (b[1] > level) {
      const t = (level - a[1]) / (b[1] - a[1]);
      wet.push([a[0] + t * (b[0] - a[0]), level]);
      break;
    }
    wet.push(b);
  }
  return [[wet[0][0], level], ...wet, [wet[wet.length - 1][0], level]];
}

export function poolLayers(section) {
  const pools = ["left", "right"].map((side) => pool(section, side)).filter(Boolean);
  return [
    { lines: pools, closed: true, look: { fill: SKY, opacity: 0.35 } },
    { lines: pools.map((p) => [p[0], p[p.length - 1]]), look: { stroke: BLUE, width: 1.4 } },
    {
      marks: pools.map((p) => ({
        at: [p[0][0] + 0.35 * (p[p.length - 1][0] - p[0][0]), p[0][1]],
        shape: "level",
        colour: BLUE,
        text: `${plain(p[0][1])} m`,
        dx: 10,
        dy: -3,
      })),
    },
  ];
}

export function outlineLayers(result) {
  const { section } = result;
  const layers = [
    { lines: [section.outline_m], closed: true, look: { stroke: INK, width: 1.4, fill: "none" } },
  ];
  const zones = result.inputs?.zones ?? [];
  if (zones.length)
    layers.push({
      lines: zones.map((z) => z.polygon_m),
      closed: true,
      look: { stroke: INK, width: 0.8, dash: "4 2", fill: "none" },
    });
  for (const [kind, { stroke, label }] of Object.entries(WALLS)) {
    const lines = section.inner_lines.filter((l) => l.kind === kind).map((l) => l.line_m);
    layers.push({ lines, label, fixed: true, look: { stroke, width: 4 } });
  }
  return layers;
}

/** Filled zones, one tint a soil. The first soil covers what no zone covers. */
export function soilLayers(result) {
  const soils = result.inputs.soils,
    zones = result.inputs.zones,
    index = (name) => soils.findIndex((soil) => soil.name === name);
  const used = new Set(zones.map((zone) => zone.soil));
  const first = {
    lines: [result.section.outline_m],
    closed: true,
    label: soils[0]?.name,
    fixed: true,
    look: { fill: soilColour(0), stroke: "none" },
  };
  const others = zones.map((zone, i) => ({
    lines: [zone.polygon_m],
    closed: true,
    fixed: true,
    look: { fill: soilColour(index(zone.soil)), stroke: GREY, width: 0.6 },
    label:
      zones.findIndex((other) => other.soil === zone.soil) === i &&
      used.has(zone.soil) &&
      index(zone.soil) > 0
        ? zone.soil
        : null,
  }));
  return [first, ...others];
}

export function boundaryLayers(result) {
  const inner = new Set(result.section.inner_lines.map((line) => JSON.stringify(line.line_m)));
  const list = (result.inputs?.boundaries ?? []).filter((b) => !inner.has(JSON.stringify(b.line_m)));
  return Object.entries(BOUNDARIES).map(([kind, [stroke, label]]) => ({
    label,
    fixed: true,
    look: { stroke, width: 3.5, dash: kind === "seepage_face" ? "7 3" : null },
    lines: list.filter((b) => b.kind === kind).map((b) => b.line_m),
  }));
}

/** Water lines, exit point, probes, the user's lines. */
export function seepageLayers(result, on = true) {
  const flow = result.seepage;
  if (!flow) return [];
  const probes = flow.probes.map((p, i) => ({
    at: [p.x_m, p.y_m],
    shape: "ring",
    colour: PURPLE,
    text: String(i + 1),
    dx: 6,
    dy: -5,
  }));
  return [
    { label: "phreatic line", lines: flow.phreatic_lines_m, look: { stroke: BLUE, width: 2.4 } },
    {
      label: "exit point",
      marks: flow.exit_point_m ? [{ at: flow.exit_point_m, shape: "dot", colour: ORANGE }] : [],
    },
    { label: "probes", marks: probes, on },
    {
      label: "lines read",
      lines: flow.lines.map((l) => l.points_m),
      look: { stroke: PURPLE, width: 1.8, dash: "6 3" },
      marks: flow.lines.map((l) => ({
        at: l.points_m[0],
        shape: "none",
        colour: PURPLE,
        text: l.name,
        dx: 4,
        dy: -4,
      })),
      on,
    },
  ];
}

/** Slip line, fitted circle and the critical circle of limit equilibrium. */
export function slipLayers(result, found, which = "") {
  const layers = [],
    circle = found?.limit_equilibrium,
    mechanism = found?.mechanism;
  if (circle)
    layers.push({
      label: `critical circle, limit equilibrium (Bishop ${number(circle.bishop, 4)})${which}`,
      lines: [arc(circle, result.section)],
      look: { stroke: GREEN, width: 1.8, dash: "7 4" },
    });
  if (mechanism) {
    layers.push({
      label: `slip line${which}`,
      lines: [mechanism.slip_line_m],
      look: { stroke: ORANGE, width: 2.6 },
    });
    if (mechanism.circle)
      layers.push({
        label: `circle fitted to the slip line${which}`,
        circle: { centre: mechanism.circle.centre_m, radius: mechanism.circle.radius_m },
        look: { stroke: ORANGE, width: 1, dash: "2 3" },
        on: false,
      });
  }
  return layers;
}

/** The part of a slip circle below the ground. */
function arc(circle, section) {
  const {
      centre_m: [cx, cy],
      radius_m: r,
    } = circle,
    n = 120,
    ground = section.ground_m;
  const points = [];
  for (let i = 0; i <= n; ++i) {
    const x = circle.x_left_m + ((circle.x_right_m - circle.x_left_m) * i) / n;
    const under = cy - Math.sqrt(Math.max(0, r * r - (x - cx) ** 2));
    points.push([x, Math.min(under, levelAt(ground, x))]);
  }
  return points;
}

function levelAt(line, x) {
  for (let i = 1; i < line.length; ++i) {
    const [ax, ay] = line[i - 1],
      [bx, by] = line[i];
    if (x <= bx && bx > ax) return ay + ((x - ax) / (bx - ax)) * (by - ay);
  }
  return line[line.length - 1][1];
}
