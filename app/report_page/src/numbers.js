// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as people read them.

const RAISED = {
  "-": "\u207b",
  0: "\u2070",
  1: "\u00b9",
  2: "\u00b2",
  3: "\u00b3",
  4: "\u2074",
  5: "\u2075",
  6: "\u2076",
  7: "\u2077",
  8: "\u2078",
  9: "\u2079",
};
const MINUS = "\u2212";

export const power = (exponent) => "10" + [...String(exponent)].map((c) => RAISED[c]).join("");

/** `digits` significant ones; a power of ten where the number is very small or large. */
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    const places = Math.max(0, Math.min(6, digits - 1 - Math.floor(Math.log10(size))));
    return value.toFixed(places).replace("-", MINUS);
  }
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${mantissa.replace("-", MINUS)} \u00d7 ${power(Number(exponent))}`;
}

/** A fixed number of places. */
export const fixed = (value, places) =>
  value === null || value === undefined ? "\u2013" : value.toFixed(places).replace("-", MINUS);

/** With its sign. */
export const signed = (value, places) =>
  value === null || value === undefined ? "\u2013" : (value < 0 ? "" : "+") + fixed(value, places);

export const factor = (value) => fixed(value, 3);

export const point = (p) => (p ? `(${fixed(p[0], 2)}, ${fixed(p[1], 2)})` : "\u2013");

/** A number as typed: 37, 0.3, 1e-7 as a power of ten. */
export function plain(value) {
  if (value === null || value === undefined) return "\u2013";
  return number(value, 6)
    .replace(/(\.\d*?)0+(?=$| )/, "$1")
    .replace(/\.(?=$| )/, "");
}

export const seconds = (value) =>
  value < 60 ? `${number(value, 3)} s` : `${Math.floor(value / 60)} min ${Math.round(value % 60)} s`;
