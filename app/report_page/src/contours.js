// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of equal value of a field that is linear on triangles.

/**
 * For each level, a list of chains [[x, y], ...]; only in triangles with a `wet` node, if that is given.
 * The levels are equally spaced.
 */
export function contours(mesh, values, levels, wet) {
  const { x, y, triangles } = mesh,
    segments = levels.map(() => []);
  const low = levels[0],
    step = levels.length > 1 ? levels[1] - levels[0] : 1,
    nodes = x.length;
  const crossing = (i, j, level) => {
    if (values[i] > level === values[j] > level) return null;
    const f = (level - values[i]) / (values[j] - values[i]);
    // The edge's number, the same from both sides, and the place on it.
    return [i < j ? i * nodes + j : j * nodes + i, x[i] + f * (x[j] - x[i]), y[i] + f * (y[j] - y[i])];
  };
  for (let t = 0; t < triangles.length; t += 3) {
    const a = triangles[t],
      b = triangles[t + 1],
      c = triangles[t + 2];
    if (wet && !(wet[a] >= 0 || wet[b] >= 0 || wet[c] >= 0)) continue;
    const least = Math.min(values[a], values[b], values[c]),
      most = Math.max(values[a], values[b], values[c]);
    const first = Math.max(0, Math.ceil((least - low) / step - 1e-9));
    const last = Math.min(levels.length - 1, Math.floor((most - low) / step + 1e-9));
    for (let k = first; k <= last; ++k) {
      const ends = [crossing(a, b, levels[k]), crossing(b, c, levels[k]), crossing(c, a, levels[k])].filter(
        Boolean,
      );
      if (ends.length === 2) segments[k].push(ends);
    }
  }
  return segments.map(chained);
}

/** Segments that share an edge of the mesh, joined. */
function chained(segments) {
  const at = new Map(), // edge -> the one or two segments on it
    used = new Set(),
    chains = [];
  for (const segment of segments)
    for (const [edge] of segment) {
      const list = at.get(edge);
      if (list) list.push(segment);
      else at.set(edge, [segment]);
    }
  const walk = (segment, from) => {
    const points = [];
    while (segment && !used.has(segment)) {
      used.add(segment);
      const to = segment[0][0] === from ? segment[1] : segment[0];
      points.push([to[1], to[2]]);
      from = to[0];
      segment = at.get(from).find((other) => !used.has(other));
    }
    return points;
  };
  for (const segment of segments) {
    if (used.has(segment)) continue;
    const [[edge, x, y]] = segment,
      forward = walk(segment, edge);
    const other = at.get(edge).find((next) => !used.has(next));
    chains.push([...(other ? walk(other, edge).reverse() : []), [x, y], ...forward]);
  }
  return chains;
}

/** Round levels strictly inside (low, high), about `count` of them. */
export function roundLevels(low, high, count) {
  const raw = (high - low) / count;
  if (!(raw > 0)) return [];
  const decade = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * decade).find((m) => m >= 0.72 * raw);
  const levels = [];
  for (let k = Math.ceil(low / step + 1e-6); k * step < high - 1e-6 * step; ++k) levels.push(k * step);
  return levels;
}

/** `count` equal parts of (low, high): the levels between them. */
export const evenLevels = (low, high, count) =>
  Array.from({ length: count - 1 }, (_, i) => low + ((i + 1) * (high - low)) / count);
