// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures follow the width that they have; on paper, that of a sheet.

const drawings = new Set();

/** Call `draw(width)` with the element's width now and whenever it changes. */
export function followWidth(element, draw) {
  let last = 0;
  const look = () => {
    const width = Math.floor(element.clientWidth);
    if (!width || width === last) return;
    last = width;
    draw(width);
  };
  drawings.add(look);
  new ResizeObserver(look).observe(element);
}

/** Before printing everything is open and drawn for the sheet, at once: no observer is heard by then. */
export function preparePaper() {
  let opened = [];
  const redraw = () => drawings.forEach((look) => look());
  window.addEventListener("beforeprint", () => {
    opened = [...document.querySelectorAll("details:not([open])")];
    opened.forEach((d) => (d.open = true));
    document.body.classList.add("paper");
    redraw();
  });
  window.addEventListener("afterprint", () => {
    opened.forEach((d) => (d.open = false));
    document.body.classList.remove("paper");
    redraw();
  });
}
