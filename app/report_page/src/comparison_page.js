// SPDX-License-Identifier: GPL-3.0-or-later
// The same soil under different waters: what the assumption about the water is worth.
import { bracketText, notices, rangeText } from "./answer.js";
import { alongLine } from "./along.js";
import { chart } from "./chart.js";
import { BLUE, colourScale, GREY, ORANGE, PURPLE, SKY } from "./colours.js";
import { chapter, choice, h, table } from "./dom.js";
import { differenceField, extremes, particleFields } from "./fields.js";
import { factor, fixed, number, signed } from "./numbers.js";
import { provenance } from "./provenance.js";
import { ruler } from "./ruler.js";
import { header } from "./run_page.js";
import { boxOf, outlineLayers, poolLayers } from "./section.js";
import { lazily } from "./unpack.js";
import { View } from "./view.js";

const LOOKS = {
  seepage: [BLUE, null],
  phreatic: [PURPLE, "9 4"],
  hydrostatic: [ORANGE, "9 3 2 3"],
  dry: [GREY, "2 3"],
};
const OTHER = [SKY, "4 4"];

export function comparisonPage(data, page) {
  const { comparison } = data;
  const waters = comparison.waters.map((water, i) => ({
    ...water,
    result: data.waters[i].result,
    particles: data.waters[i].particles && lazily(data.waters[i].particles),
    colour: (LOOKS[water.name] ?? OTHER)[0],
    dash: (LOOKS[water.name] ?? OTHER)[1],
  }));
  document.title = `${comparison.title} – berm comparison`;
  const chapters = [
    ["answer", "Answer"],
    ["lines", "Slip lines"],
    ["pressure", "Pore pressure"],
    ["provenance", "Provenance"],
  ];
  const contents = [
    answer(comparison, waters),
    lines(waters),
    pressures(comparison, waters),
    provenance(data),
  ];
  const there = chapters.filter((_, i) => contents[i]);
  page.append(
    header(comparison.title, there, "comparison: the same soil under different waters"),
    ...contents.filter(Boolean),
  );
}

const STOPPED = "Partial: the comparison was stopped; here are the waters that it reached.";
const solved = (water) => water.complete && water.factor !== null;

function answer(comparison, waters) {
  const base = waters[0];
  const stopped = waters.some((w) => w.result.interrupted);
  const warnings = waters.flatMap((w) => (w.result.warnings ?? []).map((text) => `${w.title}: ${text}`));
  const columns = [
    { title: "Water" },
    num("F"),
    { title: "bracket" },
    { title: "may lie" },
    num("ΔF to seepage"),
    num("slip line: mean Δu [kPa]"),
    num("soil: mean Δu [kPa]"),
    { title: "report" },
  ];
  return h(
    "section",
    { id: "answer", "aria-label": "Answer" },
    notices({ complete: waters.every(solved) && !stopped, warnings }, stopped ? STOPPED : null),
    headline(comparison, waters),
    waters.some(solved) &&
      ruler(
        waters.map((w) => ({
          label: w.title,
          colour: w.colour,
          factor: solved(w) ? w.factor : null,
          stands: w.result.stability?.stands,
          fails: w.result.stability?.fails,
          low: w.low,
          high: w.high,
          marks: bishop(w),
        })),
        "Factors of safety of each water",
      ),
    h(
      "p",
      { class: "note" },
      "Dark: the bracket, both ends of which were tried. Pale: where F may lie by bracket and spacing. Diamonds: Bishop on the critical circle, to compare with.",
    ),
    table(
      columns,
      waters.map((w) => [
        h("span", {}, h("span", { class: "dot", style: `background:${w.colour}` }), w.title),
        solved(w) ? h("strong", {}, factor(w.factor)) : "no answer",
        bracket(w.result.stability),
        w.low === null ? null : `${factor(w.low)} to ${factor(w.high)}`,
        w === base || !solved(w) || !solved(base) ? null : signed(w.factor - base.factor, 3),
        signed(w.seepage_minus_this.slip_line?.mean_kPa ?? null, 2),
        signed(w.seepage_minus_this.soil?.mean_kPa ?? null, 2),
        h("a", { href: `${encodeURIComponent(w.directory)}/report.html` }, "open its report"),
      ]),
      "Waters",
    ),
    h(
      "p",
      { class: "note" },
      "Δu: pore pressure of the seepage minus this one; positive: this assumption leaves pressure out.",
    ),
  );
}
const bracket = (s) =>
  s?.stands && s.fails
    ? `${factor(s.stands)} to ${factor(s.fails)}`
    : (s && (bracketText(s) || s.reason)) || null;
const bishop = (w) =>
  w.result.stability?.limit_equilibrium
    ? [
        {
          at: w.result.stability.limit_equilibrium.bishop,
          text: `Bishop ${factor(w.result.stability.limit_equilibrium.bishop)}`,
        },
      ]
    : [];
const num = (title) => ({ title, number: true });

/** What the usual assumption would have said, in a sentence. */
function headline(comparison, waters) {
  const [base] = waters,
    assumed = waters.find((w) => w.name === "hydrostatic"),
    above = comparison.phreatic_line_above_assumed_line;
  const card = (look, water, ...lines) =>
    h(
      "div",
      { class: `card ${look}` },
      h("p", { class: "card-name" }, water.title),
      h(
        "p",
        { class: "card-value", id: `factor-${water.name}` },
        solved(water) ? `F = ${factor(water.factor)}` : "no answer",
      ),
      lines.filter(Boolean).map((l) => h("p", {}, l)),
    );
  const cards = waters.map((w) => {
    if (w === base)
      return card(
        solved(w) ? "main" : "main none",
        w,
        w.result.stability && bracketText(w.result.stability),
        w.low !== null && rangeText(w.result.stability?.uncertainty),
      );
    if (!solved(w) || !solved(base)) return card("", w);
    const percent = 100 * (w.factor / base.factor - 1);
    return card(
      "",
      w,
      `${fixed(Math.abs(percent), 1)} % ${percent > 0 ? "higher than with seepage" : "lower than with seepage"}`,
    );
  });
  const texts = [];
  if (assumed && solved(assumed) && solved(base)) {
    const d = assumed.factor - base.factor;
    texts.push(
      `With the water where steady seepage puts it, F = ${factor(base.factor)}. Hydrostatic pressure below the straight line gives ${factor(assumed.factor)}: ${factor(Math.abs(d))} ${d > 0 ? "too high, on the unsafe side" : "lower, on the safe side"}.`,
    );
  }
  if (above)
    texts.push(
      `The phreatic line lies above the assumed line by ${fixed(above.mean_m, 2)} m in the mean, at most by ${fixed(above.largest_m, 2)} m at x = ${fixed(above.at_x_m, 1)} m.`,
    );
  const along = assumed?.seepage_minus_this.slip_line;
  if (along)
    texts.push(
      `Along the slip line, the water presses harder by ${fixed(along.mean_kPa, 1)} kPa in the mean than that line says (from ${signed(along.smallest_kPa, 1)} to ${signed(along.largest_kPa, 1)} kPa).`,
    );
  return [h("p", { class: "lead" }, texts.join(" ")), h("div", { class: "cards" }, cards)];
}

function waterLayers(waters) {
  const flow = waters[0].result.seepage;
  return [
    {
      label: "phreatic line of the seepage",
      lines: flow?.phreatic_lines_m ?? [],
      look: { stroke: BLUE, width: 1.6 },
    },
    ...waters
      .filter((w) => w.name === "hydrostatic")
      .map((w) => ({
        label: "assumed straight line",
        lines: [w.result.stability?.free_surface_m ?? []].filter((l) => l.length),
        look: { stroke: ORANGE, width: 1.6 },
      })),
  ];
}

const slipLines = (waters, width = 2.6) =>
  waters.map((w) => ({
    label: `slip line, ${w.title}${solved(w) ? `: F = ${factor(w.factor)}` : ": no answer"}`,
    lines: [w.result.stability?.mechanism?.slip_line_m ?? []].filter((l) => l.length),
    look: { stroke: w.colour, dash: w.dash, width },
  }));

function lines(waters) {
  const base = waters[0].result;
  const view = new View({
    box: boxOf(base.section),
    title: "Slip lines and water lines",
    controls: [h("strong", { class: "figure-title" }, "Slip lines and water lines")],
    bar: false,
  });
  view.root.id = "lines-view";
  view.setLayers([
    ...poolLayers(base.section),
    ...outlineLayers(base),
    ...waterLayers(waters),
    ...slipLines(waters),
  ]);
  const rows = waters.map((w) => {
    const m = w.result.stability?.mechanism,
      c = w.result.stability?.limit_equilibrium;
    return [
      w.title,
      m ? `${m.kind}, ${m.side}` : null,
      m ? fixed(m.depth_m, 2) : null,
      m ? number(m.volume_m2, 4) : null,
      c ? factor(c.bishop) : null,
      c ? factor(c.spencer) : null,
    ];
  });
  return chapter(
    "lines",
    "How it fails",
    view.root,
    table(
      [
        { title: "Water" },
        { title: "mechanism" },
        num("depth [m]"),
        num("volume [m³/m]"),
        num("Bishop"),
        num("Spencer"),
      ],
      rows,
      "Mechanisms",
    ),
    h(
      "p",
      { class: "note" },
      "Bishop and Spencer: limit equilibrium on the critical circle under the same water, to compare with.",
    ),
  );
}

/** Pore pressure of each water along the slip line that the slope has under seepage. */
function profile(waters) {
  const [base] = waters,
    line = base.result.stability?.mechanism?.slip_line_m;
  if (!line || !base.particles) return null;
  const shown = waters.filter((w) => w.particles && extremes(w.particles.pore_pressure)[1] > 0);
  const curves = alongLine(
    base.particles,
    shown.map((w) => w.particles.pore_pressure),
    line,
    2.2 * base.result.stability.spacing_m,
  );
  const series = shown.map((w, k) => ({
    label: w.title,
    colour: w.colour,
    dash: w.dash,
    width: 2.2,
    points: curves[k].map(([d, p]) => [d, Math.max(0, p) / 1e3]),
  }));
  return chart({
    title: "Pore pressure along the slip line under seepage",
    x: { title: `distance along the slip line, from its upper end [m]` },
    y: { title: "pore pressure [kPa]" },
    series,
  });
}

/** Pressure of the seepage minus another one, each pressure, and the strain of each failing state. */
function pressures(comparison, waters) {
  const [base] = waters,
    others = waters
      .slice(1)
      .filter((w) => w.particles && base.particles && w.particles.x.length === base.particles.x.length);
  if (!others.length) return null;
  const minus = (w) =>
    Float64Array.from(base.particles.pore_pressure, (p, i) => (p - w.particles.pore_pressure[i]) / 1e3);
  const most = Math.max(
    1e-3,
    ...waters.filter((w) => w.particles).map((w) => extremes(w.particles.pore_pressure)[1] / 1e3),
  );
  const fields = {};
  const options = {};
  for (const w of others) {
    options[`minus-${w.name}`] = `seepage minus ${w.name === "dry" ? "no water" : w.title}`;
    fields[`minus-${w.name}`] = () =>
      differenceField(base.result, base.particles, minus(w), `Pore pressure: seepage minus ${w.title} [kPa]`);
  }
  for (const w of waters.filter((x) => x.particles)) {
    if (extremes(w.particles.pore_pressure)[1] > 0)
      options[`pressure-${w.name}`] = `pore pressure, ${w.title}`;
    fields[`pressure-${w.name}`] = () => {
      const field = particleFields(w.result, w.particles, null).pressure();
      return { ...field, title: `Pore pressure, ${w.title} [kPa]`, colours: colourScale("water", [0, most]) };
    };
    const failing = w.particles.states.failing;
    if (!failing) continue;
    options[`strain-${w.name}`] = `plastic strain at failure, ${w.title}`;
    fields[`strain-${w.name}`] = () => {
      const field = particleFields(w.result, w.particles, lazily(failing)).strain();
      return { ...field, title: `Plastic strain at failure, ${w.title} [-]` };
    };
  }
  const first = options["minus-hydrostatic"] ? "minus-hydrostatic" : Object.keys(options)[0];
  const view = new View({
    box: boxOf(base.result.section),
    title: "Pore pressure compared",
    controls: [
      h("strong", { class: "figure-title" }, "Pore pressure"),
      choice("Show", options, (name) => view.setField(fields[name]()), first),
    ],
  });
  view.root.id = "pressure-view";
  view.setField(fields[first]());
  view.setLayers([
    ...poolLayers(base.result.section),
    ...outlineLayers(base.result),
    ...waterLayers(waters),
    ...slipLines(waters, 2).map((l, i) => ({ ...l, on: i === 0 })),
  ]);
  const row = (w, where, d) =>
    d && [
      w.title,
      where,
      signed(d.mean_kPa, 2),
      fixed(d.rms_kPa, 2),
      signed(d.smallest_kPa, 2),
      signed(d.largest_kPa, 2),
    ];
  const rows = others
    .flatMap((w) => [
      row(w, "along the slip line under seepage", w.seepage_minus_this.slip_line),
      row(w, "in all soil", w.seepage_minus_this.soil),
    ])
    .filter(Boolean);
  return chapter(
    "pressure",
    "What the water does",
    view.root,
    h(
      "p",
      { class: "note" },
      "In the differences, orange: the seepage presses harder than the other water says, so that leaving it out is on the unsafe side; purple: less hard. The same particles carry both.",
    ),
    profile(waters),
    h("h3", {}, "Seepage pressure minus the other"),
    table(
      [
        { title: "Other water" },
        { title: "where" },
        num("mean [kPa]"),
        num("rms [kPa]"),
        num("smallest [kPa]"),
        num("largest [kPa]"),
      ],
      rows,
      "Pressure differences",
    ),
  );
}
