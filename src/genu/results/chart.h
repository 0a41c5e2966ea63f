// Small multiples over one axis as a self-contained SVG: lines that are named at their right end, axes with round
// ticks, and marks of events through all panels. Knows nothing of joints.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace genu {

struct ChartSeries {
  std::string name;
  std::vector<double> y;         ///< one for each x of the chart; NaN interrupts the line
  std::vector<double> bar = {};  ///< how far y may be off, one for each x, drawn as a band; empty: not known
  std::string column = {};       ///< of results.csv, whose numbers y are; empty: of none
};

struct ChartPanel {
  std::string title;  ///< with the unit in brackets
  std::vector<ChartSeries> series;
  bool from_zero = false;            ///< the y axis shows 0
  bool mark_zero_crossings = false;  ///< circles where the first series changes its sign
};

struct ChartEvent {
  enum class Kind { gained, lost, window, other };
  Kind kind = Kind::other;
  double from = 0, to = 0;  ///< on the x axis; equal but for a window
  std::string text;         ///< for the list below the panels
};

struct Chart {
  std::string title, x_title;
  std::vector<double> x;
  std::vector<std::size_t> breaks = {};  ///< where in x another branch begins: no line leads there, ascending
  std::vector<ChartPanel> panels;
  std::vector<ChartEvent> events;

  bool breaks_before(std::size_t k) const;
};

/// The picture. Words are escaped, numbers have fixed decimals: the same chart gives the same bytes.
std::string to_svg(const Chart& chart);

}  // namespace genu
