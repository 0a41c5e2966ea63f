#include "genu/results/svg_axes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/svg_text.h"

namespace genu {
namespace {

/// Between the first two ticks.
double step_of(const std::vector<double>& ticks) { return ticks.size() > 1 ? ticks[1] - ticks[0] : 1; }

/// A round number as short as it is exact.
std::string tick_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  if (decimals > 6 || std::abs(value) >= 1e7) return fmt::format("{:.4g}", value);
  return fmt::format("{:.{}f}", std::abs(value) < 0.5 * step ? 0.0 : value, decimals);
}

SvgAxis linear(double low, double high, const std::vector<double>& ticks, SvgEnds ends) {
  SvgAxis axis{false, low, high, ends.at_low, ends.at_high, {}};
  for (const double t : ticks) axis.ticks.push_back({t, tick_text(t, step_of(ticks))});
  return axis;
}

bool is_zero(const SvgAxis& axis, double tick) {
  if (axis.logarithmic) return false;
  const double step = axis.ticks.size() > 1 ? axis.ticks[1].value - axis.ticks[0].value : 1;
  return std::abs(tick) < 0.5 * step;
}

}  // namespace

double SvgAxis::operator()(double value) const {
  const double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return at_low + share * (at_high - at_low);
}

std::vector<double> round_ticks(double low, double high, int wanted) {
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
  const double middle = 0.5 * (low + high), least = std::max(1e-3, 1e-6 * std::abs(middle));
  if (high - low < least) low = middle - least, high = middle + least;
  const double raw = (high - low) / std::max(1, wanted), power = std::pow(10, std::floor(std::log10(raw)));
  const double ratio = raw / power;
  const double step = power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> ticks;
  for (double k = first; k <= last; ++k) ticks.push_back(k * step);
  return ticks;
}

std::vector<double> decade_ticks(double smallest, double largest) {
  constexpr double kFewDecades = 100;
  const int low = static_cast<int>(std::floor(std::log10(smallest))),
            high = std::max(low + 1, static_cast<int>(std::ceil(std::log10(largest))));
  std::vector<double> ticks;
  for (int k = low; k <= high; ++k)
    for (const double times : {1.0, 2.0, 5.0}) {
      if (times > 1 && (k == high || largest > kFewDecades * smallest)) continue;
      ticks.push_back(times * std::pow(10.0, k));
    }
  // No empty stretch at either end.
  while (ticks.size() > 2 && ticks[1] <= smallest) ticks.erase(ticks.begin());
  while (ticks.size() > 2 && ticks[ticks.size() - 2] >= largest) ticks.pop_back();
  return ticks;
}

SvgAxis linear_axis(double low, double high, int wanted, SvgEnds ends) {
  const std::vector<double> ticks = round_ticks(low, high, wanted);
  return linear(ticks.front(), ticks.back(), ticks, ends);
}

SvgAxis linear_axis_within(double low, double high, int wanted, SvgEnds ends) {
  if (!(high > low)) return linear_axis(low, high, wanted, ends);
  std::vector<double> ticks = round_ticks(low, high, wanted);
  const double slack = 1e-9 * (high - low);
  std::erase_if(ticks, [&](double t) { return t < low - slack || t > high + slack; });
  return linear(low, high, ticks, ends);
}

SvgAxis log_axis(double smallest, double largest, SvgEnds ends, const std::function<std::string(double)>& label,
                 double apart) {
  const std::vector<double> ticks = decade_ticks(smallest, largest);
  SvgAxis axis{true, ticks.front(), ticks.back(), ends.at_low, ends.at_high, {}};
  const auto distance = [&](std::size_t i, std::size_t j) { return std::abs(axis(ticks[i]) - axis(ticks[j])); };
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const bool has_both = i > 0 && i + 1 < ticks.size();
    const bool before_ten = has_both && distance(i, i + 1) < apart && distance(i - 1, i) > 1.1 * distance(i, i + 1);
    const bool room = i == 0 || distance(labelled, i) >= apart;
    if (room && !before_ten) labelled = i;
    axis.ticks.push_back({ticks[i], room && !before_ten ? label(ticks[i]) : ""});
  }
  return axis;
}

std::string draw_axes(const SvgAxis& x, const SvgAxis& y, const std::string& x_title) {
  constexpr double kMark = 4, kBeside = 6, kBelowAxis = 16, kBelowNumbers = 31;  // pixels off the axis
  constexpr double kHalfLetter = 3.5;
  const double bottom = y.at_low;
  std::string out;
  for (const SvgAxis::Tick& t : y.ticks) {
    out += svg_line(x.at_low, y(t.value), x.at_high, y(t.value), is_zero(y, t.value) ? "zero" : "grid");
    if (!t.label.empty())
      out += svg_text(x.at_low - kBeside, y(t.value) + kHalfLetter, t.label, "class=\"tick\" text-anchor=\"end\"");
  }
  for (const SvgAxis::Tick& t : x.ticks) {
    const double at = x(t.value);
    if (x.logarithmic) out += svg_line(at, bottom, at, y.at_high, "grid");
    out += svg_line(at, bottom, at, bottom + kMark, "axis");
    if (!t.label.empty()) out += svg_text(at, bottom + kBelowAxis, t.label, "class=\"tick\" text-anchor=\"middle\"");
  }
  out += svg_line(x.at_low, bottom, x.at_high, bottom, "axis");
  return out + svg_text(0.5 * (x.at_low + x.at_high), bottom + kBelowNumbers, x_title,
                        "class=\"tick\" text-anchor=\"middle\"");
}

}  // namespace genu
