// The way contacts take over a surface, seen from its outward side: to scale, with the surface's outline behind.
import { Vector3 } from "three";
import { geometryOf } from "./bodies.js";
import { kAxes } from "./framing.js";
import { kGhosts, pathColour, pathGradient } from "./colours.js";
import { h, short, pretty } from "./dom.js";
import { range } from "./data.js";

const kMargin = { left: 46, right: 12, top: 10, bottom: 38 };

/** Signed axes of the body: toward the viewer, up and to the right on paper. */
function paperAxes(run, contacts) {
  const sum = new Vector3(), f = new Vector3();
  for (const c of contacts) for (let k = 0; k < run.rows; ++k) if (run.contactForce(c, k) > 0) sum.sub(f.fromArray(c.force, 3 * k));
  const size = sum.toArray().map(Math.abs), axis = size.indexOf(Math.max(...size)), sign = Math.sign(sum.getComponent(axis)) || 1;
  const n = kAxes[axis].clone().multiplyScalar(sign), up = kAxes[[2, 0, 1][axis]].clone(), right = up.clone().cross(n);
  return { n, up, right };
}

const nameOf = (v) => { const i = v.toArray().findIndex((c) => c !== 0); return { name: "xyz"[i], sign: v.getComponent(i), index: i }; };

function niceStep(span, wanted) {
  const raw = span / wanted, power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((f) => f * power).find((s) => s >= raw);
}

export class PathPlot {
  constructor(runs, body, player) {
    const run = runs[0];
    this.run = run;
    this.body = body;
    this.player = player;
    this.contacts = run.contacts.filter((c) => c.body_b === body);
    this.axes = paperAxes(run, this.contacts);
    const centre = new Vector3(...run.bodies[body].centre);  // what the file calls the origin
    this.project = (x, y, z) => { const p = new Vector3(x, y, z).add(centre); return [p.dot(this.axes.right), p.dot(this.axes.up)]; };
    const names = new Set(this.contacts.map((c) => c.surface));
    this.meshes = run.raw.meshes.filter((m) => m.body === body && names.has(m.name));
    this.tracks = this.contacts.map((c) => this.track(run, c, this.project));
    this.others = runs.slice(1).map((r) => this.tracksOf(r));
    this.triangles = this.meshes.map((m) => this.flat(m));
    this.canvas = h("canvas", { role: "img", "aria-label": `Contact path on ${run.bodies[body].name}, seen from above` });
    this.readout = h("div.chips", {});
    const [from, to] = [run.chart.x[0], run.chart.x[run.rows - 1]];
    this.element = h("figure.panel.path", {}, h("figcaption", {}, `Contact path on ${run.bodies[body].name}, from above [mm]`), h("div.plot", {}, this.canvas),
      h("div.chips", {}, h("span.scale", {}, pretty(run.chart.x_title), ` ${short(from, 3)} `, h("i.bar", { style: { background: pathGradient() }, "aria-hidden": "true" }), ` ${short(to, 3)}`)), this.readout);
    player.onChange((row) => this.show(row));
  }

  track(run, contact, project) {
    const out = [];
    for (let k = 0; k < run.rows; ++k) if (run.contactForce(contact, k) > 0) out.push({ row: k, at: project(...contact.point.subarray(3 * k, 3 * k + 3)) });
    return out;
  }

  /** Of another run, on the body of the same name. */
  tracksOf(run) {
    const body = run.bodies.findIndex((b) => b.name === this.run.bodies[this.body].name);
    if (body < 0) return [];
    const centre = new Vector3(...run.bodies[body].centre);
    const project = (x, y, z) => { const p = new Vector3(x, y, z).add(centre); return [p.dot(this.axes.right), p.dot(this.axes.up)]; };
    return run.contacts.filter((c) => c.body_b === body).map((c) => this.track(run, c, project));
  }

  /** The corners of a mesh on paper: those whose outward side is seen. */
  flat(raw) {
    const geometry = geometryOf(raw), p = geometry.attributes.position, index = geometry.index.array;
    const at = [];
    for (let i = 0; i < p.count; ++i) at.push(this.project(p.getX(i), p.getY(i), p.getZ(i)));
    geometry.dispose();
    const seen = [];
    for (let i = 0; i + 2 < index.length; i += 3) {
      const [a, b, c] = [at[index[i]], at[index[i + 1]], at[index[i + 2]]];
      if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) seen.push([a, b, c]);
    }
    return seen;
  }

  limits() {
    const points = [...this.tracks, ...this.others.flat()].flatMap((t) => t.map((q) => q.at)), seen = this.triangles.flat(2);
    const along = (i) => range(points.map((p) => p[i])) ?? [0, 1];
    const of = (i) => {
      const [low, high] = along(i), all = range(seen.map((p) => p[i])) ?? [low, high];
      const other = along(1 - i), most = 1.2 * Math.max(high - low, other[1] - other[0], 5);
      return [Math.max(all[0], low - most), Math.min(all[1], high + most)];  // an endless plane ends in the picture
    };
    const grow = ([low, high]) => { const pad = 0.04 * Math.max(high - low, 1); return [low - pad, high + pad]; };
    return [grow(of(0)), grow(of(1))];
  }

  resize() {
    const width = Math.max(160, this.canvas.parentElement.clientWidth), [[x0, x1], [y0, y1]] = this.limits();
    const inner = width - kMargin.left - kMargin.right, tallest = 330;
    this.scale = Math.min(inner / (x1 - x0), tallest / (y1 - y0));
    this.box = { left: kMargin.left + (inner - this.scale * (x1 - x0)) / 2, top: kMargin.top, width: this.scale * (x1 - x0), height: this.scale * (y1 - y0), x0, y1, x1, y0 };
    const height = this.box.height + kMargin.top + kMargin.bottom, ratio = Math.max(devicePixelRatio, 1);
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height}px` });
    this.ratio = ratio;
    this.back = null;
    this.show(this.player.row);
  }

  at([x, y]) { return [this.box.left + this.scale * (x - this.box.x0), this.box.top + this.scale * (this.box.y1 - y)]; }

  /** What does not change from row to row. */
  background() {
    const canvas = document.createElement("canvas");
    Object.assign(canvas, { width: this.canvas.width, height: this.canvas.height });
    const g = canvas.getContext("2d"), { box } = this;
    g.scale(this.ratio, this.ratio);
    g.save();
    g.beginPath(); g.rect(box.left, box.top, box.width, box.height); g.clip();
    g.fillStyle = g.strokeStyle = "#e6ebef"; g.lineWidth = 0.7;
    g.beginPath();
    for (const t of this.triangles.flat()) { t.forEach((p, i) => (i ? g.lineTo(...this.at(p)) : g.moveTo(...this.at(p)))); g.closePath(); }
    g.fill(); g.stroke();
    this.grid(g);
    g.restore();
    g.strokeStyle = "#b8c1c9"; g.lineWidth = 1; g.strokeRect(box.left, box.top, box.width, box.height);
    this.names(g);
    g.save();
    g.beginPath(); g.rect(box.left - 3, box.top - 3, box.width + 6, box.height + 6); g.clip();
    this.others.forEach((tracks, i) => tracks.forEach((t) => this.thin(g, t, kGhosts[i % kGhosts.length])));
    this.tracks.forEach((t) => this.line(g, t));
    g.restore();
    return canvas;
  }

  ticks(low, high, pixels) {
    const step = niceStep(high - low, Math.max(2, pixels / 42)), out = [];
    for (let v = Math.ceil(low / step) * step; v <= high + 1e-9; v += step) out.push(Math.abs(v) < 1e-9 ? 0 : +v.toPrecision(10));
    return out;
  }

  grid(g) {
    const { box } = this;
    g.strokeStyle = "#ffffff"; g.lineWidth = 1;
    g.beginPath();
    for (const v of this.ticks(box.x0, box.x1, box.width)) { const [x] = this.at([v, 0]); g.moveTo(x, box.top); g.lineTo(x, box.top + box.height); }
    for (const v of this.ticks(box.y0, box.y1, box.height)) { const [, y] = this.at([0, v]); g.moveTo(box.left, y); g.lineTo(box.left + box.width, y); }
    g.stroke();
  }

  names(g) {
    const { box, axes } = this, right = nameOf(axes.right), up = nameOf(axes.up);
    g.font = "12px system-ui, sans-serif"; g.fillStyle = "#3c4650"; g.textAlign = "center"; g.textBaseline = "top";
    for (const v of this.ticks(box.x0, box.x1, box.width)) g.fillText(String(right.sign * v || 0), this.at([v, 0])[0], box.top + box.height + 5);
    g.fillText(`${right.name} [mm]`, box.left + box.width / 2, box.top + box.height + 21);
    g.textAlign = "right"; g.textBaseline = "middle";
    for (const v of this.ticks(box.y0, box.y1, box.height)) g.fillText(String(up.sign * v || 0), box.left - 6, this.at([0, v])[1]);
    g.save(); g.translate(box.left - 38, box.top + box.height / 2); g.rotate(-Math.PI / 2); g.textAlign = "center";
    g.fillText(`${up.name} [mm]`, 0, 0); g.restore();
  }

  line(g, track) {
    const last = Math.max(1, this.run.rows - 1);
    g.lineWidth = 3; g.lineCap = "round";
    track.forEach((q, i) => {
      const before = track[i - 1], joined = before && before.row === q.row - 1 && Math.hypot(q.at[0] - before.at[0], q.at[1] - before.at[1]) < 2;
      g.strokeStyle = g.fillStyle = pathColour(q.row / last);
      g.beginPath();
      if (joined) { g.moveTo(...this.at(before.at)); g.lineTo(...this.at(q.at)); g.stroke(); return; }
      g.arc(...this.at(q.at), 1.8, 0, 2 * Math.PI); g.fill();
    });
  }

  /** The way of a run that is compared. */
  thin(g, track, colour) {
    g.fillStyle = colour;
    for (const q of track) { g.beginPath(); g.arc(...this.at(q.at), 1.3, 0, 2 * Math.PI); g.fill(); }
  }

  show(row) {
    if (!this.box) return;
    this.back ??= this.background();
    const g = this.canvas.getContext("2d");
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.clearRect(0, 0, this.canvas.width, this.canvas.height);
    g.drawImage(this.back, 0, 0);
    g.scale(this.ratio, this.ratio);
    const most = Math.max(...this.contacts.map((c) => this.run.contactForce(c, row)), 1e-9), words = [];
    this.contacts.forEach((c, i) => {
      const here = this.tracks[i].find((q) => q.row === row);
      if (!here) return;
      const force = this.run.contactForce(c, row), [x, y] = this.at(here.at), radius = 4 + 5 * Math.sqrt(force / most);
      g.beginPath(); g.arc(x, y, radius, 0, 2 * Math.PI);
      g.lineWidth = 4; g.strokeStyle = "#ffffff"; g.stroke();
      g.lineWidth = 2; g.strokeStyle = "#0b5d50"; g.stroke();
      words.push(h("span.chip", {}, `${c.name} `, h("b", {}, `${short(force, 3)} N`)));
    });
    this.readout.replaceChildren(...words);
  }
}

/** One for each body that contacts press on. */
export const pathPlots = (runs, player) =>
  [...new Set(runs[0].contacts.map((c) => c.body_b))].map((body) => new PathPlot(runs, body, player)).filter((p) => p.tracks.some((t) => t.length > 0));
