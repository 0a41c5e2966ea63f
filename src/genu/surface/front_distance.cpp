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

constexpr std::size_t kFrontCount = kFrontCells;

ChartBox cell_of(const ChartBox& patch, std::size_t i, std::size_t j) {
  const double du = patch.width() / kFrontCells, dv = patch.height() / kFrontCells;
  const double u = patch.u0 + static_cast<double>(i) * du, v = patch.v0 + static_cast<double>(j) * dv;
  return {u, u + du, v, v + dv};
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
    : chart_(chart),
      patch_(patch),
      P_(terms),
      side_(inside ? -1 : 1),
      end_u0_(std::remainder(patch.u0, 2 * std::numbers::pi)),
      end_u1_(std::remainder(patch.u1, 2 * std::numbers::pi)),
      near_(kFrontCount * kFrontCount),
      cell_u_(patch.width() / kFrontCells),
      cell_v_(patch.height() / kFrontCells) {
  if (chart.cylindrical) {
    least_radius_ = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kFrontCount * kFrontCount; ++k)
      least_radius_ =
          std::min(least_radius_, polynomial_range(terms, cell_of(patch, k / kFrontCount, k % kFrontCount)).first);
    usable_ = !inside && least_radius_ > 0 && patch.width() <= std::numbers::pi;
    if (!usable_) return;
    const double half = 0.5 * patch.width();
    arc_ = half / std::sin(half);
  }
  const auto by_u = derivative(terms, true), by_v = derivative(terms, false);
  for (std::size_t i = 0; i < kFrontCount; ++i)
    for (std::size_t j = 0; j < kFrontCount; ++j) {
      const ChartBox cell = cell_of(patch, i, j);
      const double u = largest(polynomial_range(by_u, cell)), v = largest(polynomial_range(by_v, cell));
      const Slopes own =
          chart.cylindrical ? Slopes{v * v, arc_ * arc_ * u * u / least_radius_} : Slopes{u * u + v * v, 0};
      const auto raise = [&](Slopes& s) { s = {std::max(s.along, own.along), std::max(s.around, own.around)}; };
      raise(whole_);
      for (std::size_t a = i == 0 ? 0 : i - 1; a <= std::min(i + 1, kFrontCount - 1); ++a)
        for (std::size_t b = j == 0 ? 0 : j - 1; b <= std::min(j + 1, kFrontCount - 1); ++b)
          raise(near_[a * kFrontCount + b]);
    }
}

double FrontDistance::bound(double height, const Slopes& slopes, double rho) const {
  return height / std::sqrt(1 + slopes.along + (chart_.cylindrical ? slopes.around / rho : 0));
}

/// Of a point beside the patch to the sides that bound it: planes, between which the patch and what is over it lie.
double FrontDistance::beside(const ChartPoint& c, double u, double v) const {
  const double across = std::abs(c.v - v);
  if (u == c.u) return across;
  if (!chart_.cylindrical) return std::max(across, std::abs(c.u - u));
  const auto apart = [&](double end) {  // both angles are within half a turn
    const double direct = std::abs(c.u - end);
    return std::min(direct, 2 * std::numbers::pi - direct);
  };
  const double angle = std::min(apart(end_u0_), apart(end_u1_));
  return std::max(across, angle < std::numbers::pi / 2 ? c.h * std::sin(angle) : c.h);
}

double FrontDistance::operator()(const Vec3& x) const {
  if (!usable_) return 0;
  const ChartPoint c = chart_.coordinates(x);
  const double u = std::clamp(c.u, patch_.u0, patch_.u1), v = std::clamp(c.v, patch_.v0, patch_.v1);
  const double aside = beside(c, u, v);
  if (chart_.cylindrical && u != c.u) return aside;
  const double height = side_ * (c.h - P_.value(u, v));
  if (!(height > 0)) return aside;
  const auto cell = [](double offset, double width) {
    return std::min(static_cast<std::size_t>(offset / width), kFrontCount - 1);
  };
  const Slopes& near = near_[cell(u - patch_.u0, cell_u_) * kFrontCount + cell(v - patch_.v0, cell_v_)];
  // No nearer than this is the patch beyond the cells around.
  const double beyond_u = chart_.cylindrical ? cell_u_ * std::sqrt(c.h * least_radius_) / arc_ : cell_u_;
  const double beyond = std::min(beyond_u, cell_v_);
  return std::max({aside, bound(height, whole_, c.h), std::min(bound(height, near, c.h), beyond)});
}

}  // namespace genu
