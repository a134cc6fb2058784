// SPDX-License-Identifier: GPL-3.0-or-later
// Elements. Text is only ever put in as text: nothing that a user wrote can become markup.

const SVG = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false));
  return element;
}

/** An HTML element; attributes that begin with "on" are listeners, children elements or texts. */
export const h = (tag, attributes = {}, ...children) =>
  fill(document.createElement(tag), attributes, children);

/** The same for SVG. */
export const s = (tag, attributes = {}, ...children) =>
  fill(document.createElementNS(SVG, tag), attributes, children);

/** A table that scrolls inside itself. Columns: { title, number (aligned right) }; rows: cells. */
export function table(columns, rows, caption) {
  const align = (i) => (columns[i].number ? "number" : null);
  return h(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": caption ?? "table" },
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          columns.map((c, i) => h("th", { scope: "col", class: align(i) }, c.title)),
        ),
      ),
      h(
        "tbody",
        {},
        rows.map((row) =>
          h(
            "tr",
            { class: row.look ?? null },
            (row.cells ?? row).map((cell, i) => h("td", { class: align(i) }, cell ?? "–")),
          ),
        ),
      ),
    ),
  );
}

/** Rows of a name and a value. */
export const facts = (rows) =>
  h(
    "dl",
    { class: "facts" },
    rows.filter(Boolean).map(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]),
  );

/** A choice among a few: { value: label }. Calls `chosen(value)`. */
export function choice(label, options, chosen, first) {
  const select = h(
    "select",
    { "aria-label": label, onchange: () => chosen(select.value) },
    Object.entries(options).map(([value, text]) => h("option", { value, selected: value === first }, text)),
  );
  return h("label", { class: "choice" }, h("span", {}, label), select);
}

export const chapter = (id, title, ...children) =>
  h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), children);
