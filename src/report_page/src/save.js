// What a reader takes along: the picture (PNG), the curves (SVG), the numbers (CSV), a moving picture (WebM). Files are made in
// the browser; nothing leaves it.
import { h, plain, pretty } from "./dom.js";
import { Graph } from "./graph.js";
import { SvgPen } from "./pens.js";
import { ink } from "./theme.js";

/** Offers a file to the reader. */
export function offer(name, blob) {
  const url = URL.createObjectURL(blob), link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

const stem = (run) => (run.name || "genu").replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "").slice(0, 60) || "genu";

/** The shortest text of a number in single precision. */
export function numberText(value) {
  for (let digits = 6; digits < 9; ++digits) if (Math.fround(+value.toPrecision(digits)) === value) return String(+value.toPrecision(digits));
  return String(+value.toPrecision(9));
}

const cell = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** The rows of results.csv that the page has, in single precision. */
export function resultsCsv(run) {
  const names = [...run.columns.keys()], lines = [names.map(cell).join(",")];
  for (let row = 0; row < run.rows; ++row)
    lines.push(names.map((n) => { const c = run.columns.get(n); return c.words ? cell(run.word(n, row)) : Number.isFinite(c.numbers[row]) ? numberText(c.numbers[row]) : ""; }).join(","));
  return lines.join("\n") + "\n";
}

/** The panels of plots.js in two columns, with the names of their curves below each. */
export function curvesSvg(plots) {
  const width = 470, height = 220, title = 24, pen = new SvgPen();
  const shown = plots.panels, across = Math.min(2, shown.length), ground = ink("paper"), text = ink("ink");
  const heights = shown.map((p) => title + height + 18 * Math.ceil(p.raw.series.length / 4) + 16);
  let top = 40;
  pen.text(plots.run.summary.title || plots.run.summary.scene, [16, 22], { colour: text, align: "left", size: 15, bold: true });
  shown.forEach((panel, i) => {
    const column = i % across, left = column * width;
    pen.parts.push(`<g transform="translate(${left} ${top + title})">`);
    pen.text(pretty(panel.raw.title), [14, -10], { colour: text, align: "left", size: 13, bold: true });
    new Graph(width - 10, height).draw(pen, plots.graphOf(panel));
    panel.raw.series.forEach((s, k) => {
      if (plots.isHidden(panel, k)) return;
      const x = 16 + (k % 4) * 112, y = height + 14 + 18 * Math.floor(k / 4), style = panel.styles[k];
      pen.line([[x, y], [x + 18, y]], { colour: ink(style.variable), width: 2, dash: plots.runs.length === 1 ? style.dash : [] });
      pen.text(plain(s.name), [x + 23, y], { colour: text, align: "left", size: 11 });
    });
    pen.parts.push("</g>");
    if (column === across - 1 || i === shown.length - 1) top += Math.max(...heights.slice(i - column, i + 1));
  });
  return pen.file(across * width, top + 10, ground);
}

/** What the picture shows with its legends, at twice its size, as a PNG. */
export async function picturePng(view) {
  const { element, renderer } = view, width = element.clientWidth, height = element.clientHeight, factor = 2;
  const was = renderer.getPixelRatio();
  renderer.setPixelRatio(factor);
  renderer.setSize(width, height, false);
  view.paintNow();
  const canvas = h("canvas", { width: width * factor, height: height * factor }), g = canvas.getContext("2d");
  g.drawImage(view.canvas, 0, 0, canvas.width, canvas.height);
  renderer.setPixelRatio(was);
  renderer.setSize(width, height, false);
  view.paintNow();
  g.scale(factor, factor);
  view.drawLegends(g, width, height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}

/** Why this browser cannot record; empty where it can. */
export function whyNoRecording(canvas) {
  if (typeof MediaRecorder === "undefined" || typeof canvas.captureStream !== "function") return "This browser has no recorder (MediaRecorder). Save the picture instead, or open the page in a recent Firefox or Chromium.";
  if (!MediaRecorder.isTypeSupported("video/webm")) return "This browser records no WebM. Save the picture instead, or open the page in a recent Firefox or Chromium.";
  return "";
}

/** Plays all poses once and records the picture. */
export async function recording(view, player) {
  const stream = view.canvas.captureStream(30), recorder = new MediaRecorder(stream, { mimeType: "video/webm", videoBitsPerSecond: 6_000_000 }), parts = [];
  recorder.ondataavailable = (e) => { if (e.data.size > 0) parts.push(e.data); };
  const ended = new Promise((done, fail) => { recorder.onstop = done; recorder.onerror = () => fail(new Error("the browser's recorder stopped with an error")); });
  player.stop();
  player.set(0);
  view.paintNow();
  recorder.start(200);
  player.play();
  const beat = setInterval(() => view.paint(), 100);
  await new Promise((done) => { const wait = () => (player.playing ? setTimeout(wait, 50) : setTimeout(done, 300)); wait(); });
  clearInterval(beat);
  recorder.stop();
  await ended;
  stream.getTracks().forEach((t) => t.stop());
  return new Blob(parts, { type: "video/webm" });
}

/** The menu; `said` is where it says what it could not do. */
export function saveMenu(view, plots, player) {
  const run = plots.run, name = stem(run), said = h("p.small.said", { role: "status" });
  const button = (text, act) => h("button", { type: "button", onclick: async () => { said.textContent = ""; try { await act(); } catch (e) { said.textContent = `Not saved: ${e.message}`; } } }, text);
  const film = async () => {
    const why = whyNoRecording(view.canvas);
    if (why) { said.textContent = why; return; }
    said.textContent = "Recording: the poses play once.";
    const blob = await recording(view, player);
    offer(`${name}.webm`, blob);
    said.textContent = "";
  };
  return h("details.more.save", {}, h("summary", {}, "Save"), h("div.menu", {},
    view.renderer ? button("Picture (PNG, double size)", async () => offer(`${name}.png`, await picturePng(view))) : null,
    button("Curves (SVG)", () => offer(`${name}.svg`, new Blob([plots.svg()], { type: "image/svg+xml" }))),
    button("Numbers (CSV)", () => offer(`${name}.csv`, new Blob([resultsCsv(run)], { type: "text/csv" }))),
    view.renderer && run.rows > 1 ? button("Animation (WebM)", film) : null, said));
}
