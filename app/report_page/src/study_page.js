// SPDX-License-Identifier: GPL-3.0-or-later
// One case for many values of its keys.
import { notices } from "./answer.js";
import { chart } from "./chart.js";
import { BLUE } from "./colours.js";
import { chapter, h, table } from "./dom.js";
import { factor, number } from "./numbers.js";
import { provenance } from "./provenance.js";
import { ruler } from "./ruler.js";
import { header } from "./run_page.js";

export function studyPage(data, page) {
  const { study } = data;
  document.title = `${study.title} – berm study`;
  const chapters = [
    ["answer", "Members"],
    ["curves", "Curves"],
    ["provenance", "Provenance"],
  ];
  const drawn = curves(study);
  page.append(
    header(study.title, drawn ? chapters : chapters.filter(([id]) => id !== "curves"), "study: one case, many values"),
    members(study),
  );
  if (drawn) page.append(drawn);
  page.append(provenance(data));
}

const keysOf = (study) => study.vary.flatMap((variation) => variation.keys);
const valueText = (value) =>
  value === null || value === undefined ? null : typeof value === "object" ? JSON.stringify(value) : String(value);
const label = (member) => member.varied.map((key) => `${key.split(".").at(-1)} = ${valueText(member.values[key])}`).join(", ");
const solved = (member) => member.complete && member.factor !== null;

function members(study) {
  const asked = study.stage !== "seepage";
  const flows = study.members.some((m) => m.discharge_m2_s !== null);
  const columns = [
    ...keysOf(study).map((title) => ({ title })),
    ...(asked ? [{ title: "F", number: true }, { title: "may lie" }, { title: "mechanism" }] : []),
    ...(flows ? [{ title: "discharge [m²/s]", number: true }] : []),
    { title: "outcome" },
  ];
  const row = (m) => [
    ...keysOf(study).map((key) => valueText(m.values[key])),
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
          factors.map((m) => ({ ...m, label: label(m) || "the case itself", colour: BLUE, marks: [] })),
          "Factors of safety of each member",
        )
      : null,
    table(columns, study.members.map(row), "Members"),
  );
}

/** F and discharge against the one key that varies, if it is a number. */
function curves(study) {
  const [key, ...others] = keysOf(study);
  const numeric = study.members.every((m) => typeof m.values[key] === "number");
  if (others.length || !numeric) return null;
  const along = (value, kept) =>
    study.members
      .filter((m) => kept(m) && m[value] !== null)
      .map((m) => [m.values[key], m[value]])
      .sort((a, b) => a[0] - b[0]);
  const figure = (title, unit, points) =>
    points.length > 1
      ? chart({
          title: `${title} against ${key}`,
          x: { title: key, zero: false },
          y: { title: `${title} [${unit}]`, zero: false },
          series: [
            { points, colour: BLUE, width: 2.2 },
            { points, colour: BLUE, shape: "dot", tips: points.map(([x, y]) => `${x}: ${number(y, 4)}`) },
          ],
        })
      : null;
  const figures = [
    figure("factor of safety", "-", along("factor", solved)),
    figure(
      "discharge",
      "m³/day per metre",
      along("discharge_m2_s", () => true).map(([x, q]) => [x, 86400 * q]),
    ),
  ].filter(Boolean);
  return figures.length ? chapter("curves", "What changes with it", figures) : null;
}
