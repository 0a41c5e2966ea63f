#include "genu/equilibrium/poses_between.h"

namespace genu {

void poses_between(const State& from, const State& to, double u, State& out) {
  for (std::size_t i = 0; i < from.poses.size(); ++i) {
    const Pose &a = from.poses[i], &b = to.poses[i];
    out.poses[i] = {exp_rotation(u * log_rotation(b.R * a.R.transpose())) * a.R, (1 - u) * a.p + u * b.p};
  }
}

}  // namespace genu
