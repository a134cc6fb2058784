// SPDX-License-Identifier: GPL-3.0-or-later
// What can be shown in colours: how it is drawn, its scale, its text under the cursor.
import { colourScale, soilScale } from "./colours.js";
import { number, power } from "./numbers.js";

const DRY = "#ebe7df"; // above the phreatic line

function extremes(values) {
  let low = Infinity,
    high = -Infinity;
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return [low, high];
}

/** The value below which a share of the values lies. */
function quantile(values, share) {
  const sorted = Float64Array.from(values).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

const scaled = (values, unit) => Float64Array.from(values, (v) => v / unit);
const named = (name, unit) => (v) => `${name} ${number(v, 4)} ${unit}`.trim();

const wet = (kPa) =>
  colourScale("water", [0, Math.max(extremes(kPa)[1], 1e-3)], extremes(kPa)[0] < 0 ? DRY : null);

/** Fields on the triangles. */
export function meshFields(mesh, sharp) {
  const nodal = (values) => (raster) => raster.triangles(mesh, values, true);
  return {
    head: () => {
      const [driest, wettest] = extremes(mesh.pore_pressure);
      const dry = sharp && driest < 0 && wettest >= 0;
      const wetHeads = mesh.head.filter((_, i) => mesh.pore_pressure[i] >= 0);
      const draw = (raster) => {
        raster.triangles(mesh, mesh.head, true);
        if (dry) raster.below(mesh, mesh.pore_pressure);
      };
      return {
        title: `Hydraulic head above y = 0 [m]${dry ? "; pale: above the phreatic line" : ""}`,
        draw,
        colours: colourScale("viridis", extremes(dry ? wetHeads : mesh.head), dry ? DRY : null),
        value: (v) => (v === -Infinity ? "above the phreatic line" : named("head", "m")(v)),
      };
    },
    pressure: () => {
      const kPa = scaled(mesh.pore_pressure, 1e3),
        colours = wet(kPa);
      return {
        title: colours.belowCss
          ? "Pore pressure [kPa]; pale: suction, above the phreatic line"
          : "Pore pressure [kPa]",
        colours,
        draw: nodal(kPa),
        value: named("pore pressure", "kPa"),
      };
    },
    flux: () => {
      const high = quantile(mesh.log_flux, 0.998),
        low = Math.max(high - 3.5, quantile(mesh.log_flux, 0.01));
      return {
        title: "Size of the Darcy flux [m/s], logarithmic",
        colours: colourScale("strain", [low, high]),
        ...logTicks(low, high),
        draw: (raster) => raster.triangles(mesh, mesh.log_flux, false),
        value: (v) => `flux ${number(10 ** v, 3)} m/s`,
      };
    },
  };
}
export const MESH_FIELDS = { head: "hydraulic head", pressure: "pore pressure", flux: "flux (size)" };

/** Ticks of decadic logarithms from `low` to `high`. */
export function logTicks(low, high) {
  const ticks = [];
  for (let e = Math.floor(low); e <= high; ++e)
    for (const m of high - low > 2 ? [1] : [1, 2, 5])
      if (e + Math.log10(m) >= low && e + Math.log10(m) <= high) ticks.push(e + Math.log10(m));
  return {
    ticks,
    tick: (v) => (Math.abs(v - Math.round(v)) < 1e-9 ? power(Math.round(v)) : number(10 ** v, 1)),
  };
}

/** Side of a particle's square [m]. */
export const spacingOf = (result, particles) =>
  result.stability?.spacing_m ?? Math.sqrt(result.section.area_m2 / Math.max(1, particles.x.length));

/** A field on particles where they were before they moved, cut along the outline. */
const still = (result, particles) => (values) => (raster) => {
  raster.particles(particles.x, particles.y, values, 1.5 * spacingOf(result, particles));
  raster.clip(result.section.outline_m);
};

/** Fields on the particles in one state. */
export function particleFields(result, particles, state) {
  const draw = still(result, particles);
  const make = (title, name, unit, values, map, domain) => ({
    title,
    colours: colourScale(map, domain ?? widened(extremes(values))),
    draw: draw(values),
    value: named(name, unit),
  });
  const stress = (array, sign) => scaled(array, sign * 1e3);
  const fields = {
    soil: () => ({
      title: "Soil",
      names: result.inputs.soils.map((soil) => soil.name),
      colours: soilScale(result.inputs.soils.length),
      draw: draw(particles.soil),
      value: (v) => `soil ${result.inputs.soils[Math.round(v)]?.name}`,
    }),
    pressure: () => {
      const kPa = scaled(particles.pore_pressure, 1e3);
      return {
        title: "Pore pressure at the particles [kPa]",
        colours: wet(kPa),
        draw: draw(kPa),
        value: named("pore pressure", "kPa"),
      };
    },
  };
  if (extremes(particles.pore_pressure)[1] <= 0) delete fields.pressure; // there is no water
  if (!state) return fields;
  return {
    strain: () =>
      make(
        "Plastic strain (deviatoric, accumulated) [-]",
        "plastic strain",
        "",
        state.plastic_strain,
        "strain",
        [0, Math.max(quantile(state.plastic_strain, 0.998), 1e-6)],
      ),
    displacement: () => {
      const u = Float64Array.from(state.ux, (ux, i) => Math.hypot(ux, state.uy[i]));
      return make("Displacement since settling [m]", "displacement", "m", u, "viridis", [
        0,
        Math.max(extremes(u)[1], 1e-9),
      ]);
    },
    ...fields,
    vertical: () =>
      make(
        "Vertical effective stress [kPa], compression positive",
        "vertical effective stress",
        "kPa",
        stress(state.stress_yy, -1),
        "cividis",
      ),
    horizontal: () =>
      make(
        "Horizontal effective stress [kPa], compression positive",
        "horizontal effective stress",
        "kPa",
        stress(state.stress_xx, -1),
        "cividis",
      ),
    shear: () => {
      const kPa = stress(state.stress_xy, 1),
        most = Math.max(...extremes(kPa).map(Math.abs), 1e-9);
      return make("Shear stress xy [kPa]", "shear stress", "kPa", kPa, "diverging", [-most, most]);
    },
  };
}
export const PARTICLE_FIELDS = {
  strain: "plastic strain",
  displacement: "displacement",
  pressure: "pore pressure",
  vertical: "vertical effective stress",
  horizontal: "horizontal effective stress",
  shear: "shear stress",
  soil: "soil",
};

const widened = ([low, high]) => (high > low ? [low, high] : [low - 0.5, high + 0.5]);

/** A difference about zero, in kPa. */
export function differenceField(result, particles, values, name) {
  const most = Math.max(...extremes(values).map(Math.abs), 1e-3);
  return {
    title: name,
    colours: colourScale("diverging", [-most, most]),
    draw: still(result, particles)(values),
    value: (v) => `difference ${v < 0 ? "" : "+"}${number(v, 3)} kPa`,
  };
}

/** A field of a frame of a run-out, where the particles are then; the same scale in all frames. */
export function frameField(result, frame, values, { title, name, unit, map, domain }, radius) {
  return {
    title,
    colours: colourScale(map, domain),
    draw: (raster) => raster.particles(frame.x, frame.y, values, radius),
    value: named(name, unit),
  };
}

export { extremes, quantile };
