#include "studies/driven_curve.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace genu::studies {
namespace {

constexpr double kFrequency = 0.125, kStart = 1, kPeriod = 1 / kFrequency;  // Hz, s: of the drive
constexpr double kSecond = kStart + kPeriod;                                // s: when its second period begins

/// Amplitudes of the first three harmonics by least squares from `first` on.
std::vector<double> harmonics_of(const DrivenCurve& c, std::size_t first) {
  const auto n = static_cast<Eigen::Index>(c.time.size() - first);
  MatX columns(n, 7);
  VecX angle(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = first + static_cast<std::size_t>(i);
    const double phase = 2 * M_PI * kFrequency * (c.time[row] - kStart);
    columns(i, 0) = 1;
    for (Eigen::Index k = 1; k <= 3; ++k) {
      columns(i, 2 * k - 1) = std::sin(static_cast<double>(k) * phase);
      columns(i, 2 * k) = std::cos(static_cast<double>(k) * phase);
    }
    angle[i] = c.angle[row];
  }
  const VecX x = columns.householderQr().solve(angle);
  return {std::hypot(x[1], x[2]), std::hypot(x[3], x[4]), std::hypot(x[5], x[6])};
}

}  // namespace

void measure(DrivenCurve& c) {
  const auto first =
      static_cast<std::size_t>(std::lower_bound(c.time.begin(), c.time.end(), kSecond - 1e-9) - c.time.begin());
  c.complete = c.time.size() > first + 7;
  if (!c.complete) return;
  c.harmonics = harmonics_of(c, first);
  const auto [least, most] = std::minmax_element(c.angle.begin() + static_cast<std::ptrdiff_t>(first), c.angle.end());
  for (std::size_t row = first + 1; row + 1 < c.time.size(); ++row)
    c.steepest =
        std::max(c.steepest, std::abs(c.angle[row + 1] - c.angle[row - 1]) / (c.time[row + 1] - c.time[row - 1]));
  c.steepest /= M_PI * kFrequency * (*most - *least);
}

}  // namespace genu::studies
