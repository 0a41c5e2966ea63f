// A surface seen flat, from its outward side: to scale, with what it carries in the pose that is shown and the way contacts take over
// it. One that is strongly curved (a condyle) is unrolled about the axis that it turns round.
import { Vector3 } from "three";
import { geometryOf } from "./bodies.js";
import { kAxes, matrixOf } from "./framing.js";
import { kGhosts, pathColour, pathGradient, pressureColour } from "./colours.js";
import { pressureLegend } from "./maps.js";
import { niceStep } from "./graph.js";
import { h, plain, short, signOf } from "./dom.js";
import { range } from "./data.js";
import { ink, isDark, onTheme } from "./theme.js";

const kMargin = { left: 46, right: 12, top: 10, bottom: 38 }, kUnrolled = 1.2, kRound = 0.25;  // rad: wider than this is unrolled; how far a section is off its circle, of the radius

/** Signed axes of the body: toward the viewer, up and to the right on paper. `pushes`: forces that press on the body, in its frame. */
function paperAxes(pushes) {
  const sum = new Vector3();
  for (const f of pushes) sum.sub(f);
  const size = sum.toArray().map(Math.abs), axis = size.indexOf(Math.max(...size)), sign = Math.sign(sum.getComponent(axis)) || 1;
  const n = kAxes[axis].clone().multiplyScalar(sign), up = kAxes[[2, 0, 1][axis]].clone(), right = up.clone().cross(n);
  return { n, up, right };
}

/** Forces of all contacts on a body, in its frame. */
function pushesOn(run, body) {
  const out = [];
  for (const c of run.contacts)
    for (let k = 0; k < run.rows; ++k) {
      if (!(run.contactForce(c, k) > 0) || (c.body_a !== body && c.body_b !== body)) continue;
      const f = new Vector3().fromArray(c.force, 3 * k);
      if (c.body_b === body) out.push(f);
      else out.push(f.negate().transformDirection(matrixOf(run, k, c.body_b)).transformDirection(matrixOf(run, k, body).invert()).multiplyScalar(run.contactForce(c, k)));
    }
  return out;
}

const nameOf = (v) => { const i = v.toArray().findIndex((c) => c !== 0); return { name: "xyz"[i], sign: v.getComponent(i), index: i }; };

/** The circle nearest to points of a plane (Kasa): [x, y, radius]; null where there is none. */
function circle(points) {
  let [sx, sy, xx, yy, xy, xz, yz, sz] = [0, 0, 0, 0, 0, 0, 0, 0];
  const n = points.length, mx = points.reduce((s, p) => s + p[0], 0) / n, my = points.reduce((s, p) => s + p[1], 0) / n;
  for (const [px, py] of points) { const x = px - mx, y = py - my, z = x * x + y * y; sx += x; sy += y; xx += x * x; yy += y * y; xy += x * y; xz += x * z; yz += y * z; sz += z; }
  const det = xx * yy - xy * xy;
  if (!(Math.abs(det) > 1e-9 * xx * yy)) return null;
  const a = (xz * yy - yz * xy) / (2 * det), b = (yz * xx - xz * xy) / (2 * det);
  return [a + mx, b + my, Math.sqrt(a * a + b * b + sz / n)];
}

/** Where each site of a map lies in the frame of the file's body. */
function placesOf(run, map, geometry) {
  const centre = new Vector3(...run.bodies[map.body].centre), out = [];
  if (map.mesh < 0) {
    for (let i = 0; i < map.places.length; i += 3) out.push([new Vector3().fromArray(map.places, i).add(centre)]);
    return out;
  }
  const p = geometry.attributes.position.array, index = geometry.index.array;
  for (const t of map.triangles) out.push([0, 1, 2].map((k) => new Vector3().fromArray(p, 3 * index[3 * t + k]).add(centre)));
  return out;
}

export class Plan {
  constructor(runs, body, player, axis, shown) {
    const run = runs[0];
    Object.assign(this, { run, body, player, axis, shown });
    this.contacts = run.contacts.filter((c) => c.body_b === body);
    this.maps = run.pressures.filter((m) => m.body === body);
    this.most = run.pressures.reduce((most, m) => Math.max(most, m.most), 0);
    this.axes = paperAxes(pushesOn(run, body));
    const names = new Set([...this.contacts.map((c) => c.surface), ...this.maps.map((m) => m.surface)]);
    const raws = run.raw.meshes.filter((m) => m.body === body && names.has(m.name)), geometries = raws.map(geometryOf);
    this.sites = this.maps.map((m) => placesOf(run, m, m.mesh >= 0 ? geometries[raws.findIndex((r) => r.name === m.surface)] : null));
    this.unrolled = this.contacts.length === 0 ? this.roll() : null;
    const centre = new Vector3(...run.bodies[body].centre);  // what the file calls the origin
    this.project = (x, y, z) => this.onPaper(new Vector3(x, y, z).add(centre));
    this.flatSites = this.sites.map((all) => all.map((corners) => corners.map((p) => this.onPaper(p))));
    this.tracks = this.contacts.map((c) => this.track(run, c, this.project));
    this.others = runs.slice(1).map((r) => this.tracksOf(r));
    this.triangles = geometries.map((g) => this.flat(g));
    geometries.forEach((g) => g.dispose());
    this.canvas = h("canvas", { role: "img", "aria-label": `${run.bodies[body].name} seen flat: pressure and contact path` });
    this.readout = h("div.chips", {});
    const from = axis.number(axis.settling(run)), to = axis.number(run.rows - 1), { unit } = axis.words(), bone = plain(run.bodies[body].name);
    this.path = this.tracks.some((t) => t.length > 1) ? h("span.scale", {}, `path: ${axis.words().name} ${from} `, h("i.bar", { "aria-hidden": "true" }), ` ${to} ${unit}`) : null;
    const what = this.maps.length > 0 ? `Pressure on the ${bone}${this.unrolled ? ", unrolled" : ""}` : `Contact path on the ${bone}`;
    this.element = h("figure.panel.path", {}, h("figcaption", {}, what), h("div.plot", {}, this.canvas),
      h("div.chips", {}, this.maps.length > 0 ? pressureLegend(this.most) : null, this.path), this.readout);
    player.onChange((row) => this.show(row));
    shown.onChange(() => this.show(player.row));
    onTheme(() => this.resize());
  }

  /** The axis and circle about which the sites are unrolled; null where they are flat enough. */
  roll() {
    const all = this.sites.flat(2), { n, up, right } = this.axes;
    if (all.length < 20) return null;
    let best = null;
    for (const [along, across] of [[right, up], [up, right]]) {
      const section = all.map((p) => [p.dot(across), p.dot(n)]), fit = circle(section);
      if (!fit) continue;
      const off = Math.sqrt(section.reduce((sum, [x, y]) => sum + (Math.hypot(x - fit[0], y - fit[1]) - fit[2]) ** 2, 0) / section.length) / fit[2];
      const angles = all.map((p) => Math.atan2(p.dot(across) - fit[0], p.dot(n) - fit[1])), [low, high] = range(angles);
      if (!best || off < best.off) best = { along, across, fit, off, turn: high - low };
    }
    return best && best.off < kRound && best.turn > kUnrolled && best.turn < 6 ? best : null;
  }

  /** A point of the body on paper, mm. */
  onPaper(p) {
    const { unrolled: u, axes } = this;
    if (!u) return [p.dot(axes.right), p.dot(axes.up)];
    const arc = u.fit[2] * Math.atan2(p.dot(u.across) - u.fit[0], p.dot(axes.n) - u.fit[1]);
    return u.along === axes.right ? [p.dot(axes.right), arc] : [arc, p.dot(axes.up)];
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
    const centre = new Vector3(...run.bodies[body].centre), project = (x, y, z) => this.onPaper(new Vector3(x, y, z).add(centre));
    return run.contacts.filter((c) => c.body_b === body).map((c) => this.track(run, c, project));
  }

  /** The corners of a mesh on paper: those whose outward side is seen; of what is unrolled those that do not wrap over its seam. */
  flat(geometry) {
    const p = geometry.attributes.position, index = geometry.index.array, at = [], seam = this.unrolled ? 2 * this.unrolled.fit[2] : Infinity;
    for (let i = 0; i < p.count; ++i) at.push(this.project(p.getX(i), p.getY(i), p.getZ(i)));
    const seen = [];
    for (let i = 0; i + 2 < index.length; i += 3) {
      const [a, b, c] = [at[index[i]], at[index[i + 1]], at[index[i + 2]]];
      if ([0, 1].some((k) => Math.max(a[k], b[k], c[k]) - Math.min(a[k], b[k], c[k]) > seam)) continue;
      if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) seen.push([a, b, c]);
    }
    return seen;
  }

  limits() {
    const points = [...[...this.tracks, ...this.others.flat()].flatMap((t) => t.map((q) => q.at)), ...this.flatSites.flat(2)], seen = this.triangles.flat(2);
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
    const inner = width - kMargin.left - kMargin.right, tallest = 250;
    this.scale = Math.min(inner / (x1 - x0), tallest / (y1 - y0));
    this.box = { left: kMargin.left + (inner - this.scale * (x1 - x0)) / 2, top: kMargin.top, width: this.scale * (x1 - x0), height: this.scale * (y1 - y0), x0, y1, x1, y0 };
    const height = this.box.height + kMargin.top + kMargin.bottom, ratio = Math.max(devicePixelRatio, 1);
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height}px` });
    this.ratio = ratio;
    if (this.path) this.path.querySelector("i").style.background = pathGradient(isDark());
    this.back = this.over = null;
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
    g.fillStyle = g.strokeStyle = ink("bone"); g.lineWidth = 0.7;
    g.beginPath();
    for (const t of this.triangles.flat()) { t.forEach((p, i) => (i ? g.lineTo(...this.at(p)) : g.moveTo(...this.at(p)))); g.closePath(); }
    g.fill(); g.stroke();
    this.grid(g);
    g.restore();
    g.strokeStyle = ink("zero"); g.lineWidth = 1; g.strokeRect(box.left, box.top, box.width, box.height);
    this.names(g);
    return canvas;
  }

  /** The ways of all contacts, as a picture of their own: it lies over the pressure. */
  ways() {
    const canvas = document.createElement("canvas"), { box } = this;
    Object.assign(canvas, { width: this.canvas.width, height: this.canvas.height });
    const g = canvas.getContext("2d");
    g.scale(this.ratio, this.ratio);
    g.beginPath(); g.rect(box.left - 3, box.top - 3, box.width + 6, box.height + 6); g.clip();
    this.others.forEach((tracks, i) => tracks.forEach((t) => this.thin(g, t, kGhosts[i % kGhosts.length])));
    this.tracks.forEach((t, i) => { if (this.shown.has(`contact ${this.contacts[i].name}`)) this.line(g, t); });
    return canvas;
  }

  /** What the surface carries in a row. */
  pressures(g, row) {
    const { box } = this;
    g.save();
    g.beginPath(); g.rect(box.left, box.top, box.width, box.height); g.clip();
    this.maps.forEach((map, m) => {
      if (!this.shown.hasPair(map.contact)) return;
      map.each(row, (site, pressure) => {
        const corners = this.flatSites[m][site];
        g.fillStyle = g.strokeStyle = pressureColour(pressure / this.most);
        g.beginPath();
        if (corners.length === 1) g.arc(...this.at(corners[0]), Math.max(1, 1.25 * map.radii[site] * this.scale), 0, 2 * Math.PI);
        else { corners.forEach((p, i) => (i ? g.lineTo(...this.at(p)) : g.moveTo(...this.at(p)))); g.closePath(); g.lineWidth = 0.6; g.stroke(); }
        g.fill();
      });
    });
    g.restore();
  }

  ticks(low, high, pixels) {
    const step = niceStep(high - low, Math.max(2, pixels / 42)), out = [];
    for (let v = Math.ceil(low / step) * step; v <= high + 1e-9; v += step) out.push(Math.abs(v) < 1e-9 ? 0 : +v.toPrecision(10));
    return out;
  }

  grid(g) {
    const { box } = this;
    g.strokeStyle = ink("paper"); g.lineWidth = 1;
    g.beginPath();
    for (const v of this.ticks(box.x0, box.x1, box.width)) { const [x] = this.at([v, 0]); g.moveTo(x, box.top); g.lineTo(x, box.top + box.height); }
    for (const v of this.ticks(box.y0, box.y1, box.height)) { const [, y] = this.at([0, v]); g.moveTo(box.left, y); g.lineTo(box.left + box.width, y); }
    g.stroke();
  }

  names(g) {
    const { box, axes } = this, right = nameOf(axes.right), up = nameOf(axes.up);
    g.font = "12px system-ui, sans-serif"; g.fillStyle = ink("axis"); g.textAlign = "center"; g.textBaseline = "top";
    for (const v of this.ticks(box.x0, box.x1, box.width)) g.fillText(signOf(String(right.sign * v || 0)), this.at([v, 0])[0], box.top + box.height + 5);
    g.fillText(`${this.unrolled && this.unrolled.along !== axes.right ? "arc" : right.name} [mm]`, box.left + box.width / 2, box.top + box.height + 21);
    g.textAlign = "right"; g.textBaseline = "middle";
    for (const v of this.ticks(box.y0, box.y1, box.height)) g.fillText(signOf(String(up.sign * v || 0)), box.left - 6, this.at([0, v])[1]);
    g.save(); g.translate(box.left - 38, box.top + box.height / 2); g.rotate(-Math.PI / 2); g.textAlign = "center";
    g.fillText(`${this.unrolled && this.unrolled.along === axes.right ? "arc" : up.name} [mm]`, 0, 0); g.restore();
  }

  line(g, track) {
    const last = Math.max(1, this.run.rows - 1);
    const grey = this.maps.length > 0, dark = isDark();
    g.lineWidth = grey ? 2 : 3; g.lineCap = "round";
    track.forEach((q, i) => {
      const before = track[i - 1], joined = before && before.row === q.row - 1 && Math.hypot(q.at[0] - before.at[0], q.at[1] - before.at[1]) < 2;
      g.strokeStyle = g.fillStyle = pathColour(q.row / last, dark);
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
    const hidden = [...this.shown.hidden].join();
    if (!this.over || this.overFor !== hidden) { this.over = this.ways(); this.overFor = hidden; }
    const g = this.canvas.getContext("2d");
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.clearRect(0, 0, this.canvas.width, this.canvas.height);
    g.drawImage(this.back, 0, 0);
    g.scale(this.ratio, this.ratio);
    this.pressures(g, row);
    g.save(); g.setTransform(1, 0, 0, 1, 0, 0); g.globalAlpha = this.maps.length > 0 ? 0.8 : 1; g.drawImage(this.over, 0, 0); g.restore();
    const most = Math.max(...this.contacts.map((c) => this.run.contactForce(c, row)), 1e-9), words = [];
    this.contacts.forEach((c, i) => {
      const here = this.tracks[i].find((q) => q.row === row);
      if (!here || !this.shown.has(`contact ${c.name}`)) return;
      const force = this.run.contactForce(c, row), [x, y] = this.at(here.at), radius = 4 + 5 * Math.sqrt(force / most);
      g.beginPath(); g.arc(x, y, radius, 0, 2 * Math.PI);
      g.lineWidth = 4; g.strokeStyle = ink("paper"); g.stroke();
      g.lineWidth = 2; g.strokeStyle = ink("arrow"); g.stroke();
      words.push(h("span.chip", {}, `${plain(c.name)} `, h("b", {}, `${short(force, 3)} N`)));
    });
    this.maps.forEach((map) => {
      let peak = 0;
      map.each(row, (_, pressure) => { peak = Math.max(peak, pressure); });
      const kept = map.keptRow(row);
      words.push(h("span.chip", {}, this.maps.length > 1 ? `${plain(map.contact)} peak ` : "peak ", h("b", {}, `${short(peak, 3)} MPa`), kept === row ? "" : ` (of pose ${this.run.numberOf(kept)})`));
    });
    this.readout.replaceChildren(...words);
  }
}

/** One for each body that contacts press on or whose surface casts: the plateau first, other bones after it, menisci last. */
export const plans = (runs, player, axis, shown) => {
  const [run] = runs, bodies = [...new Set([...run.contacts.map((c) => c.body_b), ...run.pressures.map((m) => m.body)])];
  const knee = run.raw.joints.find((j) => j.tibia), small = (body) => /menisc/i.test(run.bodies[body].name);
  const rank = (body) => (body === knee?.tibia.body ? 0 : small(body) ? 2 : 1);
  return bodies.sort((a, b) => rank(a) - rank(b)).map((body) => new Plan(runs, body, player, axis, shown)).filter((p) => p.maps.length > 0 || p.tracks.some((t) => t.length > 0));
};
