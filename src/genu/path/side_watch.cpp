#include "genu/path/side_watch.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "genu/model/ligament_pieces.h"
#include "genu/path/tolerances.h"

namespace genu {
namespace {

/// Whether the path may choose all its sides.
bool may_choose(const LigamentPath& path) {
  const auto& obstacles = path.obstacles();
  return !obstacles.empty() && std::none_of(obstacles.begin(), obstacles.end(), [](const auto& o) { return o.side; });
}

/// The straight line over the path's length: no way round surfaces is shorter.
double straight_share(const LigamentPath& path, const State& state) {
  Wraps free = state.wraps;
  for (std::size_t i = 0; i < path.obstacles().size(); ++i) free[path.touch_index(i)].touching = false;
  return path.length(state.poses, free) / path.length(state.poses, state.wraps);
}

/// Whether two ways touch the same surfaces with normals of one side.
bool same_way(const LigamentPath& path, const Wraps& a, const Wraps& b) {
  for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
    const WrapTouch &x = a[path.touch_index(i)], &y = b[path.touch_index(i)];
    if (x.touching != y.touching) return false;
    if (x.touching && !(x.arc.begin.n.dot(y.arc.begin.n) > 0)) return false;
  }
  return true;
}

}  // namespace

SideWatch::SideWatch(const JointModel& model) {
  if (model.reference_wraps.empty()) return;
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    if (!may_choose(path)) return;
    for (std::size_t k = 0; k < path.obstacles().size(); ++k) watched_.push_back({&path, k, name});
  });
}

bool SideWatch::seek(Watched& w, const State& state) const {
  std::vector<LigamentPath::Obstacle> obstacles = w.path->obstacles();
  const WrapTouch& touch = state.wraps[w.path->touch_index(w.surface)];
  if (!touch.touching) return false;
  obstacles[w.surface].side = WrapSide(-(touch.arc.begin.n + touch.arc.end.n));
  LigamentPath opposite = *w.path;
  opposite.set_obstacles(std::move(obstacles), w.path->touch_index(0));
  w.other = state.wraps;
  return opposite.find_touches(state.poses, w.other) && w.path->is_shortest(state.poses, w.other) &&
         !same_way(*w.path, state.wraps, w.other);
}

bool SideWatch::carry(std::size_t i, const State& state) {
  Watched& w = watched_[i];
  if (w.known) {
    for (std::size_t k = 0; k < w.path->obstacles().size(); ++k) w.other[w.path->touch_index(k)].by_length = true;
    w.known = w.path->follow_touches(state.poses, w.other) && w.path->is_shortest(state.poses, w.other) &&
              !same_way(*w.path, state.wraps, w.other);
  }
  const double share = straight_share(*w.path, state);
  w.sought_at = std::max(w.sought_at, share);
  if (w.known || !(share < 1 - kShorterShare) || !(share < w.sought_at - kSidesSoughtAgain)) return w.known;
  w.sought_at = share;
  w.known = seek(w, state);
  return w.known;
}

double SideWatch::excess(std::size_t i, const State& state) const {
  const Watched& w = watched_[i];
  Wraps other = w.other;
  for (std::size_t k = 0; k < w.path->obstacles().size(); ++k) other[w.path->touch_index(k)].by_length = true;
  if (!w.path->follow_touches(state.poses, other)) return std::numeric_limits<double>::quiet_NaN();
  return 1 - kShorterShare - w.path->length(state.poses, other) / w.path->length(state.poses, state.wraps);
}

std::string SideWatch::what(std::size_t i) const {
  const Watched& w = watched_[i];
  return w.name + " round " + w.path->obstacles()[w.surface].name + ": 1 % shorter round the other side";
}

}  // namespace genu
