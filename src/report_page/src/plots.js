// The curves of a result: one graph a panel, all over the same axis (axis.js), with a line at the row that is shown. A press or drag
// in a plot chooses the row; with shift it moves the plots, with ctrl the wheel zooms them, a double click shows all again.
import { beside, h, plain, pretty, short } from "./dom.js";
import { kRuns } from "./colours.js";
import { range, twinSeries } from "./data.js";
import { anatomical, capital, quantity } from "./axis.js";
import { Graph, reach, span } from "./graph.js";
import { CanvasPen } from "./pens.js";
import { ink, inLight, kLineCount, line, onTheme } from "./theme.js";
import { differenceOf } from "./differences.js";
import { curvesSvg } from "./save.js";

/** Lines and names of series keep their colour in all panels. */
class Colours {
  constructor() { this.known = new Map(); }
  of(names) {
    const taken = new Set();
    return names.map((name, i) => {
      let k = this.known.get(name);
      if (k === undefined || taken.has(k)) {
        k = i % kLineCount;
        while (taken.has(k) && taken.size < kLineCount) k = (k + 1) % kLineCount;
        if (!this.known.has(name)) this.known.set(name, k);
      }
      taken.add(k);
      return line(k);
    });
  }
}

/** Measured columns as points of the panels: [{ panel, series (index), table, column }]; those of no panel get one of their own. */
function besideOf(run, panels) {
  const out = [];
  for (const table of run.beside)
    for (const column of table.columns.keys()) {
      if (column === "time_s" || column === run.main) continue;  // what curves are over
      const numbers = run.numbers(column);
      if (!numbers) continue;
      let place = null;
      for (const panel of panels) {
        const series = panel.series.findIndex((s) => s.column === column);
        if (series >= 0) { place = { panel, series }; break; }
      }
      if (!place) {
        const { name, unit } = quantity(column, run), panel = { title: capital(name) + (unit ? ` [${unit}]` : ""), from_zero: false, series: [{ name, column, y: numbers, bar: null }] };
        panels.push(panel);
        place = { panel, series: 0 };
      }
      out.push({ ...place, table, column });
    }
  return out;
}

export class Plots {
  constructor(runs, player, axis, shown) {
    Object.assign(this, { runs, run: runs[0], player, axis, shown });
    this.colours = new Colours();
    this.zoomed = null;  // [low, high] of x; null shows all
    this.apart = false;  // differences from the first run in the place of the curves
    const raw = [...this.run.chart.panels];
    this.beside = besideOf(this.run, raw);
    const measured = new Set(this.beside.map((b) => b.panel));
    raw.sort((a, b) => measured.has(b) - measured.has(a));  // what was measured comes first
    this.panels = raw.filter((p) => p.series.some((s) => range(s.y))).map((p) => this.panel(p));
    this.all = h("button", { type: "button", title: "Show the whole axis again (double click in a plot)", disabled: true, onclick: () => this.zoomTo(null) }, "Reset");
    const button = (text, title, act) => h("button", { type: "button", title, "aria-label": title, onclick: act }, text);
    this.bar = h("div.plotbar", { role: "group", "aria-label": "Curves" }, axis.menu(),
      button("+", "Zoom in (ctrl and wheel in a plot)", () => this.zoom(0.5)), button("−", "Zoom out", () => this.zoom(2)),
      button("◂", "Move left (shift and drag in a plot)", () => this.pan(-0.25)), button("▸", "Move right", () => this.pan(0.25)), this.all,
      runs.length > 1 ? h("label.tick", {}, h("input", { type: "checkbox", onchange: (e) => { this.apart = e.target.checked; this.redraw(); this.show(player.row); } }), `difference from ${this.run.name}`) : null);
    this.element = h("div.plots", {}, this.panels.map((p) => p.element));
    player.onChange((row) => this.show(row));
    shown.onChange(() => this.redraw());
    axis.onChange(() => { this.zoomed = null; this.redraw(); });
    onTheme(() => this.redraw());
  }

  panel(raw) {
    const styles = this.colours.of(raw.series.map((s) => s.name));
    const canvas = h("canvas", { role: "img" }), now = h("div.now", {});
    const over = h("div.over", { title: "" }), box = h("div.plot", {}, canvas, h("div.cursor", {}, now), over);
    const ends = range(...raw.series.map((s) => s.y)), most = ends ? Math.max(...ends.map(Math.abs)) : 0;
    const panel = { raw, styles, most, box, canvas, now, over, hidden: new Set(), values: [], chips: [], graph: null };
    raw.series.forEach((s, i) => { if (raw.series.length > 1 && this.isMain(s)) panel.hidden.add(i); });
    raw.series.forEach((s, i) => {
      const value = h("b", {}, ""), way = anatomical(this.run, s.column), key = this.shown.keyOf(raw.title, s.name);
      panel.values.push(value);
      panel.chips.push(h("button.chip", { type: "button", "aria-pressed": "true", title: `Show or hide ${s.name}${key ? ", here and in the picture" : ""}`,
        onclick: () => this.toggle(panel, i) }, swatch(this.runs.length === 1 ? styles[i] : { ...styles[i], dash: [] }), `${plain(s.name)}${way && way !== s.name ? ` (${way})` : ""} `, value));
    });
    const measured = this.beside.filter((b) => b.panel === raw).map((b) => h("span.chip.measured", {}, h("i.ring", { "aria-hidden": "true", style: { borderColor: `var(--${styles[b.series].variable})` } }), `${b.table.name}: ${b.table.columns.get(b.column).inFile}`));
    panel.element = h("figure.panel", {}, h("figcaption", {}, pretty(raw.title)), box, h("div.chips", {}, panel.chips, measured));
    this.scrub(panel);
    return panel;
  }

  /** Grood and Suntay's flexion, where it is all but the coordinate that curves are over: it would flatten the others. */
  isMain(s) {
    const joint = /^(.+)\.gs\.flexion_deg$/.exec(s.column)?.[1], x = joint && this.run.main.startsWith(`${joint}.`) ? this.run.numbers(this.run.main) : null;
    if (!x) return false;
    const [low, high] = range(x) ?? [0, 0];
    return x.every((v, k) => !Number.isFinite(v - s.y[k]) || Math.abs(v - s.y[k]) <= 0.05 * (high - low));
  }

  isHidden(panel, i) {
    const key = this.shown.keyOf(panel.raw.title, panel.raw.series[i].name);
    return key ? !this.shown.has(key) : panel.hidden.has(i);
  }

  toggle(panel, i) {
    const key = this.shown.keyOf(panel.raw.title, panel.raw.series[i].name), hidden = this.isHidden(panel, i);
    if (key) { this.shown.set(key, hidden); return; }
    hidden ? panel.hidden.delete(i) : panel.hidden.add(i);
    this.draw(panel);
  }

  /** What a panel shows now, as graph.js takes it. */
  graphOf(panel) {
    const { runs, axis, apart } = this, { raw, styles } = panel, curves = [], points = [];
    const colours = { axis: ink("axis"), grid: ink("grid"), zero: ink("zero"), faint: ink("faint"), event: ink("event") };
    raw.series.forEach((s, i) => {
      if (this.isHidden(panel, i)) return;
      runs.forEach((run, r) => {
        const twin = r === 0 ? s : twinSeries(run, raw, s.name);
        if (!twin || (apart && r === 0) || twin.column === axis.column) return;
        const y = apart ? differenceOf(runs[0], s.y, run, twin.y, axis) : twin.y, over = apart ? runs[0] : run;
        curves.push({ x: axis.values(over), y, bar: apart || runs.length > 1 ? null : s.bar, breaks: over.breaks, first: axis.settling(over), colour: ink(styles[i].variable), dash: runs.length === 1 ? styles[i].dash : kRuns[r % kRuns.length], width: r === 0 ? 1.8 : 1.5 });
      });
      for (const b of this.beside) {
        const at = b.panel === raw && b.series === i && !apart ? this.besideX(b) : null;
        if (at) points.push({ x: at, y: b.table.columns.get(b.column).numbers, colour: ink(styles[i].variable) });
      }
    });
    const x = this.xRange(), run = runs[0], settling = axis.settling(run);
    const marks = runs.length > 1 ? [] : run.chart.events.map((e) => ({ kind: e.kind, from: axis.place(run, e.from), to: axis.place(run, e.to) }));
    return { x, y: reach(curves, points, x, raw.from_zero && !apart), xTitle: axis.title(), whole: axis.column === "row", curves, points, marks, settled: settling > 0 ? axis.values(run)[settling] : undefined, colours };
  }

  /** The measured values of the axis; null where the table has none. */
  besideX(b) { return b.table.columns.get(this.axis.column)?.numbers ?? null; }

  whole() {
    const { axis } = this;
    return span([...this.runs.map((r) => axis.values(r)), ...(axis.column === "row" ? [] : this.beside.map((b) => this.besideX(b) ?? []))]);
  }

  xRange() { return this.zoomed ?? this.whole(); }

  zoomTo(range) {
    this.zoomed = range;
    this.all.disabled = range === null;
    this.redraw();
  }

  /** About a place on the axis, by default the pose that is shown. */
  zoom(factor, about = this.axis.values(this.run)[this.player.row]) {
    const [low, high] = this.xRange(), [first, last] = this.whole();
    if (!(about >= low && about <= high)) about = (low + high) / 2;
    const size = Math.min((high - low) * factor, last - first);
    if (size >= (last - first) * 0.999) { this.zoomTo(null); return; }
    if (size < (last - first) * 1e-4) return;
    const from = Math.min(Math.max(about - ((about - low) / (high - low)) * size, first), last - size);
    this.zoomTo([from, from + size]);
  }

  pan(share) {
    const [low, high] = this.xRange(), [first, last] = this.whole();
    const by = Math.min(Math.max((high - low) * share, first - low), last - high);
    if (this.zoomed) this.zoomTo([low + by, high + by]);
  }

  draw(panel) {
    const width = Math.max(160, Math.floor(panel.box.clientWidth)), height = width < 330 ? 172 : 190, ratio = Math.max(devicePixelRatio, 1);
    Object.assign(panel.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    Object.assign(panel.canvas.style, { width: `${width}px`, height: `${height}px` });
    const context = panel.canvas.getContext("2d");
    context.scale(ratio, ratio);
    panel.graph = new Graph(width, height);
    panel.graph.draw(new CanvasPen(context), this.graphOf(panel));
    panel.canvas.setAttribute("aria-label", `${panel.raw.title} over ${this.axis.title()}: ${panel.raw.series.map((s) => s.name).join(", ")}`);
    const { left, right, top, bottom } = panel.graph.box;
    Object.assign(panel.over.style, { left: `${left}px`, width: `${right - left}px`, top: `${top}px`, height: `${bottom - top}px` });
    Object.assign(panel.now.parentElement.style, { left: `${left}px`, width: `${right - left}px`, top: `${top}px`, height: `${bottom - top}px` });
    panel.chips.forEach((chip, i) => {
      chip.setAttribute("aria-pressed", String(!this.isHidden(panel, i)));
      chip.hidden = panel.raw.series[i].column === this.axis.column;  // the axis itself
    });
    this.place(panel);
  }

  scrub(panel) {
    const { over } = panel;
    const value = (e) => panel.graph.xAt(panel.graph.box.left + e.clientX - over.getBoundingClientRect().left);
    const choose = (e) => {
      this.player.stop();
      this.player.set(this.axis.nearest(this.axis.values(this.run), value(e), this.axis.settling(this.run), this.player.row));
    };
    let down = null;
    over.addEventListener("pointerdown", (e) => {
      down = e.shiftKey ? { x: e.clientX, range: this.xRange() } : {};
      over.setPointerCapture(e.pointerId);
      if (!e.shiftKey) choose(e);
    });
    over.addEventListener("pointermove", (e) => {
      if (!down) return;
      if (!down.range) { choose(e); return; }
      const [low, high] = down.range, [first, last] = this.whole(), by = ((down.x - e.clientX) / over.clientWidth) * (high - low);
      const moved = Math.min(Math.max(by, first - low), last - high);
      if (this.zoomed) this.zoomTo([low + moved, high + moved]);
    });
    for (const end of ["pointerup", "pointercancel"]) over.addEventListener(end, () => { down = null; });
    over.addEventListener("dblclick", () => this.zoomTo(null));
    over.addEventListener("wheel", (e) => { if (e.ctrlKey || e.metaKey) { e.preventDefault(); this.zoom(e.deltaY < 0 ? 0.8 : 1.25, value(e)); } }, { passive: false });
  }

  place(panel) {
    if (!panel.graph) return;
    const x = panel.graph.toX(this.axis.values(this.run)[this.player.row]) - panel.graph.box.left;
    panel.now.hidden = !Number.isFinite(x);
    if (Number.isFinite(x)) panel.now.style.left = `${x}px`;
  }

  show(row) {
    for (const panel of this.panels) {
      this.place(panel);
      panel.raw.series.forEach((s, i) => {
        const bar = s.bar && Number.isFinite(s.bar[row]) && s.bar[row] > 0 ? ` ± ${short(s.bar[row], 2)}` : "";
        const others = this.runs.slice(1).map((r) => { const twin = twinSeries(r, panel.raw, s.name); return ` | ${twin ? short(beside(twin.y[this.axis.twin(row, r)], panel.most)) : "–"}`; });
        panel.values[i].textContent = short(beside(s.y[row], panel.most)) + bar + others.join("");
      });
    }
  }

  redraw() { for (const panel of this.panels) if (panel.box.clientWidth > 0) this.draw(panel); }
  resize() { this.redraw(); }

  /** All curves that are shown as one SVG file, in the colours of paper. */
  svg() { return inLight(() => curvesSvg(this)); }
}

export function swatch({ variable, dash }) {
  const mark = h("i.swatch", { "aria-hidden": "true" }), colour = `var(--${variable})`;
  mark.style.background = dash.length === 0 ? colour : `repeating-linear-gradient(to right, ${colour} 0 ${dash[0]}px, transparent ${dash[0]}px ${dash[0] + dash[1]}px)`;
  return mark;
}
