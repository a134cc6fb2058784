// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that colour-blind readers tell apart, too.
import {
  interpolateCividis,
  interpolateMagma,
  interpolatePuOr,
  interpolateViridis,
  interpolateYlGnBu,
} from "d3-scale-chromatic";

// After Okabe and Ito.
export const BLUE = "#0072B2",
  SKY = "#56B4E9",
  ORANGE = "#D55E00",
  GREEN = "#009E73",
  GREY = "#666666";
export const PURPLE = "#CC79A7",
  AMBER = "#E69F00",
  INK = "#1d2327",
  RED = "#a4262c";

/** Pale, for the ground under lines. */
export const SOILS = ["#e9dcc3", "#c9d5e3", "#d9e4c8", "#ecd0c4", "#d8cfe5", "#cfe3df", "#e5e0c0", "#d6d6d6"];
export const soilColour = (i) => SOILS[i % SOILS.length];

const paler = (map, white) => (t) =>
  `rgb(${rgb(map(t))
    .map((v) => Math.round(v + white * (255 - v)))
    .join(",")})`;

const MAPS = {
  viridis: paler(interpolateViridis, 0.28), // lines have to be seen on it
  cividis: paler(interpolateCividis, 0.28),
  water: (t) => interpolateYlGnBu(0.06 + 0.9 * t),
  strain: (t) => interpolateMagma(1 - 0.92 * t),
  diverging: interpolatePuOr, // from purple to orange
  lines: (t) => interpolateViridis(0.9 * t), // its end is seen on white, too
};

function rgb(text) {
  if (text[0] === "#") return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
  return text
    .match(/[\d.]+/g)
    .slice(0, 3)
    .map((v) => Math.round(Number(v)));
}

const packedColour = (text) => {
  const [r, g, b] = rgb(text);
  return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
};

/** A colour scale over a domain; `below`: the colour of what is smaller, if that is to be told apart. */
export function colourScale(map, domain, below) {
  const at = MAPS[map],
    css = Array.from({ length: 256 }, (_, i) => at(i / 255));
  return {
    domain,
    css,
    table: Uint32Array.from(css, packedColour),
    below: below ? packedColour(below) : 0,
    belowCss: below,
  };
}

/** One colour for each whole number. */
export function soilScale(count) {
  const css = Array.from({ length: count }, (_, i) => soilColour(i));
  return { domain: [0, count - 1], css, table: Uint32Array.from(css, packedColour), below: 0, steps: true };
}
