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
constexpr double kSide = 310, kHeight = 230, kMarginLeft = 64, kMarginTop = 74, kMarginRight = 26, kBelow = 84;
constexpr double kLegendLine = 20, kTitleTop = 26;
constexpr std::size_t kColumns = 2, kLegendColumns = 3;
constexpr std::array kSeriesColours = {"#000000", "#9ecae1", "#4292c6", "#08306b", "#E69F00",
                                       "#D55E00", "#009E73", "#CC79A7", "#8c8c00"};

bool drawable(const WorkPoint& p) {
  return std::isfinite(p.seconds) && std::isfinite(p.error) && p.seconds > 0 && p.error > 0;
}

/// A logarithmic axis with lines at powers of ten, or at 1, 2 and 5 times these where there are few.
struct LogAxis {
  std::vector<double> lines;
  double from, to;  // pixels

  LogAxis(double smallest, double largest, double at_low, double at_high) : from(at_low), to(at_high) {
    constexpr double kFewDecades = 100;
    const int low = static_cast<int>(std::floor(std::log10(smallest))),
              high = std::max(low + 1, static_cast<int>(std::ceil(std::log10(largest))));
    for (int k = low; k <= high; ++k)
      for (const double times : {1.0, 2.0, 5.0}) {
        if (times > 1 && (k == high || largest > kFewDecades * smallest)) continue;
        lines.push_back(times * std::pow(10.0, k));
      }
    // No empty stretch at either end.
    while (lines.size() > 2 && lines[1] <= smallest) lines.erase(lines.begin());
    while (lines.size() > 2 && lines[lines.size() - 2] >= largest) lines.pop_back();
  }
  double operator()(double value) const {
    return from + std::log(value / lines.front()) / std::log(lines.back() / lines.front()) * (to - from);
  }
};

std::string seconds_text(double seconds) {
  constexpr std::array kUnits = {"ns", "us", "ms", "s"};
  const int unit = std::clamp(static_cast<int>(std::floor(std::log10(seconds) + 1e-9) + 9) / 3, 0, 3);
  return fmt::format("{:.3g} {}", seconds * std::pow(10.0, 9 - 3 * unit), kUnits[static_cast<std::size_t>(unit)]);
}

std::string power_text(double value) {
  const double power = std::floor(std::log10(value) + 1e-9);
  return fmt::format("{:.0f}e{:.0f}", value / std::pow(10.0, power), power);
}

std::string text(double x, double y, const char* how, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, how, svg_escaped(words));
}

/// Those that the picture names first, then others as they come.
std::vector<std::string> series_names(const WorkPicture& picture) {
  std::vector<std::string> names = picture.series;
  for (const WorkPanel& panel : picture.panels)
    for (const WorkPoint& p : panel.points)
      if (std::find(names.begin(), names.end(), p.series) == names.end()) names.push_back(p.series);
  return names;
}

bool is_drawn(const WorkPicture& picture, const std::string& series) {
  const auto of_it = [&](const WorkPoint& p) { return p.series == series; };
  return std::any_of(picture.panels.begin(), picture.panels.end(), [&](const WorkPanel& panel) {
    return std::any_of(panel.points.begin(), panel.points.end(), of_it);
  });
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
  constexpr double kLeastApart = 20, kLeastBeside = 52;  // pixels, of words below and beside each other
  std::string out;
  const auto line = [&](double x1, double y1, double x2, double y2) {
    out += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", x1, y1, x2, y2);
  };
  double labelled = -kLeastBeside;
  for (std::size_t i = 0; i < x.lines.size(); ++i) {
    const double at = x(x.lines[i]), next = i + 1 < x.lines.size() ? x(x.lines[i + 1]) : x.to + kLeastBeside;
    line(at, y.from, at, y.to);
    const bool before_ten = next - at < kLeastBeside && i > 0 && at - x(x.lines[i - 1]) > 1.1 * (next - at);  // a 5
    if (before_ten || at - labelled < kLeastBeside) continue;
    out += text(at, y.from + 17, " text-anchor=\"middle\"", seconds_text(x.lines[i]));
    labelled = at;
  }
  const double apart = std::abs(y.from - y.to) / static_cast<double>(y.lines.size() - 1);
  const auto every = static_cast<std::size_t>(std::ceil(kLeastApart / apart));
  for (std::size_t i = 0; i < y.lines.size(); i += every) {
    line(x.from, y(y.lines[i]), x.to, y(y.lines[i]));
    out += text(x.from - 7, y(y.lines[i]) + 4, " text-anchor=\"end\"", power_text(y.lines[i]));
  }
  return out;
}

std::string draw_point(const WorkPoint& p, double x, double y, const char* colour) {
  const std::string ring =
      p.chosen ? fmt::format("<circle class=\"chosen\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\"/>\n", x, y) : "";
  return ring + fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"><title>{}</title></circle>\n", x,
                            y, colour, svg_escaped(p.name));
}

std::string draw_panel(const WorkPanel& panel, const std::vector<std::string>& names, double left, double top) {
  double fastest = std::numeric_limits<double>::infinity(), best = fastest, slowest = 0, worst = 0;
  for (const WorkPoint& p : panel.points) {
    if (!drawable(p)) continue;
    fastest = std::min(fastest, p.seconds);
    slowest = std::max(slowest, p.seconds);
    best = std::min(best, p.error);
    worst = std::max(worst, p.error);
  }
  std::string out = text(left, top - 12, " class=\"title\"", panel.title);
  if (!(slowest > 0)) return out;
  if (panel.target > 0) best = std::min(best, panel.target), worst = std::max(worst, panel.target);
  const LogAxis x(fastest, slowest, left, left + kSide), y(best, worst, top + kHeight, top);
  out += draw_axes(x, y) + front_line(panel, x, y);
  if (panel.target > 0)
    out += fmt::format("<path class=\"target\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", x.from, y(panel.target), x.to,
                       y(panel.target));
  for (const WorkPoint& p : panel.points)
    if (drawable(p)) out += draw_point(p, x(p.seconds), y(p.error), colour_of(names, p.series));
  return out + text(left + kSide / 2, top + kHeight + 38, " text-anchor=\"middle\"", "time a pose");
}

/// A circle and its words in one of some columns.
class Legend {
 public:
  Legend(double top, double width) : top_(top), column_((width - kMarginLeft) / kLegendColumns) {}

  void add(const std::string& colour, const std::string& words) {
    const double x = kMarginLeft + column_ * static_cast<double>(count_ % kLegendColumns), y = below();
    out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x + 4, y - 4, colour);
    out_ += text(x + 15, y, "", words);
    ++count_;
  }
  /// The first line that is free, once all are added.
  double below() const { return top_ + kLegendLine * static_cast<double>(count_ / kLegendColumns); }
  void end_line() { count_ = (count_ + kLegendColumns - 1) / kLegendColumns * kLegendColumns; }
  const std::string& svg() const { return out_; }

 private:
  double top_, column_;
  std::size_t count_ = 0;
  std::string out_;
};

std::string opened(double width, double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n<style>text{{font:13px "
      "sans-serif;fill:#222}}.title{{font-weight:bold}}.grid{{stroke:#ddd;fill:none}}"
      ".front{{stroke:#888;stroke-width:1.5;fill:none}}.target{{stroke:#D55E00;stroke-dasharray:5 4;fill:none}}"
      ".chosen{{stroke:#D55E00;stroke-width:2;fill:none}}"
      "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
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

std::string to_svg(const WorkPicture& picture) {
  const std::vector<std::string> names = series_names(picture);
  const std::size_t columns = std::min(kColumns, std::max<std::size_t>(1, picture.panels.size())),
                    rows = (picture.panels.size() + columns - 1) / columns;
  const double across = kMarginLeft + kSide + kMarginRight, down = kHeight + kBelow,
               width = static_cast<double>(kColumns) * across;
  std::string panels;
  for (std::size_t i = 0; i < picture.panels.size(); ++i)
    panels += draw_panel(picture.panels[i], names, kMarginLeft + static_cast<double>(i % columns) * across,
                         kMarginTop + static_cast<double>(i / columns) * down);
  Legend legend(kMarginTop + static_cast<double>(rows) * down - 10, width);
  for (const std::string& name : names)
    if (is_drawn(picture, name)) legend.add(colour_of(names, name), name);
  legend.end_line();
  std::vector<std::string> words = picture.words;
  words.insert(words.begin(), "grey line: no other setting is both faster and more exact");
  std::string lines;
  double y = legend.below();
  for (const std::string& line : words) {
    lines += text(kMarginLeft, y, "", line);
    y += kLegendLine;
  }
  return opened(width, y) + text(kMarginLeft, kTitleTop, " class=\"title\"", picture.title) + panels + legend.svg() +
         lines + "</svg>\n";
}

}  // namespace genu
