#include "genu/law/monotone_table.h"

#include <algorithm>
#include <cmath>

namespace genu {

namespace {

/// Slope at an inner point from the secants on both sides: their weighted harmonic mean, 0 at an extremum.
double inner_slope(double h_left, double h_right, double secant_left, double secant_right) {
  if (!(secant_left * secant_right > 0)) return 0;
  const double w_left = h_left + 2 * h_right, w_right = 2 * h_left + h_right;
  return (w_left + w_right) / (w_left / secant_left + w_right / secant_right);
}

/// Slope at an end: the parabola's through three points, limited so that the first interval stays monotone.
double end_slope(double h, double h_next, double secant, double secant_next) {
  const double slope = ((2 * h + h_next) * secant - h * secant_next) / (h + h_next);
  if (!(slope * secant > 0)) return 0;
  if (secant * secant_next <= 0 && std::abs(slope) > 3 * std::abs(secant)) return 3 * secant;
  return slope;
}

}  // namespace

std::optional<MonotoneTable> MonotoneTable::make(const std::vector<std::pair<double, double>>& points,
                                                 std::string& why) {
  const std::size_t n = points.size();
  if (n < 2) {
    why = "a table needs at least two points";
    return std::nullopt;
  }
  MonotoneTable table;
  for (const auto& [x, y] : points) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
      why = "a table's numbers must be finite";
      return std::nullopt;
    }
    if (!table.knots_.empty() && !(x > table.knots_.back().x)) {
      why = "the first numbers of a table's points must strictly increase";
      return std::nullopt;
    }
    table.knots_.push_back({x, y, 0, 0});
    table.nonnegative_ = table.nonnegative_ && y >= 0;
  }
  auto& k = table.knots_;
  std::vector<double> h(n - 1), secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = k[i + 1].x - k[i].x;
    secant[i] = (k[i + 1].y - k[i].y) / h[i];
  }
  for (std::size_t i = 1; i + 1 < n; ++i) k[i].slope = inner_slope(h[i - 1], h[i], secant[i - 1], secant[i]);
  k.front().slope = n == 2 ? secant[0] : end_slope(h[0], h[1], secant[0], secant[1]);
  k.back().slope = n == 2 ? secant[0] : end_slope(h[n - 2], h[n - 3], secant[n - 2], secant[n - 3]);
  for (std::size_t i = 0; i + 1 < n; ++i) k[i + 1].integral = cubic(k[i], k[i + 1], k[i + 1].x).integral;
  return table;
}

MonotoneTable::Value MonotoneTable::evaluate(double x) const {
  if (x <= knots_.front().x) return straight_from(knots_.front(), x);
  if (x >= knots_.back().x) return straight_from(knots_.back(), x);
  const auto right =
      std::upper_bound(knots_.begin(), knots_.end(), x, [](double at, const Knot& knot) { return at < knot.x; });
  return cubic(*(right - 1), *right, x);
}

std::optional<double> MonotoneTable::first_rise_through(double y) const {
  const Knot& first = knots_.front();
  const Knot& last = knots_.back();
  if (y < first.y) {
    if (!(first.slope > 0) || (nonnegative_ && y < 0)) return std::nullopt;
    return first.x + (y - first.y) / first.slope;
  }
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i)
    if (knots_[i].y <= y && y < knots_[i + 1].y) return solve(knots_[i], knots_[i + 1], y);
  if (y >= last.y && last.slope > 0) return last.x + (y - last.y) / last.slope;
  for (auto knot = knots_.rbegin(); knot != knots_.rend(); ++knot)
    if (knot->y == y) return knot->x;
  return std::nullopt;
}

std::optional<double> MonotoneTable::zero_until() const {
  const Knot& first = knots_.front();
  if (!nonnegative_) return std::nullopt;
  if (first.y > 0) return first.slope > 0 ? std::optional(first.x - first.y / first.slope) : std::nullopt;
  std::size_t i = 0;
  while (i + 1 < knots_.size() && knots_[i + 1].y == 0) ++i;
  return knots_[i].x;
}

std::optional<double> MonotoneTable::zero_from() const {
  const Knot& last = knots_.back();
  if (!nonnegative_) return std::nullopt;
  if (last.y > 0) return last.slope < 0 ? std::optional(last.x - last.y / last.slope) : std::nullopt;
  std::size_t i = knots_.size() - 1;
  while (i > 0 && knots_[i - 1].y == 0) --i;
  return knots_[i].x;
}

MonotoneTable::Value MonotoneTable::straight_from(const Knot& knot, double x) const {
  double d = x - knot.x;
  Value v{knot.y + knot.slope * d, knot.slope, 0, 0};
  if (nonnegative_ && v.y <= 0 && d != 0) {
    v.y = v.slope = 0;
    d = knot.y > 0 ? -knot.y / knot.slope : 0;  // the line has area as far as its zero
  }
  v.integral = knot.integral + d * (knot.y + knot.slope * d / 2);
  return v;
}

MonotoneTable::Value MonotoneTable::cubic(const Knot& left, const Knot& right, double x) {
  const double h = right.x - left.x, d = x - left.x;
  const double secant = (right.y - left.y) / h;
  // y = y0 + m0 d + c2 d^2 + c3 d^3
  const double c2 = (3 * secant - 2 * left.slope - right.slope) / h;
  const double c3 = (left.slope + right.slope - 2 * secant) / (h * h);
  return {left.y + d * (left.slope + d * (c2 + d * c3)), left.slope + d * (2 * c2 + 3 * d * c3),
          left.integral + d * (left.y + d * (left.slope / 2 + d * (c2 / 3 + d * c3 / 4))), 2 * c2 + 6 * d * c3};
}

double MonotoneTable::solve(const Knot& left, const Knot& right, double y) {
  if (left.y == y) return left.x;
  double low = left.x, high = right.x, x = low + (high - low) * (y - left.y) / (right.y - left.y);
  // Newton inside a bracket that always shrinks; bisection alone would end within 64 steps.
  for (int i = 0; i < 100; ++i) {
    const Value v = cubic(left, right, x);
    if (v.y == y) return x;
    (v.y < y ? low : high) = x;
    const double newton = x - (v.y - y) / v.slope;
    const double next = newton > low && newton < high ? newton : low + (high - low) / 2;
    if (next == x) return x;
    x = next;
  }
  return x;
}

}  // namespace genu
