#include "genu/judge/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

double slope_between(const Points& p, std::size_t i) {
  return (p[i + 1].second - p[i].second) / (p[i + 1].first - p[i].first);
}

double width(const Points& p, std::size_t i) { return p[i + 1].first - p[i].first; }

/// d / (a d1 + (1 - a) d2) of the paper, (6) and (7): Brodlie's weighted harmonic mean.
double inner_slope(const Points& p, std::size_t i) {
  const double left = slope_between(p, i - 1), right = slope_between(p, i);
  if (left * right <= 0) return 0;
  const double alpha = (width(p, i - 1) + 2 * width(p, i)) / (3 * (width(p, i - 1) + width(p, i)));
  return left * right / (alpha * right + (1 - alpha) * left);
}

/// The parabola's slope at the first of three points, kept from overshooting.
double end_slope(double h, double next_h, double slope, double next_slope) {
  const double m = slope + h * (slope - next_slope) / (h + next_h);
  if (m * slope <= 0) return 0;
  return slope * next_slope <= 0 && std::abs(m) > std::abs(3 * slope) ? 3 * slope : m;
}

double slope_at(const Points& p, std::size_t i) {
  const std::size_t n = p.size();
  if (n == 2) return slope_between(p, 0);
  if (i == 0) return end_slope(width(p, 0), width(p, 1), slope_between(p, 0), slope_between(p, 1));
  if (i == n - 1) return end_slope(width(p, n - 2), width(p, n - 3), slope_between(p, n - 2), slope_between(p, n - 3));
  return inner_slope(p, i);
}

}  // namespace

double curve_at(const Points& p, double x) {
  const bool positive = std::all_of(p.begin(), p.end(), [](const auto& point) { return point.second >= 0; });
  if (x <= p.front().first || x >= p.back().first) {
    const std::size_t end = x <= p.front().first ? 0 : p.size() - 1;
    const double y = p[end].second + slope_at(p, end) * (x - p[end].first);
    return positive ? std::max(0.0, y) : y;
  }
  std::size_t i = 0;
  while (x >= p[i + 1].first) ++i;
  // Hermite's basis.
  const double h = width(p, i), t = (x - p[i].first) / h, s = 1 - t;
  return p[i].second * s * s * (1 + 2 * t) + p[i + 1].second * t * t * (3 - 2 * t) +
         h * (slope_at(p, i) * t * s * s - slope_at(p, i + 1) * t * t * s);
}

double scale_at(const ScaleDef& scale, double x) {
  switch (scale.kind) {
    case ScaleDef::Kind::sine:
      if (x < scale.start) return scale.offset;
      return scale.offset + scale.amplitude * std::sin(2 * std::numbers::pi * scale.frequency * (x - scale.start));
    case ScaleDef::Kind::step: {
      if (x < scale.start) return scale.from;
      if (x >= scale.start + scale.rise) return scale.to;
      const double u = (x - scale.start) / scale.rise;
      return scale.from + (scale.to - scale.from) * (10 * std::pow(u, 3) - 15 * std::pow(u, 4) + 6 * std::pow(u, 5));
    }
    case ScaleDef::Kind::over_coordinate:
    case ScaleDef::Kind::over_time:
    case ScaleDef::Kind::feedback:
      break;
  }
  return curve_at(scale.table, std::clamp(x, scale.table.front().first, scale.table.back().first));
}

double feedback_at(const ScaleDef& scale, double x, double rate, double time, int side) {
  const double h = side * kCourseStep;
  const auto course = [&](int k) { return scale_at(*scale.target, time + k * h); };
  const double speed = scale.rate_gain == 0 ? 0 : (-3 * course(0) + 4 * course(1) - course(2)) / (2 * h);
  return scale.gain * (course(0) - x) + scale.rate_gain * (speed - rate);
}

}  // namespace genu::judge
