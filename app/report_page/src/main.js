// SPDX-License-Identifier: GPL-3.0-or-later
import { comparisonPage } from "./comparison_page.js";
import { preparePaper } from "./paper.js";
import { runPage } from "./run_page.js";

// A further kind of result is a further page here, and a line in app/report_data.cpp.
const PAGES = { run: runPage, comparison: comparisonPage };

const data = JSON.parse(document.getElementById("data").textContent);
PAGES[data.kind](data, document.getElementById("page"));

preparePaper();
document.documentElement.dataset.ready = "true";
