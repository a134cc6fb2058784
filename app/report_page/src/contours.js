// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of equal value of a field that is linear on triangles.

/** For each level, a list of chains [[x, y], ...]; only in triangles with a `wet` node, if that is given. */
export function contours(mesh, values, levels, wet) {
  const { x, y, triangles } = mesh;
  const segments = levels.map(() => []);
  const low = levels[0],
    step = levels.length > 1 ? levels[1] - levels[0] : 1;
  for (let t = 0; t < triangles.length; t += 3) {
    const nodes = [triangles[t], triangles[t + 1], triangles[t + 2]];
    if (wet && !nodes.some((n) => wet[n] >= 0)) continue;
    const v = nodes.map((n) => values[n]);
    const first = Math.max(0, Math.ceil((Math.min(...v) - low) / step - 1e-9));
    const last = Math.min(levels.length - 1, Math.floor((Math.max(...v) - low) / step + 1e-9));
    for (let k = first; k <= last; ++k) {
      const level = levels[k],
        ends = [];
      for (let e = 0; e < 3; ++e) {
        const i = nodes[e],
          j = nodes[(e + 1) % 3],
          vi = values[i],
          vj = values[j];
        if (vi > level === vj > level) continue;
        const f = (level - vi) / (vj - vi);
        ends.push([i < j ? i + "-" + j : j + "-" + i, x[i] + f * (x[j] - x[i]), y[i] + f * (y[j] - y[i])]);
      }
      if (ends.length === 2) segments[k].push(ends);
    }
  }
  return segments.map(chained);
}

/** Segments that share an edge of the mesh, joined. */
function chained(segments) {
  const at = new Map(); // edge -> the one or two segments on it
  for (const segment of segments)
    for (const end of segment) {
      const list = at.get(end[0]);
      if (list) list.push(segment);
      else at.set(end[0], [segment]);
    }
  const used = new Set(),
    chains = [];
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
    const [a, b] = segment;
    const forward = [[a[1], a[2]], ...walk(segment, a[0])];
    const other = at.get(a[0]).find((next) => !used.has(next));
    const backward = other ? walk(other, a[0]) : [];
    chains.push([...backward.reverse(), ...forward]);
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
