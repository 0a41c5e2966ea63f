#include "genu/appraise/shorter_sides.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/appraise/tolerances.h"
#include "genu/core/units.h"
#include "genu/model/ligament_pieces.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

/// Whether the path may choose its sides, and touches a surface.
bool chose(const LigamentPath& path, const State& state) {
  bool touches = false;
  for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
    if (path.obstacles()[i].side) return false;
    touches = touches || state.wraps[path.touch_index(i)].touching;
  }
  return touches;
}

/// m: over the path's own points, which no way round surfaces is shorter than.
double straight_length(const LigamentPath& path, const State& state) {
  Wraps free = state.wraps;
  for (std::size_t i = 0; i < path.obstacles().size(); ++i) free[path.touch_index(i)].touching = false;
  return path.length(state.poses, free);
}

}  // namespace

std::vector<std::string> shorter_sides(const JointModel& model, const std::vector<PoseRecord>& records) {
  std::vector<std::string> out;
  if (model.reference_wraps.empty()) return out;
  const std::size_t every = records.size() / kRowsForSides + 1;
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    for (std::size_t row = 0; row < records.size(); row += every) {
      const State& state = records[row].point.pose.state;
      if (state.wraps.size() != model.reference_wraps.size() || !chose(path, state)) continue;
      const double here = path.length(state.poses, state.wraps), enough = (1 - kShorterShare) * here;
      if (!(straight_length(path, state) < enough)) continue;
      Wraps other = state.wraps;
      if (!path.find_touches(state.poses, other)) continue;
      const double there = path.length(state.poses, other);
      if (!(there < enough)) continue;
      out.push_back(fmt::format(
          "Round another side of {} {} would be {:.3g} mm shorter in row {} ({:.4g} mm). It keeps "
          "the side on which it began; give its `side` if you mean the other.",
          path.obstacles().front().name, name, to::kMillimetre * (here - there), row + 1, to::kMillimetre * here));
      break;
    }
  });
  return out;
}

}  // namespace genu
