// SPDX-License-Identifier: GPL-3.0-or-later
import { interpolateBlues, interpolateGreys, interpolateOranges } from "d3-scale-chromatic";
import { BLUE, GREY, ORANGE } from "./colours.js";
import { chart } from "./chart.js";
import { bracketText, rangeText } from "./answer.js";
import { chapter, choice, facts, h, table } from "./dom.js";
import { PARTICLE_FIELDS, particleFields } from "./fields.js";
import { factor, fixed, number, plain, point } from "./numbers.js";
import { boxOf, outlineLayers, poolLayers, seepageLayers, slipLayers } from "./section.js";
import { lazily } from "./unpack.js";
import { View } from "./view.js";

const SHADES = { stands: interpolateBlues, fails: interpolateOranges, undecided: interpolateGreys };
const LOOK = {
  stands: [BLUE, "dot", "stands"],
  fails: [ORANGE, "cross", "fails"],
  undecided: [GREY, "ring", "undecided"],
};

export function stability({ result, particles }) {
  const s = result.stability,
    searches = s.searches ?? [s];
  return chapter(
    "stability",
    "Stability",
    particles ? picture(result, lazily(particles)) : null,
    searches.map((found) => search(found, searches.length > 1)),
  );
}

const stateName = (name, state) =>
  name === "settled" ? "settled, F = 1" : `${name}, F = ${factor(state.factor)}`;

function picture(result, particles) {
  const states = Object.fromEntries(
    Object.entries(particles.states).map(([name, state]) => [name, lazily(state)]),
  );
  const names = Object.keys(states);
  if (!names.length) return null;
  const now = {
    state: states.failing ? "failing" : names[names.length - 1],
    field: states.failing ? "strain" : "vertical",
  };
  const show = () => view.setField(particleFields(result, particles, states[now.state])[now.field]());
  const there = particleFields(result, particles, states[now.state]);
  const view = new View({
    box: boxOf(result.section),
    title: "Stability",
    controls: [
      h("strong", { class: "figure-title" }, "Particles"),
      choice(
        "Field",
        Object.fromEntries(Object.entries(PARTICLE_FIELDS).filter(([name]) => name in there)),
        (f) => ((now.field = f), show()),
        now.field,
      ),
      choice(
        "State",
        Object.fromEntries(names.map((n) => [n, stateName(n, states[n])])),
        (n) => ((now.state = n), show()),
        now.state,
      ),
    ],
  });
  view.root.id = "stability-view";
  show();
  const water = result.stability.free_surface_m;
  view.setLayers([
    ...poolLayers(result.section),
    ...outlineLayers(result),
    ...seepageLayers(result, false).filter((l) => l.label === "phreatic line"),
    {
      label: "assumed water line",
      lines: water.length ? [water] : [],
      look: { stroke: BLUE, width: 2, dash: "8 3 2 3" },
    },
    ...(result.stability.searches ?? [result.stability]).flatMap((found, i, all) =>
      slipLayers(result, found, all.length > 1 ? `, ${found.region}` : ""),
    ),
  ]);
  return view.root;
}

function search(found, several) {
  return [
    several ? h("h3", {}, `Search: ${found.region}`) : null,
    verdict(found),
    h("div", { class: "pair" }, againstFactor(found), courses(found)),
    trials(found),
    uncertainty(found),
  ];
}

function verdict(found) {
  const m = found.mechanism,
    c = found.limit_equilibrium;
  const circle = m?.circle;
  return facts([
    [
      "Factor of safety",
      found.complete && found.factor !== null
        ? `${factor(found.factor)} (${bracketText(found)})`
        : `no answer: ${found.reason || "none found"}${bracketText(found) ? ` (${bracketText(found)})` : ""}`,
    ],
    found.uncertainty && ["Uncertainty", rangeText(found.uncertainty)],
    m && [
      "Mechanism",
      `${m.kind} to the ${m.side}: enters at ${point(m.entry_m)}, leaves at ${point(m.exit_m)} m`,
    ],
    m && [
      "Sliding mass",
      `${fixed(m.depth_m, 2)} m deep, ${fixed(m.thickness_m, 2)} m thick, ${fixed(m.length_m, 1)} m long; ${number(m.volume_m2, 4)} m³ per metre run`,
    ],
    m && [
      "Circle fitted",
      circle
        ? `about ${point(circle.centre_m)}, radius ${fixed(circle.radius_m, 1)} m, misfit ${number(circle.misfit_m, 2)} m`
        : "the slip line is near to no circle",
    ],
    c && [
      "Critical circle",
      `Bishop ${factor(c.bishop)}, Spencer ${c.spencer === null ? "not converged" : factor(c.spencer)}; about ${point(c.centre_m)}, radius ${fixed(c.radius_m, 1)} m: to compare with`,
    ],
  ]);
}

function againstFactor(found) {
  const series = Object.entries(LOOK).map(([outcome, [colour, shape, label]]) => {
    const own = found.trials.filter((t) => t.outcome === outcome);
    return {
      label,
      colour,
      shape,
      points: own.map((t) => [t.factor, t.max_displacement_m]),
      tips: own.map((t) => `F = ${number(t.factor, 5)}: ${t.reason}`),
    };
  });
  if (!found.trials.length) return null;
  const bands =
    found.stands !== null && found.fails !== null
      ? [{ from: found.stands, to: found.fails, colour: "#f3d9b8" }]
      : [];
  return chart({
    title: "Displacement against strength reduction factor",
    x: { title: "factor F [-]", zero: false },
    y: { title: "largest displacement [m]" },
    series,
    bands,
  });
}

function courses(found) {
  const some = found.trials.filter((t) => t.history.time_s.length);
  if (!some.length) return null;
  // Lighter to darker with the factor, so that the curves of one outcome are told apart.
  const shade = (t) => {
    const same = some
      .filter((o) => o.outcome === t.outcome)
      .map((o) => o.factor)
      .sort((a, b) => a - b);
    return same.length < 2
      ? LOOK[t.outcome][0]
      : SHADES[t.outcome](0.35 + (0.6 * same.indexOf(t.factor)) / (same.length - 1));
  };
  const series = [...some]
    .sort((a, b) => a.factor - b.factor)
    .map((t) => ({
      label: `${number(t.factor, 5)} ${t.outcome}`,
      colour: shade(t),
      dash: t.outcome === "undecided" ? "4 3" : null,
      points: [[0, 0], ...t.history.time_s.map((time, i) => [time, t.history.max_displacement_m[i]])],
    }));
  return chart({
    title: "Course of each trial",
    x: { title: "simulated time [s]" },
    y: { title: "largest displacement [m]" },
    series,
  });
}

const num = (title) => ({ title, number: true });

function trials(found) {
  if (!found.trials.length) return null;
  const end = (t) =>
    (t.factor === found.stands && t.outcome === "stands") ||
    (t.factor === found.fails && t.outcome === "fails");
  return [
    h("h3", {}, "Every trial"),
    table(
      [
        num("F"),
        { title: "outcome" },
        { title: "evidence" },
        num("moved [m]"),
        num("velocity measure [-]"),
        num("time [s]"),
        num("steps"),
      ],
      found.trials.map((t) => ({
        look: end(t) ? "end" : null,
        cells: [
          number(t.factor, 5),
          h("span", { class: `outcome ${t.outcome}` }, t.interrupted ? "stopped" : t.outcome),
          t.reason,
          number(t.max_displacement_m, 3),
          number(t.velocity_measure, 2),
          fixed(t.time_s, 2),
          String(t.steps),
        ],
      })),
      "Trials",
    ),
    h(
      "p",
      { class: "note" },
      "Bold: the ends of the bracket. T0: the time that a shear wave takes over the height of the section. Velocity measure: below 0.001 the soil counts as at rest.",
    ),
  ];
}

function uncertainty({ uncertainty: u }) {
  const d = u?.discretisation,
    r = u?.flow_rule;
  if (!d && !r) return null;
  const rows = d
    ? d.spacings.map((x) => [
        `spacing ${plain(x.spacing_m)} m`,
        factor(x.factor),
        factor(x.stands),
        factor(x.fails),
      ])
    : [];
  if (r)
    rows.push(
      [
        "no dilation",
        factor(r.no_dilation.factor),
        factor(r.no_dilation.stands),
        factor(r.no_dilation.fails),
      ],
      [
        "dilation = friction angle",
        factor(r.associated.factor),
        factor(r.associated.stands),
        factor(r.associated.fails),
      ],
    );
  return [
    h("h3", {}, "What the factor depends on"),
    table([{ title: "with" }, num("F"), num("stands"), num("fails")], rows, "Uncertainty"),
    d
      ? h(
          "p",
          { class: "note" },
          d.order
            ? `Order ${fixed(d.order, 1)}: limit ${factor(d.extrapolated)}, \u00b1 ${factor(d.error)}.`
            : `No clear order in the spacing: \u00b1 ${factor(d.error)}.`,
        )
      : null,
  ];
}
