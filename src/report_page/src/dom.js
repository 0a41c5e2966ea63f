// Elements made from data: text is always text, never markup.

/** h("p.note", {title: "..."}, "text", child): attributes, on... listeners; children that are null are left out. */
export function h(kind, properties = {}, ...children) {
  const [tag, ...classes] = kind.split(".");
  const element = document.createElement(tag);
  if (classes.length) element.className = classes.join(" ");
  for (const [name, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "style") Object.assign(element.style, value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) if (child !== null && child !== undefined) element.append(child);
  return element;
}

/** A table with a head; cells are text or elements. */
export function table(head, rows, kind = "table") {
  return h(kind, {}, h("thead", {}, h("tr", {}, head.map((c) => h("th", { scope: "col" }, c)))),
    h("tbody", {}, rows.map((r) => h("tr", {}, r.map((c) => h("td", {}, c))))));
}

/** A number to about `digits` digits, without a long tail: "12.3", "−0.0042", "1.2e-9", and "–" for none. */
export const short = (value, digits = 4) => signOf(digitsOf(value, digits));

/** The same as programs read it: "-0.0042". */
export function digitsOf(value, digits = 4) {
  if (!Number.isFinite(value)) return "–";
  if (Math.abs(value) < 1e-12) return "0";  // what rounding leaves of it
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e6) return value.toExponential(digits - 2);
  const decimals = Math.max(0, Math.min(6, digits - 1 - Math.floor(Math.log10(size))));
  return value.toFixed(Math.min(decimals, 4));
}

/** A value beside others up to `most`: what rounding leaves of a zero is 0. */
export const beside = (value, most) => (Math.abs(value) < 1e-6 * most ? 0 : value);

/** With a minus sign as print has it, as wide as a plus. */
export const signOf = (text) => text.replace(/^-/, "−");

/** Units as print has them. */
export const pretty = (text) => text.replace(/\[mm2\]/, "[mm²]").replace(/\bmm2\b/, "mm²");

/** A name of a scene or table as words: "j1.angle" is "j1 angle". */
export const plain = (name) => name.replace(/[._]/g, " ");
