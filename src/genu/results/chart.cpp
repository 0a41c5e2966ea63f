#include "genu/results/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "genu/results/svg_axes.h"
#include "genu/results/svg_text.h"

namespace genu {
namespace {

// Pixels. Two panels side by side, the names of the lines to the right of each.
constexpr double kPlotWidth = 350, kPlotHeight = 150, kLeft = 62, kNames = 118, kAbovePlot = 38, kBelowPlot = 44;
constexpr double kPanelHeight = kAbovePlot + kPlotHeight + kBelowPlot;
constexpr double kLetter = 6.2, kLeader = 16;  // of a name, and of the line that leads to it
constexpr double kChartMargin = 14, kHeader = 40, kLine = 15, kNameDistance = 12;
constexpr int kChartColumns = 2;
constexpr std::size_t kMostPoints = 2000, kMostEventLines = 12;

// Okabe and Ito (2008), distinct for every kind of colour vision; without its yellow, too pale for a line on white.
constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                 "#56B4E9", "#E69F00", "#000000", "#888888"};

}  // namespace

bool Chart::breaks_before(std::size_t k) const { return std::binary_search(breaks.begin(), breaks.end(), k); }

namespace {

/// With room for the longest name.
double panel_width(const Chart& chart) {
  std::size_t longest = 0;
  for (const ChartPanel& panel : chart.panels)
    for (const ChartSeries& series : panel.series) longest = std::max(longest, series.name.size());
  return kLeft + kPlotWidth + std::max(kNames, kLeader + kLetter * static_cast<double>(longest));
}

std::pair<double, double> range(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return {low, high};
}

/// The x axis ends where the data ends; only ticks within are drawn.
SvgAxis horizontal(const Chart& chart, double left) {
  const auto [low, high] = range(chart.x);
  return linear_axis_within(low, high, 8, {left, left + kPlotWidth});
}

SvgAxis vertical(const ChartPanel& panel, double top) {
  std::vector<double> all;
  for (const ChartSeries& s : panel.series) {
    all.insert(all.end(), s.y.begin(), s.y.end());
    for (std::size_t k = 0; k < std::min(s.y.size(), s.bar.size()); ++k)
      for (const double sign : {-1.0, 1.0}) all.push_back(s.y[k] + sign * s.bar[k]);
  }
  if (panel.from_zero) all.push_back(0);
  const auto [low, high] = range(all);
  return linear_axis(low, high, 5, {top + kPlotHeight, top});
}

/// The line of a series; a value between two gaps becomes a dot. Long series are thinned to what a screen can show.
std::string draw_series(const Chart& chart, const ChartSeries& series, const SvgAxis& x, const SvgAxis& y,
                        const char* colour) {
  std::string path, dots;
  const std::size_t n = std::min(chart.x.size(), series.y.size()), stride = 1 + n / kMostPoints;
  int run = 0;
  double last_x = 0, last_y = 0;
  const auto end_run = [&] {
    if (run == 1)
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n", last_x, last_y, colour);
    run = 0;
  };
  for (std::size_t k = 0; k < n; ++k) {
    if (chart.breaks_before(k)) end_run();
    if (!std::isfinite(chart.x[k]) || !std::isfinite(series.y[k])) {
      end_run();
    } else if (k % stride == 0 || k + 1 == n) {
      last_x = x(chart.x[k]);
      last_y = y(series.y[k]);
      path += fmt::format("{}{:.1f} {:.1f}", run++ == 0 ? "M" : "L", last_x, last_y);
    }
  }
  end_run();
  return fmt::format("<path class=\"line\" stroke=\"{}\" d=\"{}\"/>\n", colour, path) + dots;
}

/// The band within which a series may lie, in pieces where it is known without a gap.
std::string draw_band(const Chart& chart, const ChartSeries& series, const SvgAxis& x, const SvgAxis& y,
                      const char* colour) {
  const std::size_t n = std::min({chart.x.size(), series.y.size(), series.bar.size()}), stride = 1 + n / kMostPoints;
  std::string path, upper;
  std::vector<std::string> lower;
  const auto end_run = [&] {
    if (!upper.empty())
      path += "M" + upper.substr(1) + fmt::format("{}", fmt::join(lower.rbegin(), lower.rend(), "")) + "Z";
    upper.clear();
    lower.clear();
  };
  for (std::size_t k = 0; k < n; ++k) {
    if (chart.breaks_before(k)) end_run();
    if (!std::isfinite(chart.x[k]) || !std::isfinite(series.y[k]) || !std::isfinite(series.bar[k])) {
      end_run();
    } else if (k % stride == 0 || k + 1 == n) {
      upper += fmt::format("L{:.1f} {:.1f}", x(chart.x[k]), y(series.y[k] + series.bar[k]));
      lower.push_back(fmt::format("L{:.1f} {:.1f}", x(chart.x[k]), y(series.y[k] - series.bar[k])));
    }
  }
  end_run();
  return path.empty() ? path : fmt::format("<path class=\"band\" fill=\"{}\" d=\"{}\"/>\n", colour, path);
}

/// Heights of the names: as near to the ends of their lines as they can be without touching each other.
std::vector<double> name_heights(const std::vector<double>& ends, double top) {
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ends[a] < ends[b]; });
  std::vector<double> out(ends.size());
  double free_from = top;
  for (const std::size_t k : order) {
    out[k] = std::max(ends[k], free_from);
    free_from = out[k] + kNameDistance;
  }
  double free_to = top + kPlotHeight;
  for (auto k = order.rbegin(); k != order.rend(); ++k) {
    out[*k] = std::min(out[*k], free_to);
    free_to = out[*k] - kNameDistance;
  }
  return out;
}

double last_finite(const std::vector<double>& values) {
  for (auto v = values.rbegin(); v != values.rend(); ++v)
    if (std::isfinite(*v)) return *v;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string draw_lines(const Chart& chart, const ChartPanel& panel, const SvgAxis& x, const SvgAxis& y, double top) {
  std::string out;
  std::vector<double> ends;
  for (const ChartSeries& s : panel.series) {
    const double end = last_finite(s.y);
    ends.push_back(std::isfinite(end) ? y(end) : top + kPlotHeight);
  }
  const std::vector<double> heights = name_heights(ends, top);
  const double right = x.at_high;
  for (std::size_t k = 0; k < panel.series.size(); ++k)
    out += draw_band(chart, panel.series[k], x, y, kColours[k % kColours.size()]);
  for (std::size_t k = 0; k < panel.series.size(); ++k) {
    const char* colour = kColours[k % kColours.size()];
    out += draw_series(chart, panel.series[k], x, y, colour);
    out += fmt::format("<path fill=\"none\" stroke=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", colour, right + 2,
                       ends[k], right + 11, heights[k]);
    out += svg_text(right + 14, heights[k] + 3.5, panel.series[k].name, fmt::format("fill=\"{}\"", colour).c_str());
  }
  return out;
}

/// The sign above a panel: up for gained, down for lost, a rhomb for the rest.
std::string event_sign(ChartEvent::Kind kind, double x, double y) {
  const char* shape = kind == ChartEvent::Kind::gained ? "M{0:.1f} {1:.1f}l4 7h-8z"
                      : kind == ChartEvent::Kind::lost ? "M{0:.1f} {2:.1f}l4 -7h-8z"
                                                       : "M{0:.1f} {1:.1f}l4 4l-4 4l-4 -4z";
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind == ChartEvent::Kind::lost ? "hollow" : "sign",
                     fmt::format(fmt::runtime(shape), x, y, y + 7));
}

std::string draw_events(const Chart& chart, const SvgAxis& x, double top) {
  std::string out;
  for (const ChartEvent& e : chart.events) {
    if (!std::isfinite(e.from) || !std::isfinite(e.to)) continue;
    const double from = std::clamp(x(std::min(e.from, e.to)), x.at_low, x.at_high),
                 to = std::clamp(x(std::max(e.from, e.to)), x.at_low, x.at_high);
    out += "<g><title>" + svg_escaped(e.text) + "</title>\n";
    if (e.kind == ChartEvent::Kind::window) {
      out += fmt::format("<rect class=\"window\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                         from, top, std::max(to - from, 1.5), kPlotHeight);
    } else {
      out += svg_line(from, top, from, top + kPlotHeight, "event") + event_sign(e.kind, from, top - 8);
    }
    out += "</g>\n";
  }
  return out;
}

std::string draw_crossings(const Chart& chart, const ChartPanel& panel, const SvgAxis& x, const SvgAxis& y) {
  std::string out;
  if (!panel.mark_zero_crossings || panel.series.empty()) return out;
  const std::vector<double>& v = panel.series.front().y;
  for (std::size_t k = 1; k < std::min(v.size(), chart.x.size()); ++k) {
    if (!std::isfinite(v[k - 1]) || !std::isfinite(v[k]) || (v[k - 1] < 0) == (v[k] < 0)) continue;
    const double at = chart.x[k - 1] + v[k - 1] / (v[k - 1] - v[k]) * (chart.x[k] - chart.x[k - 1]);
    out += fmt::format("<circle class=\"crossing\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>\n", x(at), y(0));
    out += svg_text(x(at) + 8, y(0) - 7, fmt::format("0 at {:.4g}", at), "class=\"tick\"");
  }
  return out;
}

std::string draw_panel(const Chart& chart, const ChartPanel& panel, double left, double top) {
  const SvgAxis x = horizontal(chart, left), y = vertical(panel, top);
  return draw_events(chart, x, top) + svg_text(left, top - 16, panel.title, "class=\"panel\"") +
         draw_axes(x, y, chart.x_title) + draw_lines(chart, panel, x, y, top) + draw_crossings(chart, panel, x, y);
}

std::string list_events(const Chart& chart, double top) {
  std::string out;
  const std::size_t shown = std::min(chart.events.size(), kMostEventLines);
  for (std::size_t k = 0; k < shown; ++k) {
    const ChartEvent& e = chart.events[k];
    const std::size_t row = k / kChartColumns;
    const double left = kChartMargin + kLeft + (k % kChartColumns) * panel_width(chart),
                 y = top + kLine * static_cast<double>(row);
    if (e.kind == ChartEvent::Kind::window)
      out +=
          fmt::format("<rect class=\"window\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"9\"/>\n", left - 4, y - 8);
    else
      out += event_sign(e.kind, left, y - 7.5);
    const bool more = k + 1 == shown && chart.events.size() > shown;
    out += svg_text(left + 10, y, more ? fmt::format("and {} more: see events.csv", chart.events.size() - k) : e.text,
                    "class=\"tick\"");
  }
  return out;
}

/// Of kChartColumns each.
std::size_t rows_for(std::size_t count) { return (count + kChartColumns - 1) / kChartColumns; }

constexpr const char* kStyle =
    ".title{font-size:16px;font-weight:600;fill:#111}.panel{font-size:12.5px;font-weight:600;fill:#111}"
    ".line{fill:none;stroke-width:1.8;stroke-linejoin:round}.band{fill-opacity:.16;stroke:none}"
    ".event{stroke:#777;stroke-dasharray:2 3}.sign{fill:#333}.hollow{fill:#fff;stroke:#333}.window{fill:#ddd}"
    ".crossing{fill:none;stroke:#000;stroke-width:1.5}";

}  // namespace

std::string to_svg(const Chart& chart) {
  const std::size_t shown = std::min(chart.events.size(), kMostEventLines);
  const auto rows = static_cast<double>(rows_for(chart.panels.size())), lines = static_cast<double>(rows_for(shown));
  const double width = 2 * kChartMargin + kChartColumns * panel_width(chart);
  const double height = kHeader + rows * kPanelHeight + lines * kLine + kChartMargin;
  std::string out = svg_opening(width, height, std::string(kSvgLetters) + kSvgAxesStyle + kStyle);
  out += svg_text(kChartMargin, 26, chart.title, "class=\"title\"");
  for (std::size_t k = 0; k < chart.panels.size(); ++k) {
    const std::size_t row = k / kChartColumns;
    const double left = kChartMargin + kLeft + (k % kChartColumns) * panel_width(chart);
    out += draw_panel(chart, chart.panels[k], left, kHeader + kAbovePlot + static_cast<double>(row) * kPanelHeight);
  }
  return out + list_events(chart, kHeader + rows * kPanelHeight + kLine - 4) + "</svg>\n";
}

}  // namespace genu
