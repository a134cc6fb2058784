// SPDX-License-Identifier: GPL-3.0-or-later
import { comparisonPage } from "./comparison_page.js";
import { h } from "./dom.js";
import { preparePaper } from "./paper.js";
import { runPage } from "./run_page.js";
import { studyPage } from "./study_page.js";

// A further kind of result is a further page here, and a line in app/report_data.cpp.
const PAGES = { run: runPage, comparison: comparisonPage, study: studyPage };

const data = JSON.parse(document.getElementById("data").textContent);
const page = document.getElementById("page");
try {
  PAGES[data.kind](data, page);
} catch (error) {
  page.prepend(
    h(
      "p",
      { class: "notice partial" },
      `This page cannot be drawn in full (${error.message}). The numbers are in result.json beside it.`,
    ),
  );
  console.error(error);
}

preparePaper();
document.documentElement.dataset.ready = "true";
