// SPDX-License-Identifier: GPL-3.0-or-later
// What is read from study.json, as docs/plots/study.py reads it.

/** The variations' names: keys that move together are one. */
export const namesOf = (study) => study.vary.map((variation) => variation.keys.join("+"));

export const solved = (member) => member.complete && member.factor !== null;

export function valueText(value) {
  if (value === null || value === undefined) return null;
  if (typeof value === "number" && value !== 0 && Math.abs(value) < 1e-3) return value.toExponential();
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}

const lastPart = (name) => name.split(".").at(-1);

/** Some of a member's values, in a few words. */
export const someValues = (member, names) =>
  names.map((name) => `${lastPart(name)} = ${valueText(member.values[name])}`).join(", ");

/** What it has of its own. */
export const label = (member) => someValues(member, member.varied) || "the case itself";

/** The first name with numbers, and more than one. */
export const firstNumeric = (study) =>
  namesOf(study).find((name) => {
    const values = study.members.map((m) => m.values[name]);
    return values.every((v) => typeof v === "number") && new Set(values).size > 1;
  });

/** Whether values call for a logarithmic scale. */
export function byRatios(values) {
  const low = Math.min(...values);
  return low > 0 && Math.max(...values) / low >= 30;
}

/** What is read upwards: a member's value, what it may be off by, the reference's column. */
export const FACTOR = {
  id: "factor",
  title: "factor of safety",
  unit: "-",
  of: (m) => (solved(m) ? m.factor : null),
  range: (m) => [m.low ?? m.factor, m.high ?? m.factor],
  rangeName: "may lie",
  column: "F",
};
export const DISCHARGE = {
  id: "discharge",
  title: "discharge",
  unit: "m²/s",
  of: (m) => m.discharge_m2_s,
  range: (m) => [-1, 1].map((sign) => m.discharge_m2_s + sign * (m.discharge_error_m2_s ?? 0)),
  rangeName: "estimated error",
  column: "discharge_m2_s",
};
