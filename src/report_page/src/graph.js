// One graph: axes with round ticks, curves in the order of their rows, bands, marks and points, drawn with any pen (pens.js).
import { range } from "./data.js";

/** A round step that cuts a span into about `wanted` parts. */
export function niceStep(span, wanted) {
  const raw = span / wanted, power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((f) => f * power).find((s) => s >= raw * (1 - 1e-9));
}

export function ticksOf([low, high], wanted, whole = false) {
  const step = Math.max(niceStep(high - low, Math.max(1, wanted)), whole ? 1 : 0), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && out.length < 50; ++k) out.push(k === 0 ? 0 : +(k * step).toPrecision(12));
  return out;
}

export const tickText = (v) => (v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential().replace("-", "−").replace("e−", "e-") : String(+v.toPrecision(8)).replace("-", "−"));

export function padded(low, high, fromZero) {
  if (Math.max(Math.abs(low), Math.abs(high)) < 1e-11) return [fromZero ? 0 : -1, 1];  // nothing, or what rounding leaves of it
  if (fromZero) { low = Math.min(0, low); high = Math.max(0, high); }
  const size = Math.max(Math.abs(low), Math.abs(high));
  const pad = high - low < 1e-6 * size ? 0.05 * size : 0.06 * (high - low);  // what does not change is no noise to zoom into
  return [fromZero && low === 0 ? 0 : low - pad, fromZero && high === 0 ? 0 : high + pad];
}

/** The y range of curves (with bands) and points whose x lies within a range. */
export function reach(curves, points, [from, to], fromZero) {
  let low = Infinity, high = -Infinity;
  const take = (x, y, bar = 0) => { if (x >= from && x <= to && Number.isFinite(y)) { low = Math.min(low, y - bar); high = Math.max(high, y + bar); } };
  const eps = 1e-6 * Math.abs(to - from);
  from -= eps; to += eps;
  for (const c of curves) for (let k = c.first ?? 0; k < c.x.length; ++k) take(c.x[k], c.y[k], c.bar && Number.isFinite(c.bar[k]) ? c.bar[k] : 0);
  for (const p of points) for (let k = 0; k < p.x.length; ++k) take(p.x[k], p.y[k]);
  return low <= high ? padded(low, high, fromZero) : [0, 1];
}

/** Pieces of a curve between rows without a number or before another branch. */
export function pieces(curve, visit) {
  let piece = [];
  const end = () => { if (piece.length) visit(piece); piece = []; };
  for (let k = curve.first ?? 0; k < curve.x.length; ++k) {
    if (curve.breaks?.has(k)) end();
    if (Number.isFinite(curve.x[k]) && Number.isFinite(curve.y[k])) piece.push(k);
    else end();
  }
  end();
}

/**
 * graph: { x: [low, high], y: [low, high], xTitle, whole, curves: [{x, y, bar, breaks, first, colour, dash, width}],
 * points: [{x, y, colour, kind}], marks: [{from, to, kind}], settled: [text], colours: {axis, grid, ink, zero} }.
 */
export class Graph {
  constructor(width, height) { Object.assign(this, { width, height }); }

  layout(graph) {
    const yTicks = ticksOf(graph.y, Math.max(2, (this.height - 50) / 34));
    const longest = yTicks.reduce((most, v) => Math.max(most, tickText(v).length), 1);
    this.box = { left: 16 + 6.6 * longest, top: 8, right: this.width - 12, bottom: this.height - 38 };
    this.graph = graph;
    this.yTicks = yTicks;
  }

  toX(v) { const { left, right } = this.box, [a, b] = this.graph.x; return left + ((v - a) / (b - a)) * (right - left); }
  toY(v) { const { top, bottom } = this.box, [a, b] = this.graph.y; return bottom - ((v - a) / (b - a)) * (bottom - top); }
  xAt(pixel) { const { left, right } = this.box, [a, b] = this.graph.x; return a + ((pixel - left) / (right - left)) * (b - a); }

  draw(pen, graph) {
    this.layout(graph);
    const { box } = this, { colours } = graph;
    const xTicks = ticksOf(graph.x, (box.right - box.left) / 58, graph.whole);
    for (const v of xTicks) pen.line([[this.toX(v), box.top], [this.toX(v), box.bottom]], { colour: colours.grid });
    for (const v of this.yTicks) pen.line([[box.left, this.toY(v)], [box.right, this.toY(v)]], { colour: v === 0 ? colours.zero : colours.grid });
    pen.within(box.left, box.top, box.right - box.left, box.bottom - box.top, () => {
      for (const m of graph.marks ?? []) this.mark(pen, m);
      for (const c of graph.curves) if (c.bar) this.band(pen, c);
      for (const c of graph.curves) this.curve(pen, c);
    });
    pen.within(box.left - 5, box.top - 5, box.right - box.left + 10, box.bottom - box.top + 10, () => {
      for (const p of graph.points ?? []) this.points(pen, p);
      if (graph.settled !== undefined && graph.settled >= graph.x[0] && graph.settled <= graph.x[1]) this.diamond(pen, this.toX(graph.settled), box.bottom, colours.axis);
    });
    for (const v of xTicks) pen.text(tickText(v), [this.toX(v), box.bottom + 5], { colour: colours.axis, base: "top", size: 11.5 });
    for (const v of this.yTicks) pen.text(tickText(v), [box.left - 6, this.toY(v)], { colour: colours.axis, align: "right", size: 11.5 });
    pen.text(graph.xTitle, [(box.left + box.right) / 2, this.height - 3], { colour: colours.axis, base: "alphabetic", size: 12 });
  }

  curve(pen, c) {
    pieces(c, (rows) => {
      const at = rows.map((k) => [this.toX(c.x[k]), this.toY(c.y[k])]);
      if (at.length === 1) pen.dot(at[0], 3, c);
      else pen.line(at, c);
    });
  }

  band(pen, c) {
    pieces({ ...c, y: c.y.map((v, k) => (Number.isFinite(c.bar[k]) ? v : NaN)) }, (rows) => {
      const over = rows.map((k) => [this.toX(c.x[k]), this.toY(c.y[k] + c.bar[k])]), under = rows.map((k) => [this.toX(c.x[k]), this.toY(c.y[k] - c.bar[k])]);
      pen.area([...over, ...under.reverse()], { colour: c.colour, opacity: 0.2 });
    });
  }

  points(pen, p) {
    pieces(p, (rows) => { if (rows.length > 1) pen.line(rows.map((k) => [this.toX(p.x[k]), this.toY(p.y[k])]), { colour: p.colour, width: 1, dash: [1.5, 2.5] }); });
    for (let k = 0; k < p.x.length; ++k) if (Number.isFinite(p.x[k]) && Number.isFinite(p.y[k])) pen.dot([this.toX(p.x[k]), this.toY(p.y[k])], 3, { colour: p.colour, open: true });
  }

  mark(pen, { from, to, kind }) {
    const { top, bottom } = this.box, a = this.toX(from), b = this.toX(to), { colours } = this.graph;
    if (!Number.isFinite(a)) return;
    if (kind === "window") {
      const low = Math.min(a, b), high = Math.max(a, b, low + 2);
      pen.area([[low, top], [high, top], [high, bottom], [low, bottom]], { colour: "#cc79a7", opacity: 0.27 });
      return;
    }
    pen.line([[a, top], [a, bottom]], { colour: kind === "other" ? colours.event : colours.faint, opacity: 0.55, dash: kind === "lost" ? [2, 3] : kind === "gained" ? [6, 3] : [] });
  }

  /** Rows that settle before the curves begin are folded away behind this. */
  diamond(pen, x, y, colour) { pen.area([[x - 4.5, y], [x, y - 4.5], [x + 4.5, y], [x, y + 4.5]], { colour }); }
}

/** The range of an axis over curves; wide enough to be seen. */
export function span(arrays) {
  const r = range(...arrays) ?? [0, 1];
  return r[1] > r[0] ? r : [r[0] - 1, r[0] + 1];
}
