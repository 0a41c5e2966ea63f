// How far the curves of two results lie apart.
import { range, twinSeries } from "./data.js";

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

/** x in ascending order, and y with it. */
function ascending(x, y) {
  const order = [...x.keys()].filter((k) => Number.isFinite(x[k])).sort((a, b) => x[a] - x[b] || a - b);
  return [order.map((k) => x[k]), order.map((k) => y[k])];
}

/** Of each curve that both have over the same axis: at the first run's points. [] where the axes differ. */
export function differences(run, other) {
  if (run.chart.x_title !== other.chart.x_title) return [];
  const out = [];
  for (const panel of run.chart.panels)
    for (const s of panel.series) {
      const twin = twinSeries(other, panel, s.name);
      if (!twin) continue;
      const [x, y] = ascending(other.chart.x, twin.y);
      let largest = -1, at = NaN, squares = 0, count = 0;
      run.chart.x.forEach((place, k) => {
        // A value of single precision may lie a rounding outside of the other's.
        const inside = x.length > 0 ? Math.min(Math.max(place, x[0]), x[x.length - 1]) : NaN;
        const d = Math.abs(inside - place) <= 1e-6 * Math.max(1, Math.abs(place)) ? Math.abs(between(x, y, inside) - s.y[k]) : NaN;
        if (!Number.isFinite(d)) return;
        squares += d * d;
        ++count;
        if (d > largest) { largest = d; at = place; }
      });
      const reach = range(s.y);
      if (count > 0) out.push({ panel: panel.title, name: s.name, largest, at, rms: Math.sqrt(squares / count), range: reach[1] - reach[0] });
    }
  return out;
}
