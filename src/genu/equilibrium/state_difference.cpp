#include "genu/equilibrium/state_difference.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/equilibrium/piece_changes.h"

namespace genu {
namespace {

double translation(const Pose& a, const Pose& b) { return (b.p - a.p).norm(); }
double rotation(const Pose& a, const Pose& b) { return log_rotation(b.R * a.R.transpose()).norm(); }

}  // namespace

double distance(const JointModel& model, const State& a, const State& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    sum += translation(a.poses[i], b.poses[i]) / model.scales.length + rotation(a.poses[i], b.poses[i]);
  return sum;
}

std::pair<double, double> largest_motion(const State& from, const State& to) {
  std::pair<double, double> out{0, 0};
  for (std::size_t i = 0; i < from.poses.size(); ++i) {
    out.first = std::max(out.first, translation(from.poses[i], to.poses[i]));
    out.second = std::max(out.second, rotation(from.poses[i], to.poses[i]));
  }
  return out;
}

std::vector<std::pair<PathEvent::Kind, std::string>> changes(const JointModel& model, const State& before,
                                                             const State& after) {
  std::vector<std::pair<PathEvent::Kind, std::string>> out;
  const auto add = [&](const State& from, const State& to, PathEvent::Kind kind) {
    for (const ActiveContact& c : to.contacts)
      if (!contains(from, c))
        out.emplace_back(kind, fmt::format("{}.{}", model.pairs[static_cast<std::size_t>(c.pair)].name, c.number));
  };
  add(before, after, PathEvent::Kind::contact_gained);
  add(after, before, PathEvent::Kind::contact_lost);
  for (auto& event : piece_events(model, before, after)) out.push_back(std::move(event));
  return out;
}

}  // namespace genu
