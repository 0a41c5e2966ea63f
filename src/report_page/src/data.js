// What genu wrote into the page (src/genu/results/report_data.cpp), as arrays.

export function readJson(id) {
  return JSON.parse(document.getElementById(id).textContent);
}

export function bytes(text) {
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < out.length; ++i) out[i] = binary.charCodeAt(i);
  return out.buffer;
}

export const floats = (text) => new Float32Array(bytes(text));

/** Where the casting surface of a layer carries load. `sites`: triangles of a mesh, or places (mm) with radii (mm). */
export class PressureMap {
  constructor(raw) {
    Object.assign(this, { contact: raw.contact, surface: raw.surface, body: raw.body, most: raw.most_MPa, every: raw.every, mesh: raw.mesh ?? -1 });
    this.starts = new Uint32Array(bytes(raw.starts));
    this.parts = new Uint16Array(bytes(raw.parts));
    this.sites = raw.sites16 !== undefined ? new Uint16Array(bytes(raw.sites16)) : new Uint32Array(bytes(raw.sites32));
    if (this.mesh >= 0) this.triangles = new Uint32Array(bytes(raw.triangles));
    else {
      const steps = new Uint16Array(bytes(raw.points));
      this.places = Float32Array.from(steps, (s, i) => raw.low[i % 3] + raw.step * s);
      this.radii = floats(raw.radii);
    }
  }

  /** The row itself, or the nearest that was kept before it. */
  keptRow(row) { return row - (row % this.every); }

  /** Calls visit(site, MPa) for each site that carries load in a row. */
  each(row, visit) {
    const kept = this.keptRow(row);
    for (let i = this.starts[kept] ?? 0; i < (this.starts[kept + 1] ?? 0); ++i) visit(this.sites[i], (this.parts[i] / 65535) * this.most);
  }

  count(row) { const kept = this.keptRow(row); return (this.starts[kept + 1] ?? 0) - (this.starts[kept] ?? 0); }
}

/** One result of the page. Lengths in mm; `row` counts from 0. */
export class Run {
  constructor(raw, times) {
    Object.assign(this, { raw, times, rows: raw.rows, every: raw.every ?? 1, motion: raw.motion, summary: raw.summary, bodies: raw.bodies });
    this.name = raw.name ?? raw.summary.title;
    this.poses = floats(raw.poses);
    this.reference = floats(raw.reference);
    this.columns = new Map();
    for (const c of raw.table)
      this.columns.set(c.name, c.numbers !== undefined ? { numbers: floats(c.numbers) }
        : { words: c.words, places: new Uint16Array(bytes(c.places)) });
    this.contacts = raw.contacts.map((c) => ({ ...c, point: floats(c.point), force: floats(c.force) }));
    this.pressures = (raw.pressures ?? []).map((p) => new PressureMap(p));
    this.coordinates = raw.coordinates ?? [];
    this.main = raw.main_coordinate || "";
    this.beside = (raw.beside ?? []).map((t) => ({ name: t.name, columns: new Map(t.columns.map((c) => [c.column, { inFile: c.in_file, numbers: floats(c.numbers) }])) }));
    this.chart = {
      ...raw.chart,
      x: floats(raw.chart.x),
      panels: raw.chart.panels.map((p) => ({
        ...p, series: p.series.map((s) => ({ name: s.name, column: s.column ?? "", y: floats(s.y), bar: s.bar ? floats(s.bar) : null })) })),
    };
    this.breaks = new Set(this.chart.breaks);
  }

  has(column) { return this.columns.has(column); }
  numbers(column) { return this.columns.get(column)?.numbers ?? null; }

  /** NaN where the cell is empty or the column is none. */
  number(column, row) {
    const c = this.columns.get(column);
    return c && c.numbers ? c.numbers[row] : NaN;
  }

  /** Empty where the cell is. */
  word(column, row) {
    const c = this.columns.get(column);
    return (c && c.words && c.words[c.places[row]]) || "";
  }

  status(row) { return this.word("status", row); }

  /** The row of results.csv, from 1. */
  numberOf(row) { return this.every === 1 ? row + 1 : row === this.rows - 1 ? this.raw.rows_in_full : row * this.every + 1; }

  /** [qx qy qz qw x y z] of a body; null where the row has no pose. Row -1 is the reference pose. */
  pose(row, body) {
    if (row === -1) return this.reference.subarray(7 * body, 7 * body + 7);
    const at = 7 * (row * this.bodies.length + body);
    if (row >= this.rows || !(at + 7 <= this.poses.length) || Number.isNaN(this.poses[at])) return null;
    return this.poses.subarray(at, at + 7);
  }

  solved(row) { return this.bodies.length > 0 && this.pose(row, 0) !== null; }

  /** The nearest row that has a pose, this one or one before it, else after it; -1 where none has. */
  shown(row) {
    for (let k = row; k >= 0; --k) if (this.solved(k)) return k;
    for (let k = row + 1; k < this.rows; ++k) if (this.solved(k)) return k;
    return -1;
  }

  /** Force (N) of a contact in a row; 0 where it carries none. */
  contactForce(contact, row) {
    const f = contact.force.subarray(3 * row, 3 * row + 3);
    return f.length === 3 && Number.isFinite(f[0]) ? Math.hypot(f[0], f[1], f[2]) : 0;
  }

  /** Ligaments by bundle, in order: [name, indices]. */
  bundles() {
    const groups = new Map();
    this.raw.ligaments.forEach((l, i) => { const name = l.group ?? l.name; groups.has(name) ? groups.get(name).push(i) : groups.set(name, [i]); });
    return [...groups];
  }
}

/** The series of another run with the same panel and name, if any. */
export function twinSeries(other, panel, name) {
  return other.chart.panels.find((p) => p.title === panel.title)?.series.find((s) => s.name === name);
}

/** Smallest and largest of the numbers in arrays; null where there is none. */
export function range(...arrays) {
  let low = Infinity, high = -Infinity;
  for (const array of arrays)
    for (const v of array) {
      if (!Number.isFinite(v)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  return low <= high ? [low, high] : null;
}
