// How far the curves of two results lie apart, over the axis that is chosen.
import { range, twinSeries } from "./data.js";
import { pretty } from "./dom.js";

/** y at a place between the points of an ascending x; NaN outside of them or beside a missing one. */
export function between(x, y, at) {
  let low = 0, high = x.length - 1;
  if (!(high >= 0) || !(at >= x[low]) || !(at <= x[high])) return NaN;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= at) low = middle;
    else high = middle;
  }
  if (at === x[low]) return y[low];
  if (at === x[high]) return y[high];
  return y[low] + ((at - x[low]) / (x[high] - x[low])) * (y[high] - y[low]);
}

/** Values of single precision that are equal but for roundings. */
const same = (a, b) => Math.abs(a - b) <= 1e-6 * Math.max(1, Math.abs(a));

/** Whether two runs have the same value of the axis in each row that both have solved. */
function inStep(a, b) {
  return a.length === b.length && a.every((v, k) => same(v, b[k]) || !Number.isFinite(v) || !Number.isFinite(b[k]));
}

/** The rows from `first` on, cut where the axis turns or stands still: { way: 1, -1 or 0, rows }. Neighbours share a row. */
export function stretches(x, first) {
  const out = [];
  let last = -1;
  for (let k = first; k < x.length; ++k) {
    if (!Number.isFinite(x[k])) continue;
    const way = last < 0 ? NaN : same(x[last], x[k]) ? 0 : Math.sign(x[k] - x[last]);
    if (last >= 0 && out.length > 0 && out[out.length - 1].way === way) out[out.length - 1].rows.push(k);
    else if (last >= 0) out.push({ way, rows: [last, k] });
    last = k;
  }
  return out.length > 0 || last < 0 ? out : [{ way: 0, rows: [last] }];
}

/** Calls visit(row, value) with the other's y at the first's rows of a stretch that both have. */
function along(mine, x, theirs, otherX, y, visit) {
  if (mine.way === 0 || theirs.way === 0) {  // the axis does not tell these rows apart
    if (mine.rows.length === theirs.rows.length) mine.rows.forEach((k, i) => visit(k, y[theirs.rows[i]]));
    return;
  }
  const rows = theirs.way > 0 ? theirs.rows : [...theirs.rows].reverse(), places = rows.map((k) => otherX[k]), values = rows.map((k) => y[k]);
  for (const k of mine.rows) {
    // A value of single precision may lie a rounding outside of the other's.
    const inside = Math.min(Math.max(x[k], places[0]), places[places.length - 1]);
    if (same(x[k], inside)) visit(k, between(places, values, inside));
  }
}

/**
 * The other's curve less the first's, at the first's rows; NaN where the other has no value. Row by row where their axes
 * agree; else on each way that the axis takes, as far as both take the same ones.
 */
export function differenceOf(run, own, other, y, axis) {
  const x = axis.values(run), otherX = axis.values(other), out = new Float64Array(x.length).fill(NaN), first = axis.settling(run);
  if (inStep(x, otherX)) {
    for (let k = first; k < x.length; ++k) out[k] = Number.isFinite(x[k]) ? y[k] - own[k] : NaN;
    return out;
  }
  const mine = stretches(x, first), theirs = stretches(otherX, axis.settling(other)), single = mine.length === 1 && theirs.length === 1;
  for (let i = 0; i < Math.min(mine.length, theirs.length) && (single || mine[i].way === theirs[i].way); ++i)
    along(mine[i], x, theirs[i], otherX, y, (k, value) => { out[k] = value - own[k]; });
  return out;
}

/** Of each curve that both have, but for the axis itself: largest difference, with its sign, and where it is. */
export function differences(run, other, axis) {
  const out = [], at = axis.values(run);
  for (const panel of run.chart.panels)
    for (const s of panel.series) {
      const twin = twinSeries(other, panel, s.name);
      if (!twin) continue;
      const d = differenceOf(run, s.y, other, twin.y, axis);
      let best = -1, squares = 0, count = 0;
      d.forEach((v, k) => {
        if (!Number.isFinite(v)) return;
        squares += v * v;
        ++count;
        if (best < 0 || Math.abs(v) > Math.abs(d[best])) best = k;
      });
      if (count === 0) continue;
      const reach = range(s.y);
      out.push({ panel: panel.title, name: s.name, unit: /\[(.*)\]/.exec(pretty(panel.title))?.[1] ?? "", largest: d[best], at: at[best], row: best, rms: Math.sqrt(squares / count), range: reach[1] - reach[0] });
    }
  return out;
}
