// SPDX-License-Identifier: GPL-3.0-or-later
// What was asked, first.
import { BLUE } from "./colours.js";
import { h } from "./dom.js";
import { factor, fixed, number, point } from "./numbers.js";
import { ruler } from "./ruler.js";

export function answer({ result }) {
  const cards = [factorCard(result), seepageCard(result), gradientCard(result), runOutCard(result)].filter(
    Boolean,
  );
  return h(
    "section",
    { id: "answer", "aria-label": "Answer" },
    notices(result, result.interrupted ? "Partial: the run was stopped before its end." : null),
    h("div", { class: "cards" }, cards),
    factorRuler(result),
  );
}

/** Partial, interrupted, warned of. */
export function notices({ complete, warnings: texts = [] }, why) {
  const partial = complete ? null : (why ?? "Partial: not every stage came to its answer.");
  return [
    partial && h("p", { class: "notice partial", role: "status" }, partial),
    texts.length
      ? h(
          "div",
          { class: "notice" },
          h("strong", {}, texts.length === 1 ? "Warning" : "Warnings"),
          h(
            "ul",
            {},
            texts.map((t) => h("li", {}, t)),
          ),
        )
      : null,
  ];
}

const card = (look, name, value, ...lines) =>
  h(
    "div",
    { class: `card ${look}` },
    h("p", { class: "card-name" }, name),
    h("p", { class: "card-value" }, value),
    lines.filter(Boolean).map((l) => h("p", {}, l)),
  );

export const bracketText = (s) =>
  [s.stands !== null && `stands at ${factor(s.stands)}`, s.fails !== null && `fails at ${factor(s.fails)}`]
    .filter(Boolean)
    .join(", ");

/** What makes the range of the factor. */
export function rangeText(u) {
  if (!u) return null;
  const parts = ["bracket", u.discretisation && "particle spacing", u.flow_rule && "flow rule"].filter(
    Boolean,
  );
  return `may lie from ${factor(u.low)} to ${factor(u.high)} (${parts.join(", ")})`;
}

const asked = (s) => s && (s.trials.length > 0 || s.factor !== null || s.reason);

function factorCard(result) {
  const s = result.stability;
  if (!asked(s)) return null;
  if (s.factor === null || !s.complete)
    return card(
      "main none",
      "Factor of safety",
      "no answer",
      s.reason || "the search found no factor",
      bracketText(s) && `known: ${bracketText(s)}`,
    );
  return card(
    "main",
    "Factor of safety",
    h("span", { id: "factor" }, `F = ${factor(s.factor)}`),
    bracketText(s),
    rangeText(s.uncertainty),
    s.mechanism && `${s.mechanism.kind} to the ${s.mechanism.side}, ${fixed(s.mechanism.depth_m, 1)} m deep`,
    s.searches && `the smallest of ${s.searches.length} searches`,
  );
}

function seepageCard(result) {
  const flow = result.seepage;
  if (!flow) return null;
  const error = flow.estimated_error?.discharge_m2_s;
  return card(
    "",
    "Discharge",
    h("span", { id: "discharge" }, `${number(flow.discharge_m2_s)} m²/s`),
    `${number(flow.discharge_m2_s * 86400)} m³/day per metre run`,
    flow.discharge_over_k_m !== null && `q/k = ${number(flow.discharge_over_k_m, 4)} m`,
    error && flow.discharge_m2_s > 0
      ? `estimated error ${number((100 * error) / flow.discharge_m2_s, 2)} %`
      : null,
    flow.exit_point_m && `exit point at ${point(flow.exit_point_m)} m`,
  );
}

function gradientCard(result) {
  const flow = result.seepage;
  if (!flow) return null;
  const steepest = flow.exit_gradients
    .filter((o) => o.gradient !== null)
    .sort((a, b) => b.gradient - a.gradient)[0];
  const heave = flow.heave?.factor;
  if (!steepest && heave === null) return null;
  const low = heave !== null && heave !== undefined && heave < 1;
  return card(
    low ? "alarm" : "",
    "Factor against heave",
    heave === null || heave === undefined ? "no rising water" : number(heave, 3),
    heave
      ? flow.heave.column && flow.heave.column.factor === heave
        ? `of a column ${number(flow.heave.column.depth_m, 3)} m deep below ${point(flow.heave.column.at_m)} m`
        : `at the surface, at ${point(flow.heave.surface.at_m)} m`
      : null,
    low && "below 1: rising water lifts the soil",
    steepest && `largest exit gradient ${number(steepest.gradient, 3)} at ${point(steepest.at_m)} m`,
  );
}

function runOutCard(result) {
  const r = result.runout;
  if (!r) return null;
  return card(
    asked(result.stability) ? "" : "main",
    "Run-out",
    r.run_out_m === null ? "none" : `${fixed(r.run_out_m, 1)} m`,
    r.at_rest
      ? `at rest since ${number(r.time_to_rest_s, 3)} s`
      : `still moving after ${number(r.time_s, 3)} s: not the end`,
    `crest lower by ${fixed(r.crest_settlement_m, 2)} m`,
    r.freeboard_m !== null &&
      (r.freeboard_m > 0
        ? `freeboard left ${fixed(r.freeboard_m, 2)} m`
        : `overtopped by ${fixed(-r.freeboard_m, 2)} m`),
    `${number(r.moved_volume_m2, 3)} m³ per metre moved, by ${fixed(r.max_displacement_m, 2)} m at most`,
  );
}

function factorRuler(result) {
  const s = result.stability;
  if (!asked(s) || s.factor === null) return null;
  const row = (found, label) => ({
    label,
    colour: BLUE,
    ...found,
    factor: found.complete ? found.factor : null,
    low: found.uncertainty?.low,
    high: found.uncertainty?.high,
    marks: [],
  });
  const rows = s.searches
    ? s.searches.map((found) => row(found, found.region))
    : [row(s, "strength reduction")];
  const circle = s.limit_equilibrium;
  if (circle && !s.searches) rows[0].marks = [{ at: circle.bishop, text: `Bishop ${factor(circle.bishop)}` }];
  if (circle?.spencer && !s.searches)
    rows[0].marks.push({ at: circle.spencer, text: `Spencer ${factor(circle.spencer)}` });
  return h(
    "div",
    {},
    ruler(rows, "Factor of safety: bracket, range, limit equilibrium"),
    h(
      "p",
      { class: "note" },
      "Dark: the bracket, both ends of which were tried. Pale: where F may lie by bracket, spacing and flow rule.",
      rows[0].marks.length
        ? ` Diamonds: limit equilibrium on the critical circle (Bishop ${factor(circle.bishop)}${circle.spencer ? `, Spencer ${factor(circle.spencer)}` : ""}), to compare with.`
        : "",
    ),
  );
}
