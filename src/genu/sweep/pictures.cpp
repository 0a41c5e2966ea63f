#include "genu/sweep/pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/svg_axes.h"
#include "genu/results/svg_text.h"
#include "genu/sweep/chart_parts.h"
#include "genu/sweep/statistics.h"
#include "genu/sweep/sweep_def.h"

namespace genu {
namespace {

/// Percentiles of one column over the main coordinate.
struct Bands {
  std::vector<double> x;
  std::array<std::vector<double>, 5> y;  ///< 5, 25, 50, 75, 95 %
};

Bands bands_of(const SweepTable& sweep, const SweepTables& tables, std::size_t c, const std::string& column) {
  constexpr std::array kPercentiles = {"p5", "p25", "p50", "p75", "p95"};
  std::vector<std::pair<double, std::size_t>> rows;
  for (std::size_t k = 0; k < sweep.record.kept.size(); ++k)
    if (sweep.record.kept[k].at_value && sweep.record.kept[k].column == column)
      rows.emplace_back(sweep.record.kept[k].value, k);
  std::sort(rows.begin(), rows.end());
  Bands bands;
  for (const auto& [value, k] : rows) {
    const std::size_t row = SweepTables::statistics_row(sweep, c, k);
    if (!std::isfinite(tables.statistics.number(row, "p50"))) continue;
    bands.x.push_back(value);
    for (std::size_t i = 0; i < kPercentiles.size(); ++i)
      bands.y[i].push_back(tables.statistics.number(row, kPercentiles[i]));
  }
  return bands;
}

std::string points(const SvgAxis& x, const SvgAxis& y, const std::vector<double>& xs, const std::vector<double>& ys,
                   bool backwards = false) {
  std::string out;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const std::size_t k = backwards ? xs.size() - 1 - i : i;
    out += fmt::format("{}{:.1f} {:.1f}", i == 0 && !backwards ? "M" : "L", x(xs[k]), y(ys[k]));
  }
  return out;
}

std::string area(const SvgAxis& x, const SvgAxis& y, const Bands& b, std::size_t low, std::size_t high,
                 const char* colour, double opacity) {
  return fmt::format("<path style=\"fill:{};fill-opacity:{}\" d=\"{}{}Z\"/>\n", colour, opacity,
                     points(x, y, b.x, b.y[low]), points(x, y, b.x, b.y[high], true));
}

struct Bar {
  std::string name;
  double low = 0, high = 0;      ///< the bar's ends
  double thin_high = kNoNumber;  ///< a thinner bar from `low`
  double size() const {
    return std::max(std::abs(high - low), std::isfinite(thin_high) ? std::abs(thin_high - low) : 0);
  }
};

std::vector<Bar> rank_bars(const SweepTable& sweep, const SweepTables& tables, std::size_t c, std::size_t kept) {
  std::vector<Bar> bars;
  for (std::size_t f = 0; f < sweep.record.factors.size(); ++f)
    if (!sweep.record.is_mesh_error(f))
      bars.push_back({sweep.record.factors[f], 0,
                      tables.ranks.number(SweepTables::factor_row(sweep, c, kept, f), "rank_correlation")});
  return bars;
}

std::vector<Bar> index_bars(const SweepTable& sweep, const SweepTables& tables, std::size_t c, std::size_t kept) {
  std::vector<Bar> bars;
  for (std::size_t f = 0; f < sweep.record.factors.size(); ++f) {
    const std::size_t row = SweepTables::factor_row(sweep, c, kept, f);
    bars.push_back(
        {sweep.record.factors[f], 0, tables.indices.number(row, "first"), tables.indices.number(row, "total")});
  }
  return bars;
}

/// From the least to the largest value while one factor changes.
std::vector<Bar> range_bars(const SweepTable& sweep, const std::vector<double>& values) {
  std::vector<Bar> bars;
  for (std::size_t f = 0; f < sweep.record.factors.size(); ++f) {
    Bar bar{sweep.record.factors[f], values.front(), values.front()};
    for (std::size_t s = 1; s < values.size(); ++s) {
      if (sweep.draws[f][s] == sweep.draws[f].front() || !std::isfinite(values[s])) continue;
      bar.low = std::min(bar.low, values[s]);
      bar.high = std::max(bar.high, values[s]);
    }
    bars.push_back(bar);
  }
  return bars;
}

}  // namespace

std::vector<std::string> columns_with_bands(const SweepTable& sweep) {
  constexpr int kFewestForBands = 3;
  std::vector<std::pair<std::string, int>> counts;
  for (const auto& k : sweep.record.kept) {
    if (!k.at_value) continue;
    const auto found = std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == k.column; });
    found == counts.end() ? void(counts.emplace_back(k.column, 1)) : void(++found->second);
  }
  std::vector<std::string> columns;
  for (const auto& [column, count] : counts)
    if (count >= kFewestForBands) columns.push_back(column);
  return columns;
}

std::string bands_picture(const SweepTable& sweep, const SweepTables& tables, const std::string& scene,
                          const std::string& column) {
  const std::vector<std::size_t> cases = cases_of(sweep, scene);
  std::vector<Bands> all;
  double low = kNoNumber, high = kNoNumber, first = kNoNumber, last = kNoNumber;
  for (const std::size_t c : cases) {
    all.push_back(bands_of(sweep, tables, c, column));
    for (const double v : all.back().y.front()) low = std::fmin(low, v);
    for (const double v : all.back().y.back()) high = std::fmax(high, v);
    for (const double v : all.back().x) first = std::fmin(first, v), last = std::fmax(last, v);
  }
  if (!(last > first)) return {};
  const SvgAxis x = linear_axis_within(first, last, 8, {kLeftEdge, kRightEdge}),
                y = linear_axis(low, high, 6, {kBottomEdge, kTopEdge});
  std::string out = chart_opening(column + ": median, 25 to 75 % and 5 to 95 % of the samples") +
                    chart_legend(sweep, cases) + draw_axes(x, y, sweep.record.main);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (all[k].x.empty()) continue;
    out += area(x, y, all[k], 0, 4, case_colour(k), 0.15) + area(x, y, all[k], 1, 3, case_colour(k), 0.25);
    out += fmt::format("<path class=\"line\" style=\"stroke:{}\" d=\"{}\"/>\n", case_colour(k),
                       points(x, y, all[k].x, all[k].y[2]));
  }
  return out + "</svg>\n";
}

std::vector<std::size_t> pictured_numbers(const SweepTable& sweep, const SweepTables& tables) {
  const std::vector<std::string> bands = columns_with_bands(sweep);
  std::vector<std::size_t> numbers;
  for (const std::string& column : bands) {
    std::size_t best = sweep.record.kept.size();
    double spread = -1;
    for (std::size_t k = 0; k < sweep.record.kept.size(); ++k) {
      if (sweep.record.kept[k].column != column || !sweep.record.kept[k].at_value) continue;
      const double sd = tables.statistics.number(SweepTables::statistics_row(sweep, 0, k), "sd");
      if (sd > spread) spread = sd, best = k;
    }
    if (best < sweep.record.kept.size()) numbers.push_back(best);
  }
  for (std::size_t k = 0; k < sweep.record.kept.size(); ++k)
    if (!sweep.record.kept[k].at_value ||
        std::find(bands.begin(), bands.end(), sweep.record.kept[k].column) == bands.end())
      numbers.push_back(k);
  return numbers;
}

std::string tornado_picture(const SweepTable& sweep, const SweepTables& tables, std::size_t c, std::size_t kept) {
  constexpr std::size_t kMostBars = 12;
  constexpr double kRow = 20, kNameEdge = 230, kBar = 12, kThin = 4;
  const std::vector<double>& values = sweep.cases[c].kept[kept];
  const bool ranges = sweep.record.design == "one_at_a_time", indices = sweep.record.block > 1;
  if (values.empty() || (ranges && !std::isfinite(values.front()))) return {};
  std::vector<Bar> bars = ranges    ? range_bars(sweep, values)
                          : indices ? index_bars(sweep, tables, c, kept)
                                    : rank_bars(sweep, tables, c, kept);
  std::erase_if(bars, [](const Bar& b) { return !(b.size() > 0); });
  std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.size() > b.size(); });
  if (bars.size() > kMostBars) bars.resize(kMostBars);
  if (bars.empty()) return {};
  double low = bars.front().low, high = bars.front().high;
  for (const Bar& b : bars) {
    low = std::min({low, b.low, b.high});
    high = std::fmax(std::max({high, b.low, b.high}), b.thin_high);
  }
  const double bottom = kTopEdge + kRow * static_cast<double>(bars.size());
  const SvgAxis x = ranges ? linear_axis(low, high, 6, {kNameEdge, kRightEdge})
                           : linear_axis_within(indices ? 0 : -1, 1, 6, {kNameEdge, kRightEdge});
  SvgAxis y;  // no numbers: names stand there
  y.at_low = bottom;
  y.at_high = kTopEdge;
  const std::string what = ranges ? sweep.record.kept[kept].name + ": lowest to highest, one factor at a time"
                           : indices
                               ? "Sobol indices of " + sweep.record.kept[kept].name + ": first (wide), total (thin)"
                               : "Rank correlations with " + sweep.record.kept[kept].name;
  std::string out = chart_opening(what, bottom + 50) +
                    svg_text(kLeftEdge, 38, sweep.cases.size() > 1 ? sweep.case_name(c) : "") +
                    draw_axes(x, y,
                              ranges    ? sweep.record.kept[kept].name
                              : indices ? "share of the variance"
                                        : "Spearman's rho");
  const double ends[] = {x.low, x.high};
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const double top = kTopEdge + kRow * static_cast<double>(k) + 0.5 * (kRow - kBar);
    const auto at = [&](double v) { return x(std::clamp(v, ends[0], ends[1])); };
    out +=
        chart_bar(at(bars[k].low), at(bars[k].high), top, kBar, case_colour(bars[k].high < bars[k].low ? 1 : 0), 0.7);
    if (std::isfinite(bars[k].thin_high))
      out += chart_bar(at(bars[k].low), at(bars[k].thin_high), top + 0.5 * (kBar - kThin), kThin, case_colour(1), 0.9);
    out += svg_text(kNameEdge - 8, top + kBar - 2, bars[k].name, "text-anchor=\"end\"");
  }
  return out + "</svg>\n";
}

}  // namespace genu
