#include "genu/results/coverage_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "genu/results/svg_text.h"

namespace genu {
namespace {

constexpr double kMapMargin = 16, kPixels = 7, kTitle = 34, kBelowMap = 30, kLegend = 48;  // kPixels: for each mm
constexpr int kMapColumns = 2;

/// From blue through white to red, -1 .. 1.
std::string colour(double share) {
  constexpr std::array<double, 3> blue{33, 102, 172}, red{178, 24, 43};
  const std::array<double, 3>& end = share < 0 ? blue : red;
  const double s = std::min(1.0, std::abs(share));
  std::array<int, 3> c{};
  for (std::size_t k = 0; k < 3; ++k) c[k] = static_cast<int>(std::lround(255 + s * (end[k] - 255)));
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

struct Extent {
  Vec2 low, high;
};

Extent extent_of(const CoverageMap& map) {
  Extent e{map.low, map.high};
  for (const auto& s : map.samples) e = {e.low.cwiseMin(s.at), e.high.cwiseMax(s.at)};
  return e;
}

/// Samples in square cells: the mean distance in each, or none where no patch is.
struct MapSquare {
  double sum = 0;
  int on = 0;
};

void draw_cells(const CoverageMap& map, const Extent& extent, const Vec2& at, double scale, std::string& out) {
  const double size = std::max(1.5, 1.5 * map.spacing);
  std::map<std::pair<int, int>, MapSquare> cells;
  for (const auto& s : map.samples) {
    MapSquare& cell =
        cells[{static_cast<int>(std::floor(s.at.x() / size)), static_cast<int>(std::floor(s.at.y() / size))}];
    if (!s.distance) continue;
    cell.sum += *s.distance;
    ++cell.on;
  }
  for (const auto& [index, cell] : cells) {
    const double x = at.x() + kPixels * (index.first * size - extent.low.x()),
                 y = at.y() + kPixels * (extent.high.y() - (index.second + 1) * size);
    const std::string fill = cell.on == 0 ? "#cccccc" : colour(cell.sum / cell.on / scale);
    fmt::format_to(std::back_inserter(out),
                   "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
                   kPixels * size, kPixels * size, fill);
  }
}

void draw(const CoverageMap& map, const Extent& extent, const Vec2& corner, double scale, std::string& out) {
  const Vec2 at(corner.x(), corner.y() + kTitle);
  const auto x = [&](double u) { return at.x() + kPixels * (u - extent.low.x()); };
  const auto y = [&](double v) { return at.y() + kPixels * (extent.high.y() - v); };
  out += svg_text(at.x(), corner.y() + 14, map.title, "class=\"t\"");
  draw_cells(map, extent, at, scale, out);
  out +=
      fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"p\"/>\n", x(map.low.x()),
                  y(map.high.y()), kPixels * (map.high.x() - map.low.x()), kPixels * (map.high.y() - map.low.y()));
  for (const Vec2& c : map.contacts)
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>\n", x(c.x()), y(c.y()));
  out += svg_text(at.x(), y(extent.low.y()) + 16, "across: " + map.u_title + "; up: " + map.v_title);
}

/// A round number no smaller than the distance that one sample in fifty exceeds.
double colour_scale(const std::vector<CoverageMap>& maps) {
  std::vector<double> sizes;
  for (const CoverageMap& map : maps)
    for (const auto& s : map.samples)
      if (s.distance) sizes.push_back(std::abs(*s.distance));
  if (sizes.empty()) return 1;
  std::sort(sizes.begin(), sizes.end());
  const double wanted = std::max(1e-6, sizes[sizes.size() - 1 - sizes.size() / 50]);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= wanted) return factor * power;
  return 10 * power;
}

}  // namespace

std::string coverage_svg(const std::vector<CoverageMap>& maps) {
  std::vector<Extent> extents;
  double width = 200;  // of a panel
  for (const CoverageMap& map : maps) {
    extents.push_back(extent_of(map));
    width = std::max({width, kPixels * (extents.back().high.x() - extents.back().low.x()),
                      6.6 * static_cast<double>(map.title.size())});
  }
  std::vector<double> heights;  // of rows
  for (std::size_t k = 0; k < maps.size(); ++k) {
    if (k % kMapColumns == 0) heights.push_back(0);
    const double own = kTitle + kPixels * (extents[k].high.y() - extents[k].low.y()) + kBelowMap;
    heights.back() = std::max(heights.back(), own);
  }
  double total = kMapMargin + kLegend;
  for (const double h : heights) total += h + kMapMargin;
  const double scale = colour_scale(maps), all = 2 * kMapMargin + kMapColumns * (width + kMapMargin);
  std::string out = svg_opening(all, total,
                                "text{font:11px sans-serif;fill:#222}.t{font-weight:bold;font-size:12px}"
                                ".p{fill:none;stroke:#000;stroke-width:1.5}");
  double top = kMapMargin;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const double left = kMapMargin + static_cast<double>(k % kMapColumns) * (width + kMapMargin);
    draw(maps[k], extents[k], Vec2(left, top), scale, out);
    if (k % kMapColumns == kMapColumns - 1) top += heights[k / kMapColumns] + kMapMargin;
  }
  const double y = total - kLegend;
  for (int k = -10; k <= 10; ++k)
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"10\" fill=\"{}\"/>\n",
                       kMapMargin + 9 * (k + 10), y, colour(k / 10.0));
  out += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\">mesh {:g} mm below .. {:g} mm above the fitted surface; grey: mesh "
      "without a patch; frame: patch; dots: contacts</text>\n",
      kMapMargin, y + 24, scale, scale);
  return out + "</svg>\n";
}

}  // namespace genu
