#include "genu/appraise/jumps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/place.h"
#include "genu/appraise/tolerances.h"
#include "genu/core/units.h"

namespace genu {
namespace {

/// Of the joint that moved most: m and rad, by its coordinates.
struct Motion {
  double distance = 0, angle = 0;
};

Motion between(const PathEvent& from, const PathEvent& to) {
  Motion most;
  for (std::size_t j = 0; j < std::min(from.coordinates.size(), to.coordinates.size()); ++j) {
    const auto change = [&](std::size_t i) { return to.coordinates[j][i] - from.coordinates[j][i]; };
    most.distance = std::max(most.distance, std::hypot(change(3), change(4), change(5)));
    for (std::size_t i = 0; i < 3; ++i) most.angle = std::max(most.angle, std::abs(change(i)));
  }
  return most;
}

using Events = std::vector<PathEvent>;

/// Where a jump that begins at `from` ends, if that is known.
Events::const_iterator landing(const Events& events, Events::const_iterator from) {
  if (from->kind == PathEvent::Kind::jump) return events.end();
  return std::find_if(from + 1, events.end(), [](const PathEvent& e) { return e.kind == PathEvent::Kind::new_branch; });
}

std::string sentence(const Prepared& prepared, const Events& events, Events::const_iterator from, int branch) {
  const auto to = landing(events, from);
  std::string how;
  if (to != events.end()) {
    const Motion motion = between(*from, *to);
    how = fmt::format(" {:.1f} mm / {:.1f} deg", to::kMillimetre * motion.distance, to::kDegree * motion.angle);
  }
  return fmt::format("the joint jumped{} at {}; the poses after that belong to another position (branch {})", how,
                     place(prepared, from->step, from->target), branch);
}

}  // namespace

std::vector<std::string> jump_sentences(const Prepared& prepared, const Events& events) {
  std::vector<std::string> out;
  int branch = 1;
  for (auto e = events.begin(); e != events.end(); ++e) {
    if (!e->begins_branch()) continue;
    if (++branch <= kJumpsTold + 1) out.push_back(sentence(prepared, events, e, branch));
  }
  if (branch > kJumpsTold + 1) out.push_back(fmt::format("the joint jumped {} times in all", branch - 1));
  return out;
}

}  // namespace genu
