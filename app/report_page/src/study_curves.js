// SPDX-License-Identifier: GPL-3.0-or-later
// F and discharge against the first key with numbers; others' points over them.
import { chart } from "./chart.js";
import { BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY } from "./colours.js";
import { csvRows } from "./csv.js";
import { chapter } from "./dom.js";
import { byRatios, DISCHARGE, FACTOR, firstNumeric, namesOf, someValues } from "./study_values.js";

const COLOURS = [BLUE, ORANGE, GREEN, PURPLE, SKY, GREY];
const DASHES = [null, "6 3", "2 3"];
const HOLLOW = ["diamond", "square", "triangle", "ring"];
export const look = (i) => ({
  colour: COLOURS[i % COLOURS.length],
  dash: DASHES[Math.floor(i / COLOURS.length) % DASHES.length],
});

export function curves(study, reference) {
  const name = firstNumeric(study);
  if (study.design === "one-at-a-time" || !name) return null;
  const figures = [
    figure(study, reference, name, FACTOR, 1, FACTOR.unit),
    figure(study, reference, name, DISCHARGE, 86400, "m³/day per metre"),
  ].filter(Boolean);
  return figures.length ? chapter("curves", "What changes with it", figures) : null;
}

/** Members by the values of all other keys, in the order of `name`; the same curve twice is one of two labels. */
function families(study, name, quantity) {
  const others = study.design === "pairs" ? [] : namesOf(study).filter((n) => n !== name);
  const found = new Map(),
    different = new Map();
  for (const m of study.members) {
    const key = someValues(m, others);
    found.set(key, [...(found.get(key) ?? []), m]);
  }
  for (const [label, members] of found) {
    members.sort((a, b) => a.values[name] - b.values[name]);
    const key = JSON.stringify(members.map((m) => [m.values[name], quantity.of(m), m.status]));
    if (different.has(key)) different.get(key).labels.push(label);
    else different.set(key, { labels: [label], members });
  }
  return [...different.values()];
}

/** Runs of members with an answer: one without breaks the line. */
function unbroken(members, quantity) {
  const runs = [[]];
  for (const m of members)
    if (quantity.of(m) === null) runs.push([]);
    else runs.at(-1).push(m);
  return runs.filter((run) => run.length);
}

function figure(study, reference, name, quantity, scale, unit) {
  const values = study.members.map(quantity.of).filter((v) => v !== null);
  if (!values.length) return null;
  const x = { title: name, zero: false, log: byRatios(study.members.map((m) => m.values[name])) };
  const y = {
    title: `${quantity.title} [${unit}]`,
    zero: false,
    log: quantity === DISCHARGE && byRatios(values),
  };
  const curves = families(study, name, quantity).flatMap(({ labels, members }, i) =>
    family(unbroken(members, quantity), labels.join(" or ") || "berm", look(i), {
      at: (m, value) => [m.values[name], scale * value],
      quantity,
      least: (value) => (y.log ? 0.1 * value : -Infinity), // a logarithmic axis has no zero
    }),
  );
  curves.find((one) => one.shape === "band").label = quantity.rangeName;
  const fits = ([px, py]) => (!x.log || px > 0) && (!y.log || py > 0);
  const published = publishedSeries(reference, quantity, scale, fits);
  const drawn = chart({
    title: `${quantity.title} against ${name}`,
    x,
    y,
    series: [...curves, ...published],
    level: quantity === FACTOR ? 1 : null,
  });
  drawn.id = `${quantity.id}-curve`;
  return drawn;
}

/** Of each run of members a pale band and a line, and a dot for each member. */
function family(runs, label, { colour, dash }, { at, quantity, least }) {
  const ends = (run, k) => run.map((m) => at(m, Math.max(quantity.range(m)[k], least(quantity.of(m)))));
  const point = (m) => at(m, quantity.of(m));
  return [
    ...runs.map((run) => ({
      shape: "band",
      points: [...ends(run, 0), ...ends(run, 1).reverse()],
      colour,
      tips: [...run, ...run].map(() => quantity.rangeName),
    })),
    ...runs.map((run) => ({ points: run.map(point), colour, dash, width: 2.2, tips: run.map(() => label) })),
    { points: runs.flat().map(point), colour, shape: "dot", label },
  ];
}

/** Points of the reference that fit on the axes, hollow, a sign for each source. */
function publishedSeries(text, quantity, scale, fits) {
  const sources = new Map();
  for (const row of text ? csvRows(text) : []) {
    const point = [Number(row.x), scale * Number(row[quantity.column])];
    if (!row.x || !row[quantity.column] || !point.every(Number.isFinite) || !fits(point)) continue;
    const source = row.source || "reference";
    sources.set(source, [...(sources.get(source) ?? []), point]);
  }
  return [...sources].map(([label, points], i) => ({
    label,
    points,
    colour: INK,
    shape: HOLLOW[i % HOLLOW.length],
  }));
}
