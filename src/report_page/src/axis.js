// What the curves are drawn over and the slider names: a coordinate, time or the row. One choice for all plots and runs.
import { range } from "./data.js";
import { beside, h, short } from "./dom.js";

const kUnits = { deg: "deg", mm: "mm", s: "s", N: "N", Nm: "N m", MPa: "MPa", mm2: "mm²", J: "J", Nmm: "N mm" };

/** The axis of a joint's translation by anatomical name: "anterior"; empty where the scene names no axes of the body that it is seen from. */
export function anatomical(run, column) {
  for (const joint of run.raw.joints) {
    const i = (joint.translations ?? []).findIndex((name) => column === `${joint.name}.${name}_mm`);
    if (i < 0) continue;
    for (const knee of run.raw.joints) {
      const bone = [knee.femur, knee.tibia].find((b) => b && b.body === joint.parent);
      if (!bone) continue;
      const [ax, ay, az] = bone.anterior, [px, py, pz] = bone.proximal, sign = knee.right ? 1 : -1;
      const lateral = [ay * pz - az * py, az * px - ax * pz, ax * py - ay * px].map((v) => sign * v);
      const named = [["anterior", "posterior", bone.anterior], ["proximal", "distal", bone.proximal], ["lateral", "medial", lateral]];
      for (const [there, back, v] of named) if (Math.abs(v[i]) > 0.9) return v[i] > 0 ? there : back;
    }
  }
  return "";
}

/** "knee.gs.external_rotation_deg" as { name: "external rotation (Grood and Suntay)", unit: "deg" }; the joint's name only where another has the same. */
export function quantity(column, run) {
  const [, stem, ending] = /^(.*)_([A-Za-z0-9]+)$/.exec(column) ?? [null, column, ""];
  const unit = kUnits[ending] ?? "", parts = (unit ? stem : column).split(".");
  const clinical = parts.includes("gs");
  let words = parts.filter((p) => p !== "gs");
  const own = run?.raw.joints.some((j) => j.name === words[0]), rest = column.slice(words[0].length);
  if (words.length > 1 && own && !run.raw.joints.some((j) => j.name !== words[0] && run.has(j.name + rest))) words = words.slice(1);
  const way = run ? anatomical(run, column) : "";
  return { name: words.join(" ").replaceAll("_", " ") + (clinical ? " (Grood and Suntay)" : way ? ` (${way})` : ""), unit };
}

export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

export class Axis {
  constructor(runs) {
    this.runs = runs;
    const [run] = runs;
    this.choices = [...run.coordinates.filter((c) => run.numbers(c)), "row"];
    this.column = this.choices.includes(run.main) ? run.main : run.motion && run.numbers("time_s") ? "time_s" : "row";
    this.listeners = [];
    this.known = new Map();
  }

  onChange(listener) { this.listeners.push(listener); }

  choose(column) {
    this.column = column;
    this.known.clear();
    this.most = undefined;
    for (const listener of this.listeners) listener();
  }

  words(column = this.column) {
    return column === "row" ? { name: "row of results.csv", unit: "" } : quantity(column, this.runs[0]);
  }

  title() { const { name, unit } = this.words(); return capital(name) + (unit ? ` [${unit}]` : ""); }

  /** "Flexion 36.0 deg"; empty where a row has none. */
  at(row) {
    const text = this.number(row);
    if (this.column === "row" || text === "–") return "";
    const { name, unit } = this.words();
    return `${capital(name)} ${text}${unit ? ` ${unit}` : ""}`;
  }

  /** "36.0" */
  number(row) {
    const x = this.values(this.runs[0]);
    this.most ??= (range(x) ?? [0]).reduce((most, v) => Math.max(most, Math.abs(v)), 0);
    return short(beside(x[row], this.most), 3);
  }

  /** Of each row of a run; NaN throughout where it has no such column. */
  values(run) {
    if (!this.known.has(run))
      this.known.set(run, this.column === "row" ? Float32Array.from({ length: run.rows }, (_, k) => run.numberOf(k)) : run.numbers(this.column) ?? new Float32Array(run.rows).fill(NaN));
    return this.known.get(run);
  }

  /** How many rows at the start only settle: the axis stands still there. They are folded away, behind a marker. */
  settling(run) {
    if (this.column === "row" || this.column === "time_s") return 0;
    const x = this.values(run);
    let last = 0;
    while (last + 1 < x.length && Math.abs(x[last + 1] - x[0]) <= 1e-5 * Math.max(1, Math.abs(x[0]))) ++last;
    return last + 1 < x.length ? last : 0;
  }

  /** The row of another run that stands for a row of the first: where the axis has the same value. */
  twin(row, other) {
    if (other.rows === 0) return -1;
    const v = this.values(this.runs[0])[row], x = this.values(other);
    if (this.column === "row" || !Number.isFinite(v)) return Math.min(row, other.rows - 1);
    return this.nearest(x, v, this.settling(other), Math.min(row, other.rows - 1));
  }

  /** The row whose x is nearest to a value; of equally near ones the one nearest to `from`. */
  nearest(x, value, first = 0, from = 0) {
    let best = -1, distance = Infinity;
    for (let k = first; k < x.length; ++k) {
      const d = Math.abs(x[k] - value);
      if (d < distance || (d === distance && Math.abs(k - from) < Math.abs(best - from))) { distance = d; best = k; }
    }
    return best < 0 ? Math.min(from, x.length - 1) : best;
  }

  /** Where a value of the axis that genu drew its marks over lies on this one; NaN where nowhere. */
  place(run, value) {
    const from = run.chart.x, to = this.values(run);
    if (from.length === 0) return NaN;
    for (let k = 0; k + 1 < from.length; ++k) {
      const a = from[k], b = from[k + 1];
      if (a === b || !((a <= value && value <= b) || (b <= value && value <= a))) continue;
      return to[k] + ((value - a) / (b - a)) * (to[k + 1] - to[k]);
    }
    const ends = [0, from.length - 1], near = ends.find((k) => Math.abs(from[k] - value) < 1 + 1e-6 * Math.abs(value));
    return near === undefined ? NaN : to[near];
  }

  menu() {
    const select = h("select", { "aria-label": "Axis of the curves", title: "Axis of the curves", onchange: () => this.choose(select.value) },
      this.choices.map((c) => h("option", { value: c, selected: c === this.column }, `over ${this.words(c).name}`)));
    return select;
  }
}
