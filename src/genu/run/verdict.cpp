#include "genu/run/verdict.h"

#include <cmath>

#include <fmt/format.h>

namespace genu {
namespace {

/// What varies in a step, where it stands: "knee.flexion = 41.2 deg", "load pull x 0.5"; all that is prescribed where
/// nothing varies.
std::string place(const Prepared& prepared, int step, const Target& target) {
  const Scene& scene = prepared.scene;
  const StepPlan* plan = step > 0 ? &prepared.steps[static_cast<std::size_t>(step - 1)] : nullptr;
  std::string varying, held;
  const auto add = [&](bool varies, const std::string& part) {
    std::string& text = varies ? varying : held;
    text += (text.empty() ? "" : ", ") + part;
  };
  for (std::size_t i = 0; i < target.prescribed.size(); ++i) {
    const auto& p = target.prescribed[i];
    const bool angle = p.coordinate.index < 3;
    add(plan != nullptr && plan->prescribed[i].from != plan->prescribed[i].to,
        fmt::format("{} = {:.6g} {}", coordinate_name(scene, p.coordinate), p.value * (angle ? 180 / M_PI : 1e3),
                    angle ? "deg" : "mm"));
  }
  for (std::size_t i = 0; i < target.load_factors.size(); ++i)
    if (plan != nullptr && plan->factors[i].from != plan->factors[i].to)
      add(true, fmt::format("load {} x {:.9g}", scene.loads[i].name, target.load_factors[i]));
  const std::string& text = varying.empty() ? held : varying;
  return (plan == nullptr ? "the way to a step's start, " : "") + (text.empty() ? "the start" : text);
}

std::string advice(PoseStatus status) {
  switch (status) {
    case PoseStatus::over_edge:
      return "The cartilage ends there: extend the mesh, or shorten the motion.";
    case PoseStatus::overlap:
      return "Check the frames, units and outward sides of the surfaces, or start nearer with the joint's `reference`.";
    case PoseStatus::overconstrained:
      return "Prescribe fewer coordinates.";
    case PoseStatus::undetermined:
      return "Prescribe the free motion, or add the ligament or load that holds it.";
    case PoseStatus::chatter:
      return "Two sets of contacts exclude each other here: smaller increments or another `fit_radius` may part them.";
    case PoseStatus::no_equilibrium:
      return "Try smaller increments or another `fit_radius`; if the path turns back here, prescribe another "
             "coordinate.";
    case PoseStatus::ok:
      break;
  }
  return {};
}

void say_windows(const Prepared& prepared, const std::vector<PathEvent>& events, std::vector<std::string>& out) {
  const PathEvent* from = nullptr;
  for (const PathEvent& e : events) {
    if (e.kind != PathEvent::Kind::stepped_over) continue;
    if (from == nullptr) {
      from = &e;
      continue;
    }
    out.push_back(
        fmt::format("Stepped over a window without a rigid solution from {} to {}: one contact splits in two there.",
                    place(prepared, from->step, from->target), place(prepared, e.step, e.target)));
    from = nullptr;
  }
}

}  // namespace

std::vector<std::string> verdict_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                           const std::vector<PathEvent>& events, const RunSummary& summary) {
  std::vector<std::string> out;
  if (summary.poses_solved == summary.poses_asked && summary.exit_code == 0)
    out.push_back(fmt::format("Every pose is solved and certified; {} of {} stable.", summary.poses_stable,
                              summary.poses_solved));
  else if (summary.poses_solved == 0)
    out.push_back(fmt::format("0 of {} poses are solved.", summary.poses_asked));
  else
    out.push_back(fmt::format("{} of {} poses are solved; those are certified and kept.", summary.poses_solved,
                              summary.poses_asked));
  say_windows(prepared, events, out);
  for (const PathEvent& e : events) {
    if (e.kind == PathEvent::Kind::turns_back)
      out.push_back(
          fmt::format("The path turns back at {}: the smallest stiffness vanishes and no equilibrium lies beyond. "
                      "Prescribe another coordinate to follow it round.",
                      place(prepared, e.step, e.target)));
    if (e.kind == PathEvent::Kind::snaps)
      out.push_back(fmt::format("From {} the joint would snap {}: start a scene there (`reference`) to follow it on.",
                                place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::held)
      out.push_back(
          fmt::format("From {} a ligament is held at the jump of its law, with a force between those of the two "
                      "sides: {}.",
                      place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::jump)
      out.push_back(fmt::format("At {} the force of a ligament drops and the joint moves on at once: {}.",
                                place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::flutter)
      out.push_back(
          fmt::format("From {} on the loads that follow the body can drive an oscillation (flutter): whether it "
                      "grows depends on mass and damping, which a quasi-static run does not know.",
                      place(prepared, e.step, e.target)));
    if (e.kind == PathEvent::Kind::stability_changed)
      out.push_back(fmt::format("The equilibrium becomes {} at {}.", e.what, place(prepared, e.step, e.target)));
    if (e.kind == PathEvent::Kind::over_edge)
      out.push_back(
          fmt::format("Contact {} reaches the edge of its surface at {}.", e.what, place(prepared, e.step, e.target)));
  }
  for (const PoseRecord& r : records) {
    const PoseReport& report = r.point.report;
    if (report.status == PoseStatus::ok) continue;
    out.push_back(fmt::format("{} at {}: {}. {}", to_string(report.status),
                              place(prepared, r.point.step, r.point.target), report.why, advice(report.status)));
    break;
  }
  return out;
}

}  // namespace genu
