// SPDX-License-Identifier: GPL-3.0-or-later
import { BLUE, GREEN, GREY, INK, ORANGE, PURPLE } from "./colours.js";
import { chart } from "./chart.js";
import { chapter, choice, facts, h } from "./dom.js";
import { extremes, frameField, quantile, spacingOf } from "./fields.js";
import { fixed, number, point } from "./numbers.js";
import { boxOf, outlineLayers, poolLayers } from "./section.js";
import { lazily } from "./unpack.js";
import { View } from "./view.js";

export function runOut({ result, frames, particles }) {
  return chapter(
    "run-out",
    "Run-out",
    frames?.length > 1 ? player(result, frames.map(lazily), lazily(particles)) : null,
    shape(result.runout),
    histories(result.runout),
  );
}

/** Fields of all frames, on one scale each. */
function fieldsOf(frames, particles) {
  const moved = frames.map((f) =>
    Float64Array.from(f.x, (x, i) => Math.hypot(x - frames[0].x[i], f.y[i] - frames[0].y[i])),
  );
  const last = frames.length - 1;
  return {
    displacement: {
      values: moved,
      title: "Displacement [m]",
      name: "displacement",
      unit: "m",
      map: "viridis",
      domain: [0, Math.max(...moved.map((m) => extremes(m)[1]), 1e-9)],
    },
    strain: {
      values: frames.map((f) => f.plastic_strain),
      title: "Plastic strain (deviatoric, accumulated) [-]",
      name: "plastic strain",
      unit: "",
      map: "strain",
      domain: [0, Math.max(quantile(frames[last].plastic_strain, 0.995), 1e-6)],
    },
    height: {
      values: frames.map(() => frames[0].y),
      title: "Height at the start [m]: how the layers move",
      name: "height at the start",
      unit: "m",
      map: "cividis",
      domain: extremes(particles.y),
    },
  };
}

function player(result, frames, particles) {
  const fields = fieldsOf(frames, particles),
    radius = 0.85 * spacingOf(result, particles);
  let now = frames.length - 1,
    name = "displacement",
    timer = 0;
  const ends = frames[frames.length - 1],
    [xl, xr] = extremes(ends.x),
    [yl, yh] = extremes(ends.y);
  const slider = h("input", {
    type: "range",
    min: 0,
    max: frames.length - 1,
    value: now,
    step: 1,
    "aria-label": "Time",
    oninput: () => (stop(), go(Number(slider.value))),
  });
  const clock = h("output", { class: "clock" });
  const play = h(
    "button",
    { type: "button", class: "play", "aria-label": "Play", onclick: () => (timer ? stop() : start()) },
    "\u25b6 Play",
  );
  const view = new View({
    box: boxOf(result.section, [
      [xl, yl],
      [xr, yh],
    ]),
    title: "Run-out",
    controls: [
      h("strong", { class: "figure-title" }, "Run-out"),
      choice(
        "Field",
        { displacement: "displacement", strain: "plastic strain", height: "layers" },
        (value) => ((name = value), go(now)),
        name,
      ),
    ],
  });
  view.root.id = "run-out-view";
  function go(frame) {
    now = frame;
    slider.value = String(frame);
    const t = frames[frame].time_s,
      field = fields[name];
    clock.textContent = `t = ${fixed(t, 2)} s`;
    slider.setAttribute("aria-valuetext", clock.textContent);
    view.setField(frameField(result, frames[frame], field.values[frame], field, radius));
  }
  function stop() {
    clearInterval(timer);
    timer = 0;
    play.textContent = "\u25b6 Play";
    play.setAttribute("aria-label", "Play");
  }
  function start() {
    if (now === frames.length - 1) go(0);
    timer = setInterval(
      () => (now < frames.length - 1 ? go(now + 1) : stop()),
      Math.max(60, Math.min(400, 5000 / frames.length)),
    );
    play.textContent = "\u275a\u275a Pause";
    play.setAttribute("aria-label", "Pause");
  }
  const r = result.runout;
  view.setLayers([
    ...poolLayers(result.section),
    ...outlineLayers(result).map((l, i) =>
      i === 0 ? { ...l, label: "section as drawn", look: { ...l.look, dash: "5 3", width: 1.1 } } : l,
    ),
    {
      label: "surface at the end",
      lines: r.surface_m.length ? [r.surface_m] : [],
      look: { stroke: ORANGE, width: 1.8 },
    },
    {
      label: "toe as drawn and tip",
      marks: [
        r.toe_m && { at: r.toe_m, shape: "ring" },
        r.tip_m && { at: r.tip_m, shape: "dot", colour: ORANGE },
      ].filter(Boolean),
    },
  ]);
  view.stage.after(h("div", { class: "player" }, play, slider, clock));
  go(now);
  return [
    view.root,
    frames.length < r.frames
      ? h("p", { class: "note" }, `${frames.length} of ${r.frames} frames; all of them are in run_out/.`)
      : null,
  ];
}

function shape(r) {
  return facts([
    [
      "Start",
      `${r.from === "failing trial" ? "the failing trial" : "the settled state"}, strength divided by ${number(r.factor, 4)}`,
    ],
    [
      "End",
      r.at_rest
        ? `at rest since ${number(r.time_to_rest_s, 4)} s`
        : `still moving after ${number(r.time_s, 4)} s: what follows is not the end`,
    ],
    [
      "Run-out",
      r.run_out_m === null
        ? "none: the surface rises nowhere by 1 % of the height"
        : `${fixed(r.run_out_m, 2)} m beyond the toe ${point(r.toe_m)}, to ${point(r.tip_m)} m, on the ${r.side}`,
    ],
    [
      "Crest",
      `lower by ${fixed(r.crest_settlement_m, 2)} m${r.freeboard_m === null ? "" : r.freeboard_m > 0 ? `, ${fixed(r.freeboard_m, 2)} m above the pool` : `, ${fixed(-r.freeboard_m, 2)} m below the pool: it is overtopped`}`,
    ],
    [
      "Moved",
      `${number(r.moved_volume_m2, 4)} m³ per metre run, by ${fixed(r.max_displacement_m, 2)} m at most`,
    ],
  ]);
}

function histories(r) {
  if (r.history.length < 2) return null;
  const course = (key, unit) => r.history.map((m) => [m.time_s, m[key] / unit]);
  const energy = (key) => r.history.map((m) => [m.time_s, (m[key] - r.history[0][key]) / 1e3]);
  const kinds = [
    ["kinetic_J_m", "kinetic", BLUE],
    ["potential_J_m", "potential, change", ORANGE],
    ["elastic_J_m", "elastic, change", GREEN],
    ["plastic_J_m", "dissipated by yielding", PURPLE],
    ["viscous_J_m", "dissipated by artificial viscosity", GREY],
    ["water_work_J_m", "work of the water", INK],
  ];
  return h(
    "div",
    { class: "pair" },
    chart({
      title: "Displacement",
      x: { title: "time [s]" },
      y: { title: "largest displacement [m]" },
      series: [{ points: course("max_displacement_m", 1), colour: BLUE }],
    }),
    chart({
      title: "Energies",
      x: { title: "time [s]" },
      y: { title: "energy [kJ per m]" },
      series: kinds.map(([key, label, colour], i) => ({
        label,
        colour,
        dash: i > 2 ? "6 3" : null,
        points: energy(key),
      })),
    }),
  );
}
