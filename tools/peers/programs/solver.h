// What the programs share: the springs' law and the walk from pose to pose.
#pragma once

#include "../exchange.h"

namespace genu::peers {

struct SpringValue {
  double force = 0;   ///< N, positive in tension
  double energy = 0;  ///< J
};

/// F = K e^2 in tension (Wismans 1980).
inline SpringValue evaluate(const Spring& spring, double length) {
  const double stretch = length - spring.slack_length, e = stretch / spring.slack_length;
  if (e <= 0) return {};
  return {spring.stiffness * e * e, spring.stiffness * e * e * stretch / 3};
}

/// Every pose from the one before it: solver.go_to(flexion) says whether it arrived and is timed, solver.tell(pose) is
/// not.
template <typename Solver>
FoundPath follow(const Knee& knee, Solver& solver) {
  FoundPath path;
  for (const double flexion : knee.flexions) {
    FoundPose& pose = path.poses.emplace_back();
    const double before = processor_seconds();
    pose.settled = solver.go_to(flexion);
    path.seconds += processor_seconds() - before;
    solver.tell(pose);
  }
  return path;
}

inline std::string folder_of(const std::string& file) { return file.substr(0, file.find_last_of('/')); }

}  // namespace genu::peers
