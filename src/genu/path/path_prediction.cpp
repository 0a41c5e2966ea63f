#include "genu/path/path_prediction.h"

#include <algorithm>

#include "genu/path/tolerances.h"

namespace genu {

double path_speed(const JointModel& model, const Correction& tangent) {
  const VecX& twist = tangent.twist;
  double sum = 0;
  for (Eigen::Index i = 0; i < twist.size(); i += 6)
    sum += twist.segment<3>(i).norm() / model.scales.length + twist.segment<3>(i + 3).norm();
  return sum;
}

/// A divided difference is known as long as it is small beside the one before it, over the span. Otherwise the path is
/// nonsmooth or near a limit point, and earlier poses do not predict it.
void PathPrediction::went_on(double span, const Correction& from, const Correction& to) {
  if (!from.matches(to)) return forget();
  // Over a span of rounding length a difference is the rounding of the tangents, enlarged.
  if (span < kShortestSpan) return forget();
  if (known_ > 0 && !differences_[0].matches(to)) known_ = 0;
  for (std::size_t i = std::min(known_, kMaxDifferences - 1); i > 0; --i) behind_[i] = behind_[i - 1] - span;
  behind_[0] = -span;
  const std::size_t most = std::min(known_ + 1, kMaxDifferences);
  older_ = from;
  newer_ = to;
  double speed = std::min(path_speed(*model_, from), path_speed(*model_, to));
  for (known_ = 0; known_ < most; ++known_) {
    Correction& difference = differences_[known_];
    newer_.add(-1, older_);
    newer_.scale(-1 / behind_[known_]);
    const double next = path_speed(*model_, newer_);
    if (!(next * span <= kSmoothShare * speed)) return;
    speed = next;
    if (known_ + 1 < most) older_ = difference;
    difference = newer_;
  }
}

namespace {

/// Rotations about an axis that turns do not add as vectors. This is the next term of the Magnus series for angular
/// velocity w + t w' in the world frame from t = 0 to h, as a mean over h. `way`: of all bodies.
void add_turn_of_axis(double h, const VecX& tangent, const VecX& slope, VecX& way) {
  for (Eigen::Index i = 3; i < tangent.size(); i += 6)
    way.segment<3>(i) += h * h / 12 * slope.segment<3>(i).cross(tangent.segment<3>(i));
}

}  // namespace

bool PathPrediction::at(const State& state, const Correction& tangent, double h, State& out) {
  // Terms that grow over the step are no series: the step is much longer than what the differences were taken over.
  if (known_ == 0 || h * path_speed(*model_, differences_[0]) > path_speed(*model_, tangent))
    return retract(*model_, state, tangent, h, out);
  way_ = tangent;
  // Newton's polynomials t, t (t - t1), ...: their coefficients, and their means from 0 to h.
  std::array<double, kMaxDifferences + 1> factors{0, 1};
  for (std::size_t k = 0; k < known_; ++k) {
    if (k > 0 && h * path_speed(*model_, differences_[k]) > path_speed(*model_, differences_[k - 1])) break;
    double mean = 0, power = h;
    for (std::size_t i = 1; i <= k + 1; ++i, power *= h) mean += factors[i] * power / static_cast<double>(i + 1);
    way_.add(mean, differences_[k]);
    // The slope of the polynomial at 0 gives the turning of the tangent there.
    if (k == 0)
      newer_.twist = differences_[k].twist;
    else
      newer_.twist += factors[1] * differences_[k].twist;
    if (k + 1 == known_) break;
    for (std::size_t i = k + 2; i > 0; --i) factors[i] = factors[i - 1] - behind_[k] * factors[i];
  }
  add_turn_of_axis(h, tangent.twist, newer_.twist, way_.twist);
  return retract(*model_, state, way_, h, out);
}

}  // namespace genu
