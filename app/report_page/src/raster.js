// SPDX-License-Identifier: GPL-3.0-or-later
// Fields as values in pixels: drawn by themselves, so that the value under the cursor is the one shown.

export class Raster {
  /** scale, left, top: pixel = scale * x + left, top - scale * y. */
  constructor(width, height, scale, left, top) {
    Object.assign(this, { width, height, scale, left, top });
    this.values = new Float32Array(width * height).fill(NaN);
  }

  /** Triangles, linear between their nodes (`nodal`), or of one value each. */
  triangles(mesh, values, nodal) {
    const { triangles } = mesh,
      { width, height, scale, left, top } = this,
      out = this.values;
    const x = Float64Array.from(mesh.x, (v) => scale * v + left),
      y = Float64Array.from(mesh.y, (v) => top - scale * v);
    const least = -1e-3; // borders between triangles leave no gaps
    for (let t = 0, n = triangles.length / 3; t < n; ++t) {
      const a = triangles[3 * t],
        b = triangles[3 * t + 1],
        c = triangles[3 * t + 2];
      const ax = x[a],
        ay = y[a],
        bx = x[b],
        by = y[b],
        cx = x[c],
        cy = y[c];
      // The pixels whose centres may lie inside.
      const x0 = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.51)),
        x1 = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.49));
      const y0 = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.51)),
        y1 = Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.49));
      if (x0 > x1 || y0 > y1) continue;
      const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
      if (area === 0) continue;
      const bdx = (cy - ay) / area,
        bdy = -(cx - ax) / area,
        cdx = -(by - ay) / area,
        cdy = (bx - ax) / area;
      const va = nodal ? values[a] : values[t],
        db = nodal ? values[b] - va : 0,
        dc = nodal ? values[c] - va : 0;
      for (let row = y0; row <= y1; ++row) {
        const dy = row + 0.5 - ay;
        for (let column = x0; column <= x1; ++column) {
          const dx = column + 0.5 - ax,
            wb = bdx * dx + bdy * dy,
            wc = cdx * dx + cdy * dy;
          if (wb >= least && wc >= least && wb + wc <= 1 - least)
            out[row * width + column] = va + wb * db + wc * dc;
        }
      }
    }
  }

  /** No value, but less than any, where another nodal field is negative. */
  below(mesh, field) {
    const other = new Raster(this.width, this.height, this.scale, this.left, this.top);
    other.triangles(mesh, field, true);
    for (let k = 0; k < this.values.length; ++k) if (other.values[k] < 0) this.values[k] = -Infinity;
  }

  /** Each pixel that is nearer than `radius` to a particle takes the value of the nearest one. */
  particles(x, y, values, radius) {
    const { width, height, scale, left, top } = this,
      r = Math.max(radius * scale, 0.8);
    const distance = new Float32Array(width * height).fill(r * r);
    for (let i = 0; i < x.length; ++i) {
      const cx = scale * x[i] + left,
        cy = top - scale * y[i];
      const x0 = Math.max(0, Math.floor(cx - r)),
        x1 = Math.min(width - 1, Math.ceil(cx + r));
      const y0 = Math.max(0, Math.floor(cy - r)),
        y1 = Math.min(height - 1, Math.ceil(cy + r));
      for (let row = y0; row <= y1; ++row)
        for (let column = x0; column <= x1; ++column) {
          const d = (column + 0.5 - cx) ** 2 + (row + 0.5 - cy) ** 2,
            k = row * width + column;
          if (d < distance[k]) {
            distance[k] = d;
            this.values[k] = values[i];
          }
        }
    }
  }

  /** Nothing outside a closed polygon [[x, y], ...]. */
  clip(polygon) {
    const { width, height, scale, left, top } = this;
    for (let row = 0; row < height; ++row) {
      const y = (top - row - 0.5) / scale,
        crossings = [];
      for (let i = 0, n = polygon.length; i < n; ++i) {
        const [ax, ay] = polygon[i],
          [bx, by] = polygon[(i + 1) % n];
        if (ay > y !== by > y) crossings.push(scale * (ax + ((y - ay) / (by - ay)) * (bx - ax)) + left);
      }
      crossings.sort((a, b) => a - b);
      let column = 0;
      for (let c = 0; c <= crossings.length; c += 2) {
        const end = c < crossings.length ? Math.min(width, Math.max(0, Math.floor(crossings[c]))) : width;
        this.values.fill(NaN, row * width + column, row * width + Math.max(column, end));
        column = c + 1 < crossings.length ? Math.max(0, Math.min(width, Math.ceil(crossings[c + 1]))) : width;
      }
    }
  }

  /** As an image in a colour scale (colours.js). */
  image(scale) {
    const image = new ImageData(this.width, this.height),
      out = new Uint32Array(image.data.buffer);
    const { table, below } = scale,
      [low, high] = scale.domain,
      last = table.length - 1;
    const perUnit = high > low ? last / (high - low) : 0;
    for (let k = 0; k < out.length; ++k) {
      const v = this.values[k];
      if (v !== v) continue;
      out[k] = v < low && below ? below : table[Math.max(0, Math.min(last, Math.round((v - low) * perUnit)))];
    }
    return image;
  }
}
