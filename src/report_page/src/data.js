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

/** One result of the page. Lengths in mm; `row` counts from 0. */
export class Run {
  constructor(raw, times) {
    Object.assign(this, { raw, times, rows: raw.rows, motion: raw.motion, summary: raw.summary, bodies: raw.bodies });
    this.name = raw.name ?? raw.summary.title;
    this.poses = floats(raw.poses);
    this.reference = floats(raw.reference);
    this.columns = new Map();
    for (const c of raw.table)
      this.columns.set(c.name, c.numbers !== undefined ? { numbers: floats(c.numbers) }
        : { words: c.words, places: new Uint16Array(bytes(c.places)) });
    this.contacts = raw.contacts.map((c) => ({ ...c, point: floats(c.point), force: floats(c.force) }));
    this.chart = {
      ...raw.chart,
      x: floats(raw.chart.x),
      panels: raw.chart.panels.map((p) => ({
        ...p, series: p.series.map((s) => ({ name: s.name, y: floats(s.y), bar: s.bar ? floats(s.bar) : null })) })),
    };
  }

  has(column) { return this.columns.has(column); }

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
}

/** The row of another run that stands for a row of this one: where its axis has the same value, if it is the same axis. */
export function twinRow(run, row, other) {
  if (other.rows === 0) return -1;
  const x = run.chart.x[row];
  if (run.chart.x_title !== other.chart.x_title || !Number.isFinite(x)) return Math.min(row, other.rows - 1);
  let best = 0, distance = Infinity;
  other.chart.x.forEach((v, k) => { if (Math.abs(v - x) < distance) { distance = Math.abs(v - x); best = k; } });
  return best;
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
