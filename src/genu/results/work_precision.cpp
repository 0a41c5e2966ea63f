#include "genu/results/work_precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/results/svg_axes.h"
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

std::string seconds_text(double seconds) {
  constexpr std::array kUnits = {"ns", "us", "ms", "s"};
  const int unit = std::clamp(static_cast<int>(std::floor(std::log10(seconds) + 1e-9) + 9) / 3, 0, 3);
  return fmt::format("{:.3g} {}", seconds * std::pow(10.0, 9 - 3 * unit), kUnits[static_cast<std::size_t>(unit)]);
}

std::string power_text(double value) {
  const double power = std::floor(std::log10(value) + 1e-9);
  return fmt::format("{:.0f}e{:.0f}", value / std::pow(10.0, power), power);
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

std::string front_line(const WorkPanel& panel, const SvgAxis& x, const SvgAxis& y) {
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
  std::string out = svg_text(left, top - 12, panel.title, "class=\"panel\"");
  if (!(slowest > 0)) return out;
  if (panel.target > 0) best = std::min(best, panel.target), worst = std::max(worst, panel.target);
  constexpr double kLeastBeside = 52, kLeastApart = 20;  // pixels, of numbers beside and below each other
  const SvgAxis x = log_axis(fastest, slowest, {left, left + kSide}, seconds_text, kLeastBeside),
                y = log_axis(best, worst, {top + kHeight, top}, power_text, kLeastApart);
  out += draw_axes(x, y, "time a pose") + front_line(panel, x, y);
  if (panel.target > 0) out += svg_line(x.at_low, y(panel.target), x.at_high, y(panel.target), "target");
  for (const WorkPoint& p : panel.points)
    if (drawable(p)) out += draw_point(p, x(p.seconds), y(p.error), colour_of(names, p.series));
  return out;
}

/// A circle and its words in one of some columns.
class Legend {
 public:
  Legend(double top, double width) : top_(top), column_((width - kMarginLeft) / kLegendColumns) {}

  void add(const std::string& colour, const std::string& words) {
    const double x = kMarginLeft + column_ * static_cast<double>(count_ % kLegendColumns), y = below();
    out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x + 4, y - 4, colour);
    out_ += svg_text(x + 15, y, words);
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

constexpr const char* kStyle =
    ".title{font-size:16px;font-weight:600;fill:#111}.panel{font-size:12.5px;font-weight:600;fill:#111}"
    ".front{stroke:#888;stroke-width:1.5;fill:none}.target{stroke:#D55E00;stroke-dasharray:5 4}"
    ".chosen{stroke:#D55E00;stroke-width:2;fill:none}";

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
    lines += svg_text(kMarginLeft, y, line);
    y += kLegendLine;
  }
  return svg_opening(width, y, std::string(kSvgLetters) + kSvgAxesStyle + kStyle) +
         svg_text(kMarginLeft, kTitleTop, picture.title, "class=\"title\"") + panels + legend.svg() + lines +
         "</svg>\n";
}

}  // namespace genu
