// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays as app/packed_array.cpp writes them.
import { unzlibSync } from "fflate";

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
  return unzlibSync(out);
}

/** Float64Array of numbers, or Uint32Array of whole ones. */
export function unpack(packed) {
  const n = packed.count,
    planes = bytes(packed.data),
    wide = packed.bits === 32;
  const out = wide ? new Uint32Array(n) : new Float64Array(n);
  let code = 0;
  for (let i = 0; i < n; ++i) {
    let difference = planes[i] | (planes[n + i] << 8);
    if (wide) difference |= (planes[2 * n + i] << 16) | (planes[3 * n + i] << 24);
    code = wide ? (code + difference) >>> 0 : (code + difference) & 0xffff;
    out[i] = wide ? code : packed.least + packed.step * code;
  }
  return out;
}

/** All packed arrays of an object, each only when it is asked for. */
export function lazily(object) {
  const out = {};
  for (const [name, value] of Object.entries(object)) {
    const isPacked = value && typeof value === "object" && "bits" in value;
    if (!isPacked) out[name] = value;
    else
      Object.defineProperty(out, name, {
        configurable: true,
        enumerable: true,
        get() {
          const array = unpack(value);
          Object.defineProperty(out, name, { value: array });
          return array;
        },
      });
  }
  return out;
}
