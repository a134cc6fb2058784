// SPDX-License-Identifier: GPL-3.0-or-later
import { BLUE, GREEN, GREY, ORANGE, PURPLE } from "./colours.js";
import { chart } from "./chart.js";
import { contours, evenLevels, roundLevels } from "./contours.js";
import { chapter, choice, facts, h, table } from "./dom.js";
import { extremes, meshFields, MESH_FIELDS } from "./fields.js";
import { KINDS } from "./inputs.js";
import { fixed, number, plain, point } from "./numbers.js";
import { boxOf, outlineLayers, poolLayers, seepageLayers } from "./section.js";
import { lazily } from "./unpack.js";
import { View } from "./view.js";

const TUBES = 10; // stream tubes of equal discharge

export function seepage({ result, mesh, tables }) {
  const flow = result.seepage;
  return chapter(
    "seepage",
    "Seepage",
    picture(result, lazily(mesh)),
    summary(flow),
    stretches(result),
    probes(flow),
    gradients(result, tables),
    lines(flow, tables),
    meshes(flow),
  );
}

function picture(result, mesh) {
  // Without a fringe, what the solve says above the phreatic line is no water's head.
  const sharp = result.inputs.soils.every((soil) => soil.retention === "sharp");
  const fields = meshFields(mesh, sharp);
  const view = new View({
    box: boxOf(result.section),
    title: "Seepage",
    controls: [
      h("strong", { class: "figure-title" }, "Seepage"),
      choice("Field", MESH_FIELDS, (name) => view.setField(fields[name]()), "head"),
    ],
  });
  view.root.id = "seepage-view";
  view.setField(fields.head());
  view.setLayers([
    ...poolLayers(result.section),
    ...netLayers(mesh, sharp),
    ...outlineLayers(result),
    ...seepageLayers(result),
    ...heaveMarks(result.seepage),
  ]);
  return [
    view.root,
    h(
      "p",
      { class: "note" },
      "Click the picture, then the wheel zooms and dragging moves it; or hold Ctrl over it; on a telephone, two fingers zoom. With the keyboard: + and \u2212, arrows, 0 for all.",
    ),
  ];
}

/** Equipotentials, and stream lines between tubes of equal discharge. */
function netLayers(mesh, sharp) {
  const [low, high] = extremes(mesh.head),
    levels = roundLevels(low, high, 16);
  const layers = [
    {
      label: levels.length > 1 ? `equipotentials, every ${plain(levels[1] - levels[0])} m` : "equipotentials",
      lines: contours(mesh, mesh.head, levels, sharp ? mesh.pore_pressure : null).flat(),
      look: { stroke: "#16191c", width: 1, halo: "rgba(255,255,255,0.4)" },
    },
  ];
  if (mesh.stream_function) {
    const [least, most] = extremes(mesh.stream_function);
    layers.push({
      label: `stream lines, ${number((most - least) / TUBES, 3)} m²/s between two`,
      lines: contours(mesh, mesh.stream_function, evenLevels(least, most, TUBES)).flat(),
      look: { stroke: "white", width: 1.3, halo: "rgba(20,30,40,0.4)" },
    });
  }
  return layers;
}

function heaveMarks(flow) {
  const places = flow.exit_gradients
    .filter((o) => o.at_m)
    .map((o) => ({ at: o.at_m, shape: "cross", colour: ORANGE }));
  return [{ label: "largest exit gradient", marks: places }];
}

function summary(flow) {
  const e = flow.estimated_error ?? {};
  return facts([
    [
      "Discharge",
      `${number(flow.discharge_m2_s)} m²/s per metre run${e.discharge_m2_s ? `, \u00b1 ${number(e.discharge_m2_s, 2)}` : ""}`,
    ],
    [
      "Exit point",
      flow.exit_point_m
        ? `${point(flow.exit_point_m)} m${e.exit_point_m ? `, \u00b1 ${number(e.exit_point_m, 2)} m` : ""}`
        : "none: no free surface ends on a seepage face",
    ],
    flow.phreatic_lines_m.length
      ? [
          "Phreatic line",
          `${flow.phreatic_lines_m.length === 1 ? "one" : flow.phreatic_lines_m.length}${e.phreatic_line_m ? `, \u00b1 ${number(e.phreatic_line_m, 2)} m in the mean` : ""}`,
        ]
      : ["Phreatic line", "none inside the soil"],
    e.head_m && [
      "Estimated error of heads",
      `${number(e.head_m, 2)} m at most${e.within_tolerance ? "" : "; more than the tolerance"}`,
    ],
    ["Water balance", `inflow and outflow differ by ${number(flow.balance, 2)} of the inflow`],
    flow.rain_m2_s > 0 && [
      "Rain",
      `${number(flow.rain_m2_s)} m²/s, of which ${number(flow.runoff_m2_s)} m²/s runs off`,
    ],
    ...heave(flow.heave),
  ]);
}

function heave(h) {
  if (!h || h.factor === null) return [];
  return [
    h.surface && [
      "Heave at the surface",
      `factor ${number(h.surface.factor, 4)}: upward gradient ${number(h.surface.gradient, 3)} of ${number(h.surface.critical_gradient, 3)} at ${point(h.surface.at_m)} m`,
    ],
    h.column && [
      "Heave of a column",
      `factor ${number(h.column.factor, 4)}: ${fixed(h.column.depth_m, 2)} m deep below ${point(h.column.at_m)} m, ${number(h.column.excess_head_m, 3)} m of excess head`,
    ],
  ];
}

/** "left pool"; "line 1, given head" for a boundary that the case gives on a line. */
function label(name, result) {
  const given = /^marked_(\d+)$/.exec(name),
    boundary = given && result.inputs.boundaries[given[1] - 1];
  return boundary ? `line ${given[1]}, ${KINDS[boundary.kind] ?? boundary.kind}` : name.replace(/_/g, " ");
}
const num = (title) => ({ title, number: true });

function stretches(result) {
  const flow = result.seepage;
  const rain = flow.stretches.some((x) => x.runoff_m2_s);
  return [
    h("h3", {}, "Water through each stretch of the outline"),
    table(
      [{ title: "Stretch" }, num("into the soil [m²/s]"), ...(rain ? [num("runs off [m²/s]")] : [])],
      flow.stretches.map((x) => [
        label(x.name, result),
        number(x.inflow_m2_s),
        ...(rain ? [number(x.runoff_m2_s)] : []),
      ]),
      "Stretches",
    ),
  ];
}

function probes(flow) {
  if (!flow.probes.length) return null;
  return [
    h("h3", {}, "Probes"),
    table(
      [num("No."), num("x [m]"), num("y [m]"), num("head [m]"), num("pore pressure [kPa]")],
      flow.probes.map((p, i) => [
        String(i + 1),
        fixed(p.x_m, 2),
        fixed(p.y_m, 2),
        fixed(p.head_m, 3),
        fixed(p.pore_pressure_kPa, 2),
      ]),
      "Probes",
    ),
  ];
}

/** A CSV of names and numbers as rows of objects. */
function parsed(text) {
  const [head, ...rows] = text
    .trim()
    .split("\n")
    .map((line) => line.split(","));
  return rows.map((row) =>
    Object.fromEntries(head.map((name, i) => [name, Number.isNaN(Number(row[i])) ? row[i] : Number(row[i])])),
  );
}

function gradients(result, tables) {
  const flow = result.seepage;
  if (!flow.exit_gradients.length) return null;
  const rows = flow.exit_gradients.map((o) => [
    label(o.stretch, result),
    `${point(o.from_m)} to ${point(o.to_m)}`,
    number(o.outflow_m2_s),
    number(o.gradient, 3),
    point(o.at_m),
    number(o.upward_gradient, 3),
    number(o.critical_gradient, 3),
    o.unbounded_at_m.map(point).join(" ") || "none",
  ]);
  const points = tables.exit_gradients ? parsed(tables.exit_gradients) : [];
  const colours = [BLUE, ORANGE, GREEN, PURPLE, GREY];
  const series = [...new Set(points.map((p) => p.outlet))].map((outlet, i) => {
    const own = points.filter((p) => p.outlet === outlet && p.counts);
    return {
      label: `outlet ${outlet}: ${label(String(own[0]?.stretch ?? ""), result)}`,
      colour: colours[i % colours.length],
      points: own.map((p) => [p.distance_m, p.normal_gradient]),
    };
  });
  return [
    h("h3", {}, "Where water leaves the soil"),
    table(
      [
        { title: "Stretch" },
        { title: "from, to [m]" },
        num("outflow [m²/s]"),
        num("largest gradient [-]"),
        num("at [m]"),
        num("upward there [-]"),
        num("critical [-]"),
        { title: "without bound at [m]" },
      ],
      rows,
      "Exit gradients",
    ),
    series.length
      ? chart({
          title: "Exit gradient along the outlet",
          x: {
            title:
              flow.exit_gradients.length === 1
                ? `distance along the outlet from ${point(flow.exit_gradients[0].from_m)} [m]`
                : "distance along each outlet [m]",
          },
          y: { title: "gradient [-]" },
          series,
          height: 220,
        })
      : null,
  ];
}

function lines(flow, tables) {
  if (!flow.lines.length) return null;
  const colours = [BLUE, ORANGE, GREEN, PURPLE, GREY];
  const series = flow.lines.map((line, i) => ({
    label: line.name,
    colour: colours[i % colours.length],
    points: tables.lines[i] ? parsed(tables.lines[i]).map((p) => [p.distance_m, p.pore_pressure_kPa]) : [],
  }));
  return [
    h("h3", {}, "Lines read"),
    table(
      [
        { title: "Line" },
        num("length [m]"),
        num("discharge to its left [m²/s]"),
        num("water pressure [kN/m]"),
        num("centre at [m]"),
      ],
      flow.lines.map((l) => [
        l.name,
        fixed(l.length_m, 2),
        number(l.discharge_m2_s),
        number(l.water_force.pressure_kN_m),
        point(l.water_force.at_m),
      ]),
      "Lines read",
    ),
    chart({
      title: "Pore pressure along the lines",
      x: { title: "distance along the line [m]" },
      y: { title: "pore pressure [kPa]" },
      series,
      height: 220,
    }),
  ];
}

function meshes(flow) {
  return h(
    "details",
    {},
    h(
      "summary",
      {},
      `Meshes: ${flow.meshes.length} solves, the last of ${flow.meshes[flow.meshes.length - 1].unknowns} unknowns`,
    ),
    table(
      [
        num("No."),
        num("unknowns"),
        { title: "solved from" },
        num("Newton steps"),
        num("changes of the wet face"),
        num("residual"),
        num("discharge [m²/s]"),
        num("time [s]"),
      ],
      flow.meshes.map((m, i) => [
        String(i + 1),
        String(m.unknowns),
        m.strategy,
        String(m.newton_steps),
        String(m.active_set_changes),
        number(m.residual, 2),
        number(m.discharge_m2_s, 6),
        fixed(m.seconds.solve, 2),
      ]),
      "Meshes",
    ),
  );
}
