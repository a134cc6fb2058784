// SPDX-License-Identifier: GPL-3.0-or-later
import { csvParseRows } from "d3-dsv";

/** A CSV as rows of texts by the names of its first line. Blanks after a comma are no part of a value. */
export function csvRows(text) {
  const [head = [], ...rows] = csvParseRows(text.replace(/^\ufeff/, "").replace(/(^|,)[ \t]+(?=")/gm, "$1"));
  return rows.map((row) => Object.fromEntries(head.map((name, i) => [name.trim(), (row[i] ?? "").trim()])));
}
