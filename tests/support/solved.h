// Scenes solved and walked, for the tests of the solver. Every pose of a walk that is called ok is judged.
#pragma once

#include <string>
#include <vector>

#include "genu/equilibrium/pair_gaps.h"
#include "genu/path/path.h"
#include "genu/results/pose_table.h"
#include "support/judged_table.h"
#include "support/scene_model.h"

namespace genu::test {

struct Followed {
  PathResult result;
  std::vector<PosePoint> points;
  std::vector<PathEvent> events;

  std::vector<PathEvent> of(PathEvent::Kind kind) const {
    std::vector<PathEvent> out;
    for (const PathEvent& e : events)
      if (e.kind == kind) out.push_back(e);
    return out;
  }
  std::string story() const {
    std::string out;
    for (const PosePoint& p : points)
      if (!p.solved())
        out += std::to_string(p.step) + "/" + std::to_string(p.t) + ": " + to_string(p.report.status) + " " +
               p.report.why + "\n";
    for (const PathEvent& e : events)
      out += std::to_string(e.step) + "/" + std::to_string(e.t) + ": " + to_string(e.kind) + " " + e.what + "\n";
    return out;
  }
};

inline Followed follow(const JointModel& model, const std::vector<StepPlan>& plans, const PathOptions& options = {}) {
  Followed out;
  ContactField field(model);
  PathObserver observer;
  observer.pose = [&](const PosePoint& p, LayerMemories*) { out.points.push_back(p); };
  observer.event = [&](const PathEvent& e) { out.events.push_back(e); };
  out.result = follow_path(model, field, plans, options, observer);
  return out;
}

/// As written in a table and judged by itself: balance, contacts and ligaments of each pose that is called ok.
inline void expect_judged_ok(const SceneModel& s, const std::vector<PosePoint>& points) {
  ContactField field(s.model);
  std::vector<PoseRecord> records;
  for (const PosePoint& p : points) {
    records.push_back({p, {}});
    if (!p.pose.state.poses.empty())
      records.back().pair_gap = pair_gaps(p.pose.state, s.model, field, records.back().point.pose.open);
  }
  constexpr int kSamples = 30;  // each way: tests of the solver are many, and look over some poses
  expect_judged_ok(s.source, pose_table(s.scene, s.model, plan_steps(s.scene), records),
                   {.samples = kSamples, .every = points.size()});
}

inline Followed follow(const SceneModel& s, const PathOptions& options = {}) {
  Followed out = follow(s.model, plan_steps(s.scene), options);
  if (!out.points.empty()) expect_judged_ok(s, out.points);
  return out;
}
inline Followed follow(const std::string& text, const PathOptions& options = {}) {
  return follow(scene_model(text), options);
}

/// Holds a pair closed at the points of its surfaces nearest to x (world).
inline void hold(const JointModel& model, State& state, int pair, const Vec3& x) {
  const auto& p = model.pairs[static_cast<std::size_t>(pair)];
  ActiveContact c{pair, static_cast<int>(state.contacts.size()) + 1, {}, 0};
  EXPECT_TRUE(p.a->project(state.poses[static_cast<std::size_t>(p.body_a)].inverse() * x, c.geometry.a));
  EXPECT_TRUE(p.b->project(state.poses[static_cast<std::size_t>(p.body_b)].inverse() * x, c.geometry.b));
  state.contacts.push_back(c);
}

/// Where the contact point of a state's contact is in the world (m).
inline Vec3 contact_point(const JointModel& model, const State& state, std::size_t contact = 0) {
  const ActiveContact& c = state.contacts[contact];
  const auto& p = model.pairs[static_cast<std::size_t>(c.pair)];
  return state.poses[static_cast<std::size_t>(p.body_a)] * c.geometry.a.p;
}

/// The knee balanced with its flexion prescribed (deg), by the whole search.
struct SolvedKnee {
  SceneModel scene;
  Target target;
  Balanced pose;
  PoseReport report;
};
inline SolvedKnee solved_knee(double flexion, const std::string& more = "") {
  SolvedKnee out{scene_model(knee(more + "[[step]]\nprescribe = { \"knee.flexion\" = [0, " + std::to_string(flexion) +
                                  "] }\nincrements = 1\n")),
                 {},
                 {},
                 {}};
  const Followed w = follow(out.scene);
  EXPECT_TRUE(w.result.complete) << w.story();
  if (w.points.empty()) return out;
  out.target = w.points.back().target;
  out.pose = w.points.back().pose;
  out.report = w.points.back().report;
  return out;
}

/// Von Mises' truss: the bone's origin between supports 40 mm to either side of it and 12 mm below, on springs of
/// 50 N/mm that rest there; the load `w` pushes it down.
inline std::string truss(const std::string& steps) {
  return bone_on_ground("{ z = 12 }") +
         ligament("l", "[0, 0, 0]", "[-40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
         ligament("r", "[0, 0, 0]", "[40, 0, 0]", "law = \"spring\"\nstiffness = 50\nreference_force = 0") +
         load("w", "force = [0, 0, -1]") + steps;
}

/// A ball of 20 mm over a floor, turned by nothing, its centre at `z` (mm): held to the floor by a quadratic spring of
/// 5000 N and slack length 18 mm, which is 20 mm long when the ball stands on the floor. It lifts off under kLiftOff.
inline constexpr double kLiftOff = 5000 * (2.0 / 18) * (2.0 / 18);  // N
inline std::string held_ball(const std::string& more, double z = 20) {
  return bone_on_ground("{ z = " + std::to_string(z) + " }") + surface("ball", "bone", "sphere", "radius = 20") +
         surface("floor", "ground", "plane") + contact("foot", "ball", "floor") +
         ligament("rope", "[0, 0, -10]", "[0, 0, -10]", "law = \"quadratic\"\nstiffness = 5000\nslack_length = 18") +
         load("lift", "force = [0, 0, 1]") + more;
}
inline const std::string kNoTurn = "\"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0";

}  // namespace genu::test
