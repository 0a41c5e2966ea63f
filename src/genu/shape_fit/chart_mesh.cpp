#include "genu/shape_fit/chart_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/shape_fit/tolerances.h"
#include "genu/surface/polynomial_surface.h"
#include "genu/surface/tessellate.h"

namespace genu {
namespace {

constexpr int kSamples = 64;  // each way, to see how steep the surface is

/// Positions of grid lines in [0, 1], closer where `stretch` (length per unit, at the middles of kSamples cells) is
/// large: none of the cells is longer than `cell`.
std::vector<double> lines(const std::vector<double>& stretch, double cell) {
  std::vector<double> length{0};  // along the steepest line, up to each sample
  for (const double s : stretch) length.push_back(length.back() + s / kSamples);
  const int count = std::max(2, static_cast<int>(std::ceil(length.back() / cell - 1e-9)));
  std::vector<double> at{0};
  std::size_t k = 0;
  for (int i = 1; i < count; ++i) {
    const double wanted = length.back() * i / count;
    while (k + 1 < stretch.size() && length[k + 1] < wanted) ++k;
    at.push_back((static_cast<double>(k) + (wanted - length[k]) / (length[k + 1] - length[k])) / kSamples);
  }
  at.push_back(1);
  return at;
}

/// About the largest curvature (1/m) along the lines of the chart and across them.
double curvature_bound(const PolynomialJet& h, bool cylindrical) {
  const double unit = cylindrical ? std::max(std::abs(h.f), 1e-9) : 1;  // m of length a unit of u, on the level
  const double a = h.x / unit, b = h.y, rise = std::sqrt(1 + a * a + b * b), u2 = 1 + a * a, v2 = 1 + b * b;
  const double around = cylindrical ? 1 / unit : 0;
  return std::max({(std::abs(h.xx) / (unit * unit) + around) / (rise * u2), std::abs(h.yy) / (rise * v2),
                   std::abs(h.xy) / (unit * rise * std::sqrt(u2 * v2)), 1e-9});
}

}  // namespace

Mesh chart_mesh(const SurfaceChart& chart, const ChartBox& box, const std::vector<PolynomialTerm>& terms, bool inside,
                double edge) {
  const Polynomial P(terms);
  std::vector<double> along_u(kSamples, 0.0), along_v(kSamples, 0.0);
  for (std::size_t i = 0; i < kSamples; ++i) {
    for (std::size_t j = 0; j < kSamples; ++j) {
      const PolynomialJet h = P(box.u0 + box.width() * (static_cast<double>(i) + 0.5) / kSamples,
                                box.v0 + box.height() * (static_cast<double>(j) + 0.5) / kSamples);
      const double finer = edge / graded_edge(edge, 1 / curvature_bound(h, chart.cylindrical));
      along_u[i] = std::max(along_u[i], finer * box.width() * std::hypot(chart.cylindrical ? h.f : 1, h.x));
      along_v[j] = std::max(along_v[j], finer * box.height() * std::hypot(1, h.y));
    }
  }
  double size_u = 0, size_v = 0;
  for (const double s : along_u) size_u += s / kSamples;
  for (const double s : along_v) size_v += s / kSamples;
  if (!std::isfinite(size_u * size_v)) return {};  // it rises beyond all numbers
  // The last: a surface as steep as a wall one way has two rows at least the other way.
  constexpr double kMaxGridLines = kMaxChartTriangles / 4.0;
  const double cell = std::max({kChartCell * edge, std::sqrt(2 * size_u * size_v / kMaxChartTriangles),
                                std::max(size_u, size_v) / kMaxGridLines});
  const std::vector<double> s = lines(along_u, cell), t = lines(along_v, cell);

  const int columns = static_cast<int>(s.size()) - 1, rows = static_cast<int>(t.size()) - 1;
  const auto coordinate = [](const std::vector<double>& at, double share, double low, double high) {
    const double place = at[static_cast<std::size_t>(std::lround(share * static_cast<double>(at.size() - 1)))];
    return place == 1 ? high : low + place * (high - low);
  };
  Mesh mesh = grid_mesh({columns, false}, {rows, false}, [&](double x, double y) {
    const double u = coordinate(s, x, box.u0, box.u1), v = coordinate(t, y, box.v0, box.v1);
    return chart.position({u, v, P.value(u, v)});
  });
  if (inside)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

}  // namespace genu
