// The curves of a result: one plot a panel, all over the same axis, with a line at the row that is shown. A press or drag
// in a plot chooses the row.
import uPlot from "uplot";
import { h, short, pretty } from "./dom.js";
import { kLines, kRuns } from "./colours.js";
import { range, twinRow, twinSeries } from "./data.js";
import { nearestRow } from "./player.js";

const kAxis = "#3c4650", kGrid = "#e4e8ec", kFont = "12px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";

/** Rows in the order of x, which uPlot wants ascending, and NaN as the null that interrupts a line. */
class Sorted {
  constructor(x) {
    this.order = [...x.keys()].filter((k) => Number.isFinite(x[k]));
    if (this.order.some((k, i) => i > 0 && x[k] < x[this.order[i - 1]])) this.order.sort((a, b) => x[a] - x[b] || a - b);
    this.x = this.order.map((k) => x[k]);
  }
  of(y) { return this.order.map((k) => (Number.isFinite(y[k]) ? y[k] : null)); }
  /** Where no line goes: from the row before one that begins another branch, in pixels of a plot. */
  gaps(u, breaks) {
    const at = (i) => u.valToPos(this.x[i], "x", true);
    return breaks.map((k) => this.order.indexOf(k)).filter((i) => i > 0).map((i) => [at(i - 1), at(i)]);
  }
}

const inOrder = (gaps) => gaps.sort((a, b) => a[0] - b[0]);

function padded(low, high, fromZero) {
  if (Math.max(Math.abs(low), Math.abs(high)) < 1e-11) return [fromZero ? 0 : -1, 1];  // nothing, or what rounding leaves of it
  if (fromZero) { low = Math.min(0, low); high = Math.max(0, high); }
  const size = Math.max(Math.abs(low), Math.abs(high));
  const pad = high - low < 1e-6 * size ? 0.05 * size : 0.06 * (high - low);  // what does not change is no noise to zoom into
  return [fromZero && low === 0 ? 0 : low - pad, fromZero && high === 0 ? 0 : high + pad];
}

/** What the bars of a panel reach as well. */
function withBars(raw, low, high) {
  for (const s of raw.series)
    for (let k = 0; s.bar && k < s.y.length; ++k) {
      if (!Number.isFinite(s.y[k]) || !Number.isFinite(s.bar[k])) continue;
      low = Math.min(low, s.y[k] - s.bar[k]);
      high = Math.max(high, s.y[k] + s.bar[k]);
    }
  return [low, high];
}

/** Lines and names of series keep their colour in all panels. */
class Colours {
  constructor() { this.known = new Map(); }
  of(names) {
    const taken = new Set();
    return names.map((name, i) => {
      let k = this.known.get(name);
      if (k === undefined || taken.has(k)) {
        k = i % kLines.length;
        while (taken.has(k) && taken.size < kLines.length) k = (k + 1) % kLines.length;
        if (!this.known.has(name)) this.known.set(name, k);
      }
      taken.add(k);
      return kLines[k];
    });
  }
}

export class Plots {
  constructor(runs, player) {
    this.runs = runs;
    this.run = runs[0];
    this.player = player;
    this.sorted = runs.map((r) => new Sorted(r.chart.x));
    this.colours = new Colours();
    this.panels = this.run.chart.panels.filter((p) => p.series.some((s) => range(s.y))).map((p) => this.panel(p));
    this.element = h("div.plots", {}, this.panels.map((p) => p.element));
    player.onChange((row) => this.show(row));
  }

  panel(raw) {
    const styles = this.colours.of(raw.series.map((s) => s.name));
    const box = h("div.plot", {});
    const panel = { raw, styles, box, hidden: new Set(), values: [], plot: null };
    const chips = raw.series.map((s, i) => {
      const value = h("b", {}, "");
      panel.values.push(value);
      const chip = h("button.chip", { type: "button", "aria-pressed": "true", title: `Show or hide ${s.name}`,
        onclick: () => this.toggle(panel, i, chip) }, swatch(this.runs.length === 1 ? styles[i] : { colour: styles[i].colour, dash: [] }), `${s.name} `, value);
      return chip;
    });
    panel.element = h("figure.panel", {}, h("figcaption", {}, pretty(raw.title)), box, h("div.chips", {}, chips));
    return panel;
  }

  toggle(panel, i, chip) {
    const hide = !panel.hidden.has(i);
    hide ? panel.hidden.add(i) : panel.hidden.delete(i);
    chip.setAttribute("aria-pressed", String(!hide));
    this.runs.forEach((_, r) => panel.plot.setSeries(1 + r * panel.raw.series.length + i, { show: !hide }));
  }

  data(panel) {
    if (this.runs.length === 1) {
      const s = this.sorted[0];
      return [s.x, ...panel.raw.series.map((one) => s.of(one.y))];
    }
    const tables = this.runs.map((run, r) => [this.sorted[r].x, ...panel.raw.series.map((one) => {
      const twin = twinSeries(run, panel.raw, one.name);
      return twin ? this.sorted[r].of(twin.y) : this.sorted[r].x.map(() => null);
    })]);
    return uPlot.join(tables);
  }

  draw(panel) {
    const width = Math.max(120, Math.floor(panel.box.clientWidth)), height = width < 330 ? 172 : 190;
    if (panel.plot) { panel.plot.setSize({ width, height }); this.place(panel); return; }
    const { raw, styles } = panel, count = this.sorted[0].x.length;
    const series = [{}];
    this.runs.forEach((_, r) => raw.series.forEach((s, i) => series.push({
      label: s.name, stroke: styles[i].colour, width: r === 0 ? 1.8 : 1.5, dash: this.runs.length === 1 ? styles[i].dash : kRuns[r % kRuns.length], points: { show: r === 0 && count <= 2, size: 7, fill: styles[i].colour },
      gaps: (u, _s, _from, _to, empty) => (this.runs.length > 1 ? empty : inOrder([...empty, ...this.sorted[0].gaps(u, this.run.chart.breaks)])) })));
    const axis = { stroke: kAxis, font: kFont, grid: { stroke: kGrid, width: 1 }, ticks: { stroke: kGrid, width: 1, size: 4 } };
    const options = {
      width, height, legend: { show: false }, cursor: { show: false }, padding: [8, 12, 0, 0],
      scales: { x: { time: false, range: (_, low, high) => (high > low ? [low, high] : [low - 1, high + 1]) },
        y: { range: (_, low, high) => (low === null ? [0, 1] : padded(...withBars(raw, low, high), raw.from_zero)) } },
      axes: [{ ...axis, size: 22, gap: 2, label: pretty(this.run.chart.x_title), labelFont: kFont, labelSize: 18, labelGap: 0,
        space: 55, ...(/^row/.test(this.run.chart.x_title) ? { incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000] } : {}) }, { ...axis, size: axisWidth, gap: 4, space: 30, values: (_, ticks) => ticks.map(tick) }],
      series, hooks: { drawAxes: [(u) => this.marks(u)], drawSeries: [(u, i) => this.band(u, panel, i)] },
    };
    panel.plot = new uPlot(options, this.data(panel), panel.box);
    panel.line = h("div.now", {});
    panel.plot.over.append(panel.line);
    panel.box.setAttribute("role", "img");
    panel.box.setAttribute("aria-label", `${raw.title} over ${this.run.chart.x_title}: ${raw.series.map((s) => s.name).join(", ")}`);
    this.scrub(panel.plot.over, panel);
    this.place(panel);
  }

  /** Events, as lines through the plot; a stretch that was stepped over as a band. */
  marks(u) {
    if (this.runs.length > 1) return;  // whose they are could not be told
    const g = u.ctx, { left, top, width, height } = u.bbox;
    g.save();
    g.beginPath();
    g.rect(left, top, width, height);
    g.clip();
    for (const e of this.run.chart.events) {
      const from = u.valToPos(e.from, "x", true), to = u.valToPos(e.to, "x", true);
      if (e.kind === "window") { g.fillStyle = "#cc79a744"; g.fillRect(Math.min(from, to), top, Math.max(2, Math.abs(to - from)), height); continue; }
      g.strokeStyle = e.kind === "other" ? "#b0308a" : "#7b8794";
      g.lineWidth = devicePixelRatio;
      g.setLineDash(e.kind === "lost" ? [2, 3] : e.kind === "gained" ? [6, 3] : []);
      g.beginPath();
      g.moveTo(from, top);
      g.lineTo(from, top + height);
      g.stroke();
    }
    if (u.scales.y.min < 0 && u.scales.y.max > 0) {
      const zero = u.valToPos(0, "y", true);
      g.strokeStyle = "#9aa5b0"; g.lineWidth = devicePixelRatio; g.setLineDash([]);
      g.beginPath(); g.moveTo(left, zero); g.lineTo(left + width, zero); g.stroke();
    }
    g.restore();
  }

  /** How far a curve may be off. */
  band(u, panel, i) {
    const s = panel.raw.series[i - 1];
    if (!s || !s.bar || panel.hidden.has(i - 1)) return;
    const { x, order } = this.sorted[0], g = u.ctx;
    g.save();
    g.beginPath();
    g.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    g.clip();
    g.fillStyle = panel.styles[i - 1].colour + "33";
    g.beginPath();
    const rows = order.map((k, n) => [x[n], s.y[k], s.bar[k]]).filter((r) => r.every(Number.isFinite));
    rows.forEach(([at, y, bar]) => g.lineTo(u.valToPos(at, "x", true), u.valToPos(y + bar, "y", true)));
    rows.reverse().forEach(([at, y, bar]) => g.lineTo(u.valToPos(at, "x", true), u.valToPos(y - bar, "y", true)));
    g.fill();
    g.restore();
  }

  scrub(over, panel) {
    const choose = (e) => {
      const box = over.getBoundingClientRect();
      this.player.stop();
      this.player.set(nearestRow(this.run.chart.x, panel.plot.posToVal(e.clientX - box.left, "x")));
    };
    let down = false;
    over.addEventListener("pointerdown", (e) => { down = true; over.setPointerCapture(e.pointerId); choose(e); });
    over.addEventListener("pointermove", (e) => { if (down) choose(e); });
    for (const end of ["pointerup", "pointercancel"]) over.addEventListener(end, () => { down = false; });
  }

  place(panel) {
    if (!panel.plot) return;
    const x = this.run.chart.x[this.player.row];
    panel.line.hidden = !Number.isFinite(x);
    if (Number.isFinite(x)) panel.line.style.left = `${panel.plot.valToPos(x, "x")}px`;
  }

  show(row) {
    for (const panel of this.panels) {
      this.place(panel);
      panel.raw.series.forEach((s, i) => {
        const bar = s.bar && Number.isFinite(s.bar[row]) && s.bar[row] > 0 ? ` ± ${short(s.bar[row], 2)}` : "";
        const others = this.runs.slice(1).map((r) => { const twin = twinSeries(r, panel.raw, s.name); return ` | ${twin ? short(twin.y[twinRow(this.run, row, r)]) : "–"}`; });
        panel.values[i].textContent = short(s.y[row]) + bar + others.join("");
      });
    }
  }

  resize() { for (const panel of this.panels) this.draw(panel); }
}

const tick = (v) => (v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential() : String(+v.toPrecision(8)));

/** As wide as its longest number. */
function axisWidth(u, values) {
  const longest = (values ?? []).reduce((most, v) => Math.max(most, v.length), 2);
  return 14 + 7 * longest;
}

export function swatch({ colour, dash }) {
  const line = h("i.swatch", { "aria-hidden": "true" });
  line.style.background = dash.length === 0 ? colour : `repeating-linear-gradient(to right, ${colour} 0 ${dash[0]}px, transparent ${dash[0]}px ${dash[0] + dash[1]}px)`;
  return line;
}
