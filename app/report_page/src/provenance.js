// SPDX-License-Identifier: GPL-3.0-or-later
// Where the numbers come from: program, case, times.
import licences from "licences.txt";
import { chapter, facts, h, table } from "./dom.js";
import { fixed, number } from "./numbers.js";

export function provenance(data) {
  const result = data.result ?? data.study ?? data.waters[0].result;
  return chapter(
    "provenance",
    "Provenance",
    facts([
      ["Program", `berm ${result.berm}`],
      ["Case file", result.case.path],
      ["SHA-256 of the case file", h("code", { id: "sha256" }, data.case.sha256)],
      result.case.overrides.length > 0 && ["Set beside it", result.case.overrides.join("; ")],
    ]),
    h(
      "details",
      { id: "case" },
      h("summary", {}, "Text of the case file"),
      h("pre", { class: "scroll", tabindex: "0" }, data.case.text),
    ),
    h(
      "details",
      {},
      h("summary", {}, "Versions"),
      h("pre", { class: "scroll" }, `This page was written by\n${data.version}`),
    ),
    data.result && times(result),
    h(
      "details",
      { class: "screen" },
      h("summary", {}, "Libraries in this page"),
      h("pre", { class: "scroll", tabindex: "0" }, licences),
    ),
    h("p", { class: "note screen" }, "This page stands alone: it loads nothing. Drawn with d3 and fflate."),
  );
}

function times(result) {
  const { stages, threads, particle_steps_per_cpu_second: rate } = result.performance;
  const sum = (key) => stages.reduce((total, stage) => total + stage[key], 0);
  return h(
    "details",
    {},
    h(
      "summary",
      {},
      `Times: ${fixed(sum("wall_s"), 1)} s on ${threads} ${threads === 1 ? "thread" : "threads"}`,
    ),
    table(
      [{ title: "Stage" }, { title: "wall [s]", number: true }, { title: "CPU [s]", number: true }],
      [
        ...stages.map((stage) => [stage.stage, fixed(stage.wall_s, 2), fixed(stage.cpu_s, 2)]),
        ["all", fixed(sum("wall_s"), 2), fixed(sum("cpu_s"), 2)],
      ],
      "Times",
    ),
    rate ? h("p", { class: "note" }, `${number(rate, 3)} particle steps per CPU second`) : null,
  );
}
