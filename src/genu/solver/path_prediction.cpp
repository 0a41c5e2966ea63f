#include "genu/solver/path_prediction.h"

#include <algorithm>

namespace genu {

double path_speed(const JointModel& model, const Correction& tangent) {
  const VecX& twist = tangent.twist;
  double sum = 0;
  for (Eigen::Index i = 0; i < twist.size(); i += 6)
    sum += twist.segment<3>(i).norm() / model.scales.length + twist.segment<3>(i + 3).norm();
  return sum;
}

void PathPrediction::went_on(double span, const Correction& from, const Correction& to) {
  constexpr double kSmooth = 0.2;  // of the tangent, over the span: more is a kink, or the way to a limit point
  bends_ = from.matches(to);
  if (!bends_) return;
  span_ = span;
  bend_ = to;
  bend_.add(-1, from);
  bends_ = path_speed(*model_, bend_) <= kSmooth * std::min(path_speed(*model_, from), path_speed(*model_, to));
}

bool PathPrediction::at(const State& state, const Correction& tangent, double h, State& out) {
  if (!bends_) return retract(*model_, state, tangent, h, out);
  way_ = tangent;
  way_.add(0.5 * h / span_, bend_);
  return retract(*model_, state, way_, h, out);
}

}  // namespace genu
