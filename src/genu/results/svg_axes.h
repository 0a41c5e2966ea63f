// The axes of every chart: linear and logarithmic scales, round ticks, and the SVG of their lines and numbers.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace genu {

/// A map from values to pixels, with its ticks.
struct SvgAxis {
  struct Tick {
    double value = 0;
    std::string label;  ///< empty: a line without a number
  };
  bool logarithmic = false;
  double low = 0, high = 1;        ///< values at the ends; positive where logarithmic
  double at_low = 0, at_high = 1;  ///< pixels at the ends
  std::vector<Tick> ticks;         ///< ascending

  double operator()(double value) const;
};

/// Where an axis ends, in pixels.
struct SvgEnds {
  double at_low = 0, at_high = 1;
};

/// Ticks at round numbers (1, 2 or 5 times a power of ten), about `wanted` of them, the outer ones at or just outside
/// of [low, high]. Ends that are equal or not finite are moved apart.
std::vector<double> round_ticks(double low, double high, int wanted);

/// Ticks at powers of ten, over two decades or less also at 2 and 5 times these; the outer ones at or just outside of
/// [smallest, largest]. 0 < smallest <= largest.
std::vector<double> decade_ticks(double smallest, double largest);

/// Linear, from the first of the round ticks to the last.
SvgAxis linear_axis(double low, double high, int wanted, SvgEnds ends);

/// Linear, from `low` to `high`, with the round ticks between them.
SvgAxis linear_axis_within(double low, double high, int wanted, SvgEnds ends);

/// Logarithmic, from the first of the decade ticks to the last. Labels are at least `apart` pixels from each other; a
/// 5 gives way to the 10 after it.
SvgAxis log_axis(double smallest, double largest, SvgEnds ends, const std::function<std::string(double)>& label,
                 double apart);

/// Grid lines and numbers, `x_title` below. A linear x axis has short marks instead of grid lines.
std::string draw_axes(const SvgAxis& x, const SvgAxis& y, const std::string& x_title);

/// The classes that draw_axes() uses, for the style of the SVG.
inline constexpr const char* kSvgAxesStyle =
    ".tick{fill:#444}.grid{stroke:#e6e6e6}.zero{stroke:#9a9a9a}.axis{stroke:#444}";

}  // namespace genu
