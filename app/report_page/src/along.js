// SPDX-License-Identifier: GPL-3.0-or-later
// Values of particles along a line.

/** Points at equal distances along a line: { at: [x, y], distance }. */
function sampled(line, count) {
  const lengths = [0];
  for (let i = 1; i < line.length; ++i)
    lengths.push(lengths[i - 1] + Math.hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]));
  const whole = lengths[lengths.length - 1],
    points = [];
  for (let k = 0, i = 1; k < count; ++k) {
    const distance = (whole * k) / (count - 1);
    while (i < line.length - 1 && lengths[i] < distance) ++i;
    const t = lengths[i] > lengths[i - 1] ? (distance - lengths[i - 1]) / (lengths[i] - lengths[i - 1]) : 0;
    points.push({ distance, at: [0, 1].map((c) => line[i - 1][c] + t * (line[i][c] - line[i - 1][c])) });
  }
  return points;
}

/**
 * For each list of values, [distance, value] along the line: the plane that fits the particles within
 * `radius` best, weighted to nothing there. A field that is linear comes out as it is.
 */
export function alongLine(particles, lists, line, radius, count = 90) {
  const curves = lists.map(() => []);
  for (const { at, distance } of sampled(line, count)) {
    const near = [];
    for (let i = 0; i < particles.x.length; ++i) {
      const dx = particles.x[i] - at[0],
        dy = particles.y[i] - at[1],
        r = Math.hypot(dx, dy) / radius;
      if (r < 1) near.push({ i, dx, dy, w: (1 - r * r) ** 2 });
    }
    const sum = (f) => near.reduce((total, p) => total + p.w * f(p), 0);
    const s = sum(() => 1),
      sx = sum((p) => p.dx),
      sy = sum((p) => p.dy),
      xx = sum((p) => p.dx ** 2),
      xy = sum((p) => p.dx * p.dy),
      yy = sum((p) => p.dy ** 2);
    const a = xx * yy - xy * xy,
      b = sx * yy - xy * sy,
      c = sx * xy - xx * sy,
      whole = s * a - sx * b + sy * c;
    if (!(Math.abs(whole) > 1e-9 * s ** 3 * radius ** 4)) continue; // too few, or all in a row
    lists.forEach((values, k) => {
      const f = sum((p) => values[p.i]),
        fx = sum((p) => values[p.i] * p.dx),
        fy = sum((p) => values[p.i] * p.dy);
      curves[k].push([distance, (f * a - sx * (fx * yy - xy * fy) + sy * (fx * xy - xx * fy)) / whole]);
    });
  }
  return curves;
}
