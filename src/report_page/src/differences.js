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

/** x in ascending order, and y with it; of rows with the same x the last. */
function ascending(x, y, first) {
  const order = [...x.keys()].filter((k) => k >= first && Number.isFinite(x[k])).sort((a, b) => x[a] - x[b] || a - b);
  const kept = order.filter((k, i) => i + 1 === order.length || x[order[i + 1]] !== x[k]);
  return [kept.map((k) => x[k]), kept.map((k) => y[k])];
}

/** The other's curve less the first's, at the first's rows; NaN where the other has no value. */
export function differenceOf(run, own, other, y, axis) {
  const at = axis.values(run), settled = axis.settling(run);
  const [x, values] = ascending(axis.values(other), y, axis.settling(other));
  return Float64Array.from(at, (place, k) => {
    if (k < settled || x.length === 0) return NaN;
    // A value of single precision may lie a rounding outside of the other's.
    const inside = Math.min(Math.max(place, x[0]), x[x.length - 1]);
    return Math.abs(inside - place) <= 1e-6 * Math.max(1, Math.abs(place)) ? between(x, values, inside) - own[k] : NaN;
  });
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
