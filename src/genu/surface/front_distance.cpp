#include "genu/surface/front_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "genu/surface/tolerances.h"

namespace genu {
namespace {

double binomial(int n, int k) {
  double b = 1;
  for (int i = 1; i <= k; ++i) b = b * (n - k + i) / i;
  return b;
}

/// Power coefficients of a polynomial of x in [from, from + width] to Bernstein coefficients, in place: `stride` apart.
void to_bernstein(double* c, int degree, std::size_t stride, double from, double width) {
  const auto a = [&](int i) -> double& { return c[static_cast<std::size_t>(i) * stride]; };
  for (int i = 0; i < degree; ++i)  // Taylor shift to `from`
    for (int j = degree - 1; j >= i; --j) a(j) += from * a(j + 1);
  double scale = 1;
  for (int i = 0; i <= degree; ++i, scale *= width) a(i) *= scale / binomial(degree, i);
  for (int i = 1; i <= degree; ++i)
    for (int j = degree; j >= i; --j) a(j) += a(j - 1);
}

std::vector<PolynomialTerm> derivative(const std::vector<PolynomialTerm>& terms, bool by_first) {
  std::vector<PolynomialTerm> out;
  for (const PolynomialTerm& t : terms) {
    const int power = by_first ? t.i : t.j;
    if (power > 0) out.push_back({t.i - (by_first ? 1 : 0), t.j - (by_first ? 0 : 1), power * t.c});
  }
  return out;
}

/// The range over the patch, in cells: the smaller, the nearer to the true one.
std::pair<double, double> range_over(const std::vector<PolynomialTerm>& terms, const ChartBox& patch) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const double du = patch.width() / kFrontCells, dv = patch.height() / kFrontCells;
  for (int i = 0; i < kFrontCells; ++i)
    for (int j = 0; j < kFrontCells; ++j) {
      const double u = patch.u0 + i * du, v = patch.v0 + j * dv;
      const auto cell = polynomial_range(terms, {u, u + du, v, v + dv});
      range = {std::min(range.first, cell.first), std::max(range.second, cell.second)};
    }
  return range;
}

double largest(const std::pair<double, double>& range) { return std::max(-range.first, range.second); }

}  // namespace

std::pair<double, double> polynomial_range(const std::vector<PolynomialTerm>& terms, const ChartBox& box) {
  int n = 0, m = 0;
  for (const PolynomialTerm& t : terms) n = std::max(n, t.i), m = std::max(m, t.j);
  const auto columns = static_cast<std::size_t>(m + 1);
  std::vector<double> c(static_cast<std::size_t>(n + 1) * columns, 0.0);
  for (const PolynomialTerm& t : terms)
    c[static_cast<std::size_t>(t.i) * columns + static_cast<std::size_t>(t.j)] += t.c;
  for (std::size_t j = 0; j < columns; ++j) to_bernstein(c.data() + j, n, columns, box.u0, box.width());
  for (int i = 0; i <= n; ++i)
    to_bernstein(c.data() + static_cast<std::size_t>(i) * columns, m, 1, box.v0, box.height());
  const auto [least, most] = std::minmax_element(c.begin(), c.end());
  return {*least, *most};
}

FrontDistance::FrontDistance(const SurfaceChart& chart, const ChartBox& patch, const std::vector<PolynomialTerm>& terms,
                             bool inside)
    : chart_(chart), patch_(patch), P_(terms), side_(inside ? -1 : 1) {
  const double along_u = largest(range_over(derivative(terms, true), patch)),
               along_v = largest(range_over(derivative(terms, false), patch));
  if (!chart.cylindrical) {
    slope_ = along_u * along_u + along_v * along_v;
    return;
  }
  const double least = range_over(terms, patch).first, half = 0.5 * patch.width();
  usable_ = !inside && least > 0 && patch.width() <= std::numbers::pi;
  if (!usable_) return;
  const double arc = half / std::sin(half);
  slope_ = along_v * along_v;
  around_ = arc * arc * along_u * along_u / least;
}

double FrontDistance::operator()(const Vec3& x) const {
  if (!usable_) return 0;
  const ChartPoint c = chart_.coordinates(x);
  const double u = std::clamp(c.u, patch_.u0, patch_.u1), v = std::clamp(c.v, patch_.v0, patch_.v1);
  if (chart_.cylindrical && u != c.u) return 0;
  const double height = side_ * (c.h - P_.value(u, v));
  if (!(height > 0)) return 0;
  return height / std::sqrt(1 + slope_ + (chart_.cylindrical ? around_ / c.h : 0));
}

}  // namespace genu
