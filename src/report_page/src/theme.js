// Colours of canvases, which know no style sheet: those that page.css gives the page, light or dark as the reader prefers.
const dark = matchMedia("(prefers-color-scheme: dark)");

/** A variable of page.css, such as "ink". */
export const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
export const isDark = () => dark.matches && !document.documentElement.classList.contains("printing");
export const onTheme = (listener) => dark.addEventListener("change", listener);

/** Of lines: the k-th of page.css (--l0 ...) with a dash of its own. */
const kDashes = [[], [], [], [], [7, 3], [7, 3], [7, 3], [2, 3]];
export const kLineCount = kDashes.length;
export const line = (k) => ({ variable: `l${k % kLineCount}`, dash: kDashes[k % kLineCount] });

/** Runs a piece of drawing in the light colours, for files and paper. */
export function inLight(draw) {
  const list = document.documentElement.classList, was = list.contains("printing");
  list.add("printing");
  try { return draw(); } finally { if (!was) list.remove("printing"); }
}
