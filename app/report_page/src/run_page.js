// SPDX-License-Identifier: GPL-3.0-or-later
// One run: the answer, then what it rests on.
import { answer } from "./answer.js";
import { h } from "./dom.js";
import { inputs } from "./inputs.js";
import { provenance } from "./provenance.js";
import { runOut } from "./run_out_page.js";
import { seepage } from "./seepage_page.js";
import { stability } from "./stability_page.js";

export function runPage(data, page) {
  const { result } = data;
  document.title = `${result.title} – berm report`;
  const searched =
    result.stability &&
    (result.stability.trials.length || result.stability.factor !== null || result.stability.reason);
  const chapters = [
    ["section", "Section", inputs(data)],
    result.seepage && ["seepage", "Seepage", seepage(data)],
    (searched || (data.particles && !result.runout)) && ["stability", "Stability", stability(data)],
    result.runout && ["run-out", "Run-out", runOut(data)],
    ["provenance", "Provenance", provenance(data)],
  ].filter(Boolean);
  page.append(
    header(result.title, chapters, "report of one analysis"),
    answer(data),
    ...chapters.map(([, , content]) => content),
  );
}

export const header = (title, chapters, kind) =>
  h(
    "header",
    {},
    h("p", { class: "kind" }, h("span", { class: "name" }, "berm"), ` ${kind}`),
    h("h1", {}, title),
    h(
      "nav",
      { "aria-label": "Chapters" },
      chapters.map(([id, name]) => h("a", { href: `#${id}` }, name)),
    ),
  );
