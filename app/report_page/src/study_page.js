// SPDX-License-Identifier: GPL-3.0-or-later
// One case for many values of its keys.
import { notices } from "./answer.js";
import { BLUE } from "./colours.js";
import { h, table } from "./dom.js";
import { factor, number } from "./numbers.js";
import { provenance } from "./provenance.js";
import { ruler } from "./ruler.js";
import { header } from "./run_page.js";
import { curves } from "./study_curves.js";
import { phreaticLines } from "./study_lines.js";
import { label, namesOf, solved, valueText } from "./study_values.js";
import { tornado } from "./tornado.js";

export function studyPage(data, page) {
  const { study } = data;
  document.title = `${study.title} – berm study`;
  const chapters = [
    ["answer", "Members"],
    ["curves", "Curves"],
    ["tornado", "What matters most"],
    ["phreatic", "Phreatic lines"],
    ["provenance", "Provenance"],
  ];
  const contents = [
    members(study),
    curves(study, data.reference),
    tornado(study),
    phreaticLines(study, data.phreatic),
    provenance(data),
  ];
  const there = chapters.filter((_, i) => contents[i]);
  page.append(header(study.title, there, "study: one case, many values"), ...contents.filter(Boolean));
}

function members(study) {
  const asked = study.stage !== "seepage";
  const flows = study.members.some((m) => m.discharge_m2_s !== null);
  const columns = [
    ...namesOf(study).map((title) => ({ title })),
    ...(asked ? [{ title: "F", number: true }, { title: "may lie" }, { title: "mechanism" }] : []),
    ...(flows ? [{ title: "discharge [m²/s]", number: true }] : []),
    { title: "outcome" },
  ];
  const row = (m) => [
    ...namesOf(study).map((key) => valueText(m.values[key])),
    ...(asked
      ? [
          solved(m) ? h("strong", {}, factor(m.factor)) : "no answer",
          m.low === null ? null : `${factor(m.low)} to ${factor(m.high)}`,
          m.mechanism,
        ]
      : []),
    ...(flows ? [m.discharge_m2_s === null ? null : number(m.discharge_m2_s, 4)] : []),
    m.reason ? `${m.status}: ${m.reason}` : m.status,
  ];
  const factors = study.members.filter(solved);
  return h(
    "section",
    { id: "answer", "aria-label": "Members" },
    notices({ complete: study.complete }),
    factors.length
      ? ruler(
          factors.map((m) => ({ ...m, label: label(m), colour: BLUE, marks: [] })),
          "Factors of safety of each member",
        )
      : null,
    table(columns, study.members.map(row), "Members"),
  );
}
