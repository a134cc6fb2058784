// SPDX-License-Identifier: GPL-3.0-or-later
// The case as berm understood it.
import { AMBER, ORANGE } from "./colours.js";
import { chapter, facts, h, table } from "./dom.js";
import { number, plain, point } from "./numbers.js";
import { boundaryLayers, boxOf, outlineLayers, poolLayers, seepageLayers, soilLayers } from "./section.js";
import { View } from "./view.js";

const WATER = {
  none: "none: the soil is dry",
  hydrostatic: "hydrostatic below a given or assumed line",
  seepage: "steady seepage, computed",
};
export const KINDS = {
  impervious: "impervious",
  head: "given head",
  seepage_face: "seepage face",
  inflow: "given inflow",
};

export function inputs({ result }) {
  const { section } = result;
  const view = new View({
    box: boxOf(section),
    title: "Section and soils as understood",
    bar: false,
    controls: [h("strong", { class: "figure-title" }, "Section as understood")],
  });
  const surface = result.stability?.free_surface_m ?? [];
  const regions = [
    ["search region", result.stability?.search_region_m, ORANGE],
    ["excluded region", result.stability?.exclude_region_m, AMBER],
  ];
  view.setLayers([
    ...poolLayers(section),
    ...soilLayers(result),
    ...outlineLayers(result),
    ...boundaryLayers(result),
    {
      label: "assumed water line",
      lines: surface.length ? [surface] : [],
      look: { stroke: ORANGE, width: 2, dash: "8 3 2 3" },
    },
    ...regions.map(([label, polygons, stroke]) => ({
      label,
      lines: polygons ?? [],
      closed: true,
      look: { stroke, width: 1.6, dash: "5 3", fill: "none" },
    })),
    ...seepageLayers({
      ...result,
      seepage: result.seepage && { ...result.seepage, phreatic_lines_m: [], exit_point_m: null },
    }),
  ]);
  return chapter(
    "section",
    "Section, soils and water",
    view.root,
    scene(result),
    soils(result),
    boundaries(result),
  );
}

function scene(result) {
  const { section, inputs: given } = result,
    s = result.stability;
  return facts([
    [
      "Section",
      `${plain(section.x_max_m - section.x_min_m)} m wide, ${plain(section.y_max_m - section.y_min_m)} m high, ${number(section.area_m2, 5)} m²`,
    ],
    ["Pore pressure", WATER[given.pore_pressure]],
    section.left_level_m !== null && ["Left pool", `level ${plain(section.left_level_m)} m`],
    section.right_level_m !== null && ["Right pool", `level ${plain(section.right_level_m)} m`],
    section.overflow_crest_m && ["Overflow", `over the crest at ${point(section.overflow_crest_m)} m`],
    given.rain_m_s > 0 && ["Rain", `${number(given.rain_m_s, 3)} m/s`],
    s && ["Particles", `${s.particles} at ${plain(s.spacing_m)} m, packed in ${s.packing}`],
    result.case.overrides.length > 0 && ["Set on the command line", result.case.overrides.join("; ")],
  ]);
}

const conductivity = (k) =>
  k === null ? null : k[0] === k[1] ? plain(k[0]) : `${plain(k[0])} / ${plain(k[1])}`;

function soils(result) {
  const list = result.inputs.soils,
    any = (key) => list.some((soil) => soil[key] !== null);
  const columns = [
    ["Soil", (x) => x.name],
    ["γ [kN/m³]", (x) => plain(x.unit_weight_kN_m3)],
    ["γ sat [kN/m³]", (x) => plain(x.saturated_unit_weight_kN_m3)],
    ["c′ [kPa]", (x) => plain(x.cohesion_kPa)],
    ["φ′ [°]", (x) => plain(x.friction_angle_deg)],
    ["ψ [°]", (x) => plain(x.dilation_angle_deg)],
    any("tensile_strength_kPa") && ["tensile strength [kPa]", (x) => plain(x.tensile_strength_kPa)],
    ["E [MPa]", (x) => plain(x.young_modulus_kPa / 1e3)],
    ["ν [-]", (x) => plain(x.poisson_ratio)],
    any("conductivity_m_s") && ["k or kx / ky [m/s]", (x) => conductivity(x.conductivity_m_s)],
    list.some((x) => x.conductivity_angle_deg) && ["turned by [°]", (x) => plain(x.conductivity_angle_deg)],
    list.some((x) => x.retention && x.retention !== "sharp") && [
      "retention",
      (x) => x.retention?.replace("_", " "),
    ],
  ].filter(Boolean);
  return [
    h("h3", {}, "Soils"),
    table(
      columns.map(([title], i) => ({ title, number: i > 0 })),
      list.map((soil) => columns.map(([, of]) => of(soil))),
      "Soils",
    ),
  ];
}

function boundaries(result) {
  const list = result.inputs.boundaries;
  if (!list.length) return null;
  const value = (b) =>
    b.kind === "head" ? `${plain(b.value)} m` : b.kind === "inflow" ? `${plain(b.value)} m/s` : null;
  return [
    h("h3", {}, "Boundaries given on lines"),
    table(
      [
        { title: "No.", number: true },
        { title: "Kind" },
        { title: "Value", number: true },
        { title: "Along [m]" },
      ],
      list.map((b, i) => [
        String(i + 1),
        KINDS[b.kind] ?? b.kind,
        value(b),
        b.line_m.map((p) => `(${plain(p[0])}, ${plain(p[1])})`).join(" "),
      ]),
      "Boundaries",
    ),
  ];
}
