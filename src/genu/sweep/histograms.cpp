#include "genu/sweep/histograms.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/svg_axes.h"
#include "genu/results/svg_text.h"
#include "genu/sweep/chart_parts.h"
#include "genu/sweep/statistics.h"

namespace genu {
namespace {

constexpr std::size_t kBins = 30;

/// Counts of some kept numbers in bins that they share.
struct Counts {
  double low = kNoNumber, high = kNoNumber, most = 1;
  std::vector<std::vector<std::vector<int>>> of;  ///< [kept number][case][bin]
};

Counts count(const SweepTable& sweep, const std::vector<std::size_t>& cases, const std::vector<std::size_t>& kept) {
  Counts counts;
  for (const std::size_t k : kept)
    for (const std::size_t c : cases)
      for (const double v : sweep.cases[c].kept[k])
        counts.low = std::fmin(counts.low, v), counts.high = std::fmax(counts.high, v);
  if (!(counts.high > counts.low)) return counts;
  for (const std::size_t k : kept) {
    counts.of.emplace_back();
    for (const std::size_t c : cases) {
      std::vector<int>& bins = counts.of.back().emplace_back(kBins);
      for (const double v : sweep.cases[c].kept[k]) {
        if (!std::isfinite(v)) continue;
        const auto bin = static_cast<std::size_t>((v - counts.low) / (counts.high - counts.low) * kBins);
        counts.most = std::max(counts.most, static_cast<double>(++bins[std::min(bin, kBins - 1)]));
      }
    }
  }
  return counts;
}

/// The chart of one of the numbers. Moving bars are there where they are empty too.
std::string chart(const SweepTable& sweep, const std::vector<std::size_t>& cases, const Counts& counts,
                  std::size_t shown, const std::string& name, bool moving) {
  const SvgAxis x = linear_axis_within(counts.low, counts.high, 8, {kLeftEdge, kRightEdge}),
                y = linear_axis(0, counts.most, 5, {kBottomEdge, kTopEdge});
  std::string out = chart_opening("Samples by " + name) + chart_legend(sweep, cases) + draw_axes(x, y, name);
  const double step = (counts.high - counts.low) / kBins;
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (std::size_t b = 0; b < kBins; ++b) {
      const double from = counts.low + step * static_cast<double>(b), top = y(counts.of[shown][k][b]);
      if (moving || counts.of[shown][k][b] > 0)
        out += chart_bar(x(from), x(from + step), top, kBottomEdge - top, case_colour(k), 0.45,
                         moving ? "class=\"b\"" : "");
    }
  return out + "</svg>\n";
}

/// The kept numbers of a column at values of the main coordinate, by value.
std::vector<std::pair<double, std::size_t>> values_of(const SweepTable& sweep, const std::string& column) {
  std::vector<std::pair<double, std::size_t>> values;
  for (std::size_t k = 0; k < sweep.record.kept.size(); ++k)
    if (sweep.record.kept[k].at_value && sweep.record.kept[k].column == column)
      values.emplace_back(sweep.record.kept[k].value, k);
  std::sort(values.begin(), values.end());
  return values;
}

/// [1,2,3]
template <typename Range, typename Word>
std::string list_of(const Range& range, const Word& word) {
  std::string out;
  for (const auto& one : range) out += (out.empty() ? "" : ",") + word(one);
  return "[" + out + "]";
}

}  // namespace

std::string histogram_picture(const SweepTable& sweep, const std::string& scene, std::size_t kept) {
  const std::vector<std::size_t> cases = cases_of(sweep, scene);
  const Counts counts = count(sweep, cases, {kept});
  return counts.of.empty() ? std::string() : chart(sweep, cases, counts, 0, sweep.record.kept[kept].name, false);
}

std::string moving_histogram(const SweepTable& sweep, const std::string& scene, const std::string& column) {
  const std::vector<std::size_t> cases = cases_of(sweep, scene);
  const auto values = values_of(sweep, column);
  std::vector<std::size_t> kept;
  for (const auto& [value, k] : values) kept.push_back(k);
  const Counts counts = count(sweep, cases, kept);
  if (counts.of.empty()) return {};
  const SvgAxis y = linear_axis(0, counts.most, 5, {kBottomEdge, kTopEdge});
  const auto number = [](double v) { return fmt::format("{}", v); };
  const std::string data = fmt::format(
      "{{\"x\":{},\"px\":{},\"n\":{}}}", list_of(values, [&](const auto& one) { return number(one.first); }),
      (kBottomEdge - kTopEdge) / y.high, list_of(counts.of, [](const auto& of_one) {
        return list_of(of_one,
                       [](const auto& bins) { return list_of(bins, [](int n) { return fmt::format("{}", n); }); });
      }));
  const std::size_t middle = values.size() / 2;
  return fmt::format("<div class=\"h\" data-h='{}'>\n{}</div>\n", data,
                     chart(sweep, cases, counts, middle, column, true));
}

std::string histogram_slider(const SweepTable& sweep) {
  std::vector<double> values;
  for (const auto& kept : sweep.record.kept)
    if (kept.at_value) values.push_back(kept.value);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.empty()) return {};
  return fmt::format(
      "<p><label>{} = <output id=\"v\">{}</output> <input id=\"at\" type=\"range\" min=\"0\" max=\"{}\" value=\"{}\" "
      "style=\"width:min(480px,60vw);vertical-align:middle\" aria-label=\"{}\"></label></p>\n<script>\n"
      "const X={},at=document.getElementById('at');\n"
      "function show(){{const v=X[at.value];document.getElementById('v').textContent=v;\n"
      "for(const f of document.querySelectorAll('.h')){{const d=f.d||(f.d=JSON.parse(f.dataset.h));let i=0;\n"
      "d.x.forEach((x,k)=>{{if(Math.abs(x-v)<Math.abs(d.x[i]-v))i=k}});const n=d.n[i].flat();\n"
      "f.querySelectorAll('.b').forEach((b,k)=>{{const "
      "h=n[k]*d.px;b.setAttribute('height',h);b.setAttribute('y',{}-h)}})"
      "}}}}\nat.addEventListener('input',show);addEventListener('load',show);\n</script>\n",
      svg_escaped(sweep.record.main), values[values.size() / 2], values.size() - 1, values.size() / 2,
      svg_escaped(sweep.record.main), list_of(values, [](double v) { return fmt::format("{}", v); }), kBottomEdge);
}

}  // namespace genu
