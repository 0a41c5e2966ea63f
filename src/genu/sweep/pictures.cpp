#include "genu/sweep/pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/svg_axes.h"
#include "genu/results/svg_text.h"
#include "genu/sweep/statistics.h"
#include "genu/sweep/sweep_def.h"

namespace genu {
namespace {

constexpr double kPictureWidth = 640, kPictureHeight = 320, kLeftEdge = 70, kRightEdge = 620, kTopEdge = 50,
                 kBottomEdge = 270;
constexpr std::array kCaseColours = {"#1f5fa8", "#c4541a", "#2e8b57", "#7b4fa3", "#8a6d1f", "#b03a6a"};

const char* colour(std::size_t k) { return kCaseColours[k % kCaseColours.size()]; }

std::string opening(const std::string& title, double height = kPictureHeight) {
  const std::string style = std::string(kSvgLetters) + kSvgAxesStyle +
                            "path{fill:none}.title{font-weight:600;font-size:13px}.line{stroke-width:1.8}";
  return svg_opening(kPictureWidth, height, style) + svg_text(kLeftEdge, 20, title, "class=\"title\"");
}

/// Names of cases in their colours, above the axes.
std::string legend(const SweepTable& sweep, const std::vector<std::size_t>& cases) {
  std::string out;
  double x = kLeftEdge;
  for (std::size_t k = 0; k < cases.size() && cases.size() > 1; ++k) {
    const std::string& name = sweep.record.cases[cases[k]].what_if;
    out += svg_text(x, 38, name, fmt::format("style=\"fill:{}\"", colour(k)));
    constexpr double kLegendLetter = 7, kBetween = 20;
    x += kLegendLetter * static_cast<double>(name.size()) + kBetween;
  }
  return out;
}

std::vector<std::size_t> cases_of(const SweepTable& sweep, const std::string& scene) {
  std::vector<std::size_t> cases;
  for (std::size_t c = 0; c < sweep.cases.size(); ++c)
    if (sweep.record.cases[c].scene == scene) cases.push_back(c);
  return cases;
}

/// Percentiles of one column over the main coordinate.
struct Bands {
  std::vector<double> x;
  std::array<std::vector<double>, 5> y;  ///< 5, 25, 50, 75, 95 %
};

Bands bands_of(const SweepTable& sweep, std::size_t c, const std::string& column) {
  constexpr std::array kShares = {0.05, 0.25, 0.5, 0.75, 0.95};
  std::vector<std::pair<double, std::size_t>> rows;
  for (std::size_t k = 0; k < sweep.record.kept.size(); ++k)
    if (sweep.record.kept[k].at_value && sweep.record.kept[k].column == column)
      rows.emplace_back(sweep.record.kept[k].value, k);
  std::sort(rows.begin(), rows.end());
  Bands bands;
  for (const auto& [value, k] : rows) {
    std::vector<double> sorted = finite_of(sweep.independent(sweep.cases[c].kept[k]));
    if (sorted.empty()) continue;
    std::sort(sorted.begin(), sorted.end());
    bands.x.push_back(value);
    for (std::size_t i = 0; i < kShares.size(); ++i) bands.y[i].push_back(quantile(sorted, kShares[i]));
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

std::vector<Bar> rank_bars(const SweepTable& sweep, const std::vector<double>& values) {
  std::vector<Bar> bars;
  for (std::size_t f = 0; f < sweep.record.factors.size(); ++f)
    bars.push_back({sweep.record.factors[f], 0, rank_correlation(sweep.draws[f], values)});
  return bars;
}

std::vector<Bar> index_bars(const SweepTable& sweep, const std::vector<double>& values) {
  std::vector<Bar> bars;
  const auto indices = sobol_indices(values, sweep.record.factors.size());
  for (std::size_t f = 0; f < indices.size(); ++f)
    bars.push_back({sweep.record.factors[f], 0, indices[f].first, indices[f].total});
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

std::string rectangle(double x1, double x2, double y, double height, const char* colour, double opacity) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"fill:{};fill-opacity:{}\"/>\n",
      std::min(x1, x2), y, std::abs(x2 - x1), height, colour, opacity);
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

std::string bands_picture(const SweepTable& sweep, const std::string& scene, const std::string& column) {
  const std::vector<std::size_t> cases = cases_of(sweep, scene);
  std::vector<Bands> all;
  double low = kNoNumber, high = kNoNumber, first = kNoNumber, last = kNoNumber;
  for (const std::size_t c : cases) {
    all.push_back(bands_of(sweep, c, column));
    for (const double v : all.back().y.front()) low = std::fmin(low, v);
    for (const double v : all.back().y.back()) high = std::fmax(high, v);
    for (const double v : all.back().x) first = std::fmin(first, v), last = std::fmax(last, v);
  }
  if (!(last > first)) return {};
  const SvgAxis x = linear_axis_within(first, last, 8, {kLeftEdge, kRightEdge}),
                y = linear_axis(low, high, 6, {kBottomEdge, kTopEdge});
  std::string out = opening(column + ": median, 25 to 75 % and 5 to 95 % of the samples") + legend(sweep, cases) +
                    draw_axes(x, y, sweep.record.main);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (all[k].x.empty()) continue;
    out += area(x, y, all[k], 0, 4, colour(k), 0.15) + area(x, y, all[k], 1, 3, colour(k), 0.25);
    out += fmt::format("<path class=\"line\" style=\"stroke:{}\" d=\"{}\"/>\n", colour(k),
                       points(x, y, all[k].x, all[k].y[2]));
  }
  return out + "</svg>\n";
}

std::vector<std::size_t> pictured_numbers(const SweepTable& sweep) {
  const std::vector<std::string> bands = columns_with_bands(sweep);
  std::vector<std::size_t> numbers;
  for (const std::string& column : bands) {
    std::size_t best = sweep.record.kept.size();
    double spread = -1;
    for (std::size_t k = 0; k < sweep.record.kept.size(); ++k) {
      if (sweep.record.kept[k].column != column || !sweep.record.kept[k].at_value) continue;
      const double sd = moments(sweep.cases.front().kept[k]).sd;
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

std::string histogram_picture(const SweepTable& sweep, const std::string& scene, std::size_t kept) {
  constexpr std::size_t kBins = 30;
  const std::vector<std::size_t> cases = cases_of(sweep, scene);
  double low = kNoNumber, high = kNoNumber;
  for (const std::size_t c : cases)
    for (const double v : sweep.cases[c].kept[kept]) low = std::fmin(low, v), high = std::fmax(high, v);
  if (!(high > low)) return {};
  std::vector<std::vector<double>> counts(cases.size(), std::vector<double>(kBins));
  double most = 1;
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (const double v : sweep.cases[cases[k]].kept[kept]) {
      if (!std::isfinite(v)) continue;
      const auto bin = static_cast<std::size_t>((v - low) / (high - low) * kBins);
      most = std::max(most, ++counts[k][std::min(bin, kBins - 1)]);
    }
  const SvgAxis x = linear_axis_within(low, high, 8, {kLeftEdge, kRightEdge}),
                y = linear_axis(0, most, 5, {kBottomEdge, kTopEdge});
  std::string out = opening("Samples by " + sweep.record.kept[kept].name) + legend(sweep, cases) +
                    draw_axes(x, y, sweep.record.kept[kept].name);
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (std::size_t b = 0; b < kBins; ++b) {
      const double step = (high - low) / kBins, from = low + step * static_cast<double>(b);
      if (counts[k][b] > 0)
        out += rectangle(x(from), x(from + step), y(counts[k][b]), kBottomEdge - y(counts[k][b]), colour(k), 0.45);
    }
  return out + "</svg>\n";
}

std::string tornado_picture(const SweepTable& sweep, std::size_t c, std::size_t kept) {
  constexpr std::size_t kMostBars = 12;
  constexpr double kRow = 20, kNameEdge = 230, kBar = 12, kThin = 4;
  const std::vector<double>& values = sweep.cases[c].kept[kept];
  const bool ranges = sweep.record.design == "one_at_a_time", indices = sweep.record.block > 1;
  if (values.empty() || (ranges && !std::isfinite(values.front()))) return {};
  std::vector<Bar> bars = ranges    ? range_bars(sweep, values)
                          : indices ? index_bars(sweep, values)
                                    : rank_bars(sweep, values);
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
  std::string out = opening(what, bottom + 50) +
                    svg_text(kLeftEdge, 38, sweep.cases.size() > 1 ? sweep.case_name(c) : "") +
                    draw_axes(x, y,
                              ranges    ? sweep.record.kept[kept].name
                              : indices ? "share of the variance"
                                        : "Spearman's rho");
  const double ends[] = {x.low, x.high};
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const double top = kTopEdge + kRow * static_cast<double>(k) + 0.5 * (kRow - kBar);
    const auto at = [&](double v) { return x(std::clamp(v, ends[0], ends[1])); };
    out += rectangle(at(bars[k].low), at(bars[k].high), top, kBar, colour(bars[k].high < bars[k].low ? 1 : 0), 0.7);
    if (std::isfinite(bars[k].thin_high))
      out += rectangle(at(bars[k].low), at(bars[k].thin_high), top + 0.5 * (kBar - kThin), kThin, colour(1), 0.9);
    out += svg_text(kNameEdge - 8, top + kBar - 2, bars[k].name, "text-anchor=\"end\"");
  }
  return out + "</svg>\n";
}

}  // namespace genu
