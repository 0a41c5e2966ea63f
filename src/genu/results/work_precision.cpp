#include "genu/results/work_precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/results/svg_text.h"

namespace genu {
namespace {

// Pixels.
constexpr double kSide = 300, kHeight = 240, kMarginLeft = 70, kMarginTop = 62, kMarginBelow = 50, kBetween = 40;
constexpr double kLegendLine = 17;
constexpr std::array kSeriesColours = {"#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"};

bool drawable(const WorkPoint& p) {
  return std::isfinite(p.seconds) && std::isfinite(p.error) && p.seconds > 0 && p.error > 0;
}

/// A logarithmic axis over whole decades.
struct LogAxis {
  int low = 0, high = 1;
  double from = 0, to = 1;  // pixels

  LogAxis(double smallest, double largest, double at_low, double at_high) : from(at_low), to(at_high) {
    low = static_cast<int>(std::floor(std::log10(smallest)));
    high = std::max(low + 1, static_cast<int>(std::ceil(std::log10(largest))));
  }
  double operator()(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
};

std::string seconds_text(int decade) {
  constexpr std::array kUnits = {"ns", "us", "ms", "s"};
  const int unit = std::clamp((decade + 9) / 3, 0, 3);
  return fmt::format("{:g} {}", std::pow(10.0, decade + 9 - 3 * unit), kUnits[static_cast<std::size_t>(unit)]);
}

std::vector<std::string> series_names(const std::vector<WorkPanel>& panels) {
  std::vector<std::string> names;
  for (const WorkPanel& panel : panels)
    for (const WorkPoint& p : panel.points)
      if (std::find(names.begin(), names.end(), p.series) == names.end()) names.push_back(p.series);
  return names;
}

const char* colour_of(const std::vector<std::string>& names, const std::string& series) {
  const auto i = std::find(names.begin(), names.end(), series) - names.begin();
  return kSeriesColours[static_cast<std::size_t>(i) % kSeriesColours.size()];
}

std::string front_line(const WorkPanel& panel, const LogAxis& x, const LogAxis& y) {
  const std::vector<bool> front = pareto_front(panel.points);
  std::vector<const WorkPoint*> points;
  for (std::size_t i = 0; i < front.size(); ++i)
    if (front[i]) points.push_back(&panel.points[i]);
  std::stable_sort(points.begin(), points.end(), [](const auto* a, const auto* b) { return a->seconds < b->seconds; });
  std::string path;
  for (const WorkPoint* p : points)
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(p->seconds), y(p->error));
  return path.empty() ? "" : fmt::format("<path class=\"front\" d=\"{}\"/>\n", path);
}

std::string draw_axes(const LogAxis& x, const LogAxis& y) {
  std::string out;
  for (int k = x.low; k <= x.high; ++k) {
    const double px = x(std::pow(10.0, k));
    out += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", px, y.from, px, y.to);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", px, y.from + 16,
                       seconds_text(k));
  }
  const int every = 1 + (y.high - y.low) / 8;
  for (int k = y.low; k <= y.high; k += every) {
    const double py = y(std::pow(10.0, k));
    out += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", x.from, py, x.to, py);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">1e{}</text>\n", x.from - 6, py + 4, k);
  }
  return out;
}

std::string draw_panel(const WorkPanel& panel, const std::vector<std::string>& names, double left) {
  double fastest = std::numeric_limits<double>::infinity(), best = fastest, slowest = 0, worst = 0;
  for (const WorkPoint& p : panel.points) {
    if (!drawable(p)) continue;
    fastest = std::min(fastest, p.seconds);
    slowest = std::max(slowest, p.seconds);
    best = std::min(best, p.error);
    worst = std::max(worst, p.error);
  }
  std::string out = fmt::format("<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left, kMarginTop - 12,
                                svg_escaped(panel.title));
  if (!(slowest > 0)) return out;
  if (panel.target > 0) best = std::min(best, panel.target), worst = std::max(worst, panel.target);
  const LogAxis x(fastest, slowest, left, left + kSide), y(best, worst, kMarginTop + kHeight, kMarginTop);
  out += draw_axes(x, y) + front_line(panel, x, y);
  if (panel.target > 0)
    out += fmt::format("<path class=\"target\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", x.from, y(panel.target), x.to,
                       y(panel.target));
  for (const WorkPoint& p : panel.points)
    if (drawable(p))
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"><title>{}</title></circle>\n",
                         x(p.seconds), y(p.error), colour_of(names, p.series), svg_escaped(p.name));
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">time a pose</text>\n", left + kSide / 2,
                     kMarginTop + kHeight + 36);
  return out;
}

}  // namespace

std::vector<bool> pareto_front(const std::vector<WorkPoint>& points) {
  std::vector<bool> front(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const WorkPoint& p = points[i];
    front[i] = drawable(p) && std::none_of(points.begin(), points.end(), [&](const WorkPoint& q) {
                 return drawable(q) && q.seconds <= p.seconds && q.error <= p.error &&
                        (q.seconds < p.seconds || q.error < p.error);
               });
  }
  return front;
}

std::string to_svg(const std::string& title, const std::vector<WorkPanel>& panels) {
  const std::vector<std::string> names = series_names(panels);
  const double width = kMarginLeft + static_cast<double>(panels.size()) * (kSide + kMarginLeft + kBetween),
               legend_top = kMarginTop + kHeight + kMarginBelow + 14,
               height = legend_top + kLegendLine * static_cast<double>(names.size() + 1);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n<style>text{{font:12px "
      "sans-serif;fill:#222}}.title{{font-weight:bold}}.grid{{stroke:#ddd;fill:none}}"
      ".front{{stroke:#888;stroke-width:1.5;fill:none}}.target{{stroke:#D55E00;stroke-dasharray:5 4;fill:none}}"
      "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  out += fmt::format("<text class=\"title\" x=\"{:.1f}\" y=\"24\">{}</text>\n", kMarginLeft, svg_escaped(title));
  for (std::size_t i = 0; i < panels.size(); ++i)
    out += draw_panel(panels[i], names, kMarginLeft + static_cast<double>(i) * (kSide + kMarginLeft + kBetween));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double y = legend_top + kLegendLine * static_cast<double>(i);
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", kMarginLeft + 4, y - 4,
                       colour_of(names, names[i]));
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kMarginLeft + 14, y, svg_escaped(names[i]));
  }
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">grey: no other setting is both faster and more exact</text>\n",
                     kMarginLeft, legend_top + kLegendLine * static_cast<double>(names.size()));
  return out + "</svg>\n";
}

}  // namespace genu
