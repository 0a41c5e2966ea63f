#include "genu/appraise/verdict.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/tolerances.h"

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
    const bool angle = p.coordinate.is_rotation();
    add(plan != nullptr && plan->prescribed[i].from != plan->prescribed[i].to,
        fmt::format("{} = {:.9g} {}", quantity_name(scene, p.coordinate), p.value * (angle ? 180 / M_PI : 1e3),
                    angle ? "deg" : "mm"));
  }
  for (std::size_t i = 0; i < target.load_factors.size(); ++i)
    if (plan != nullptr && plan->factors[i].from != plan->factors[i].to)
      add(true, fmt::format("load {} x {:.9g}", scene.loads[i].name, target.load_factors[i]));
  for (const LoadDef& load : scene.loads)
    if (plan != nullptr && load.in_time()) {
      add(true, fmt::format("time = {:.6g} s", target.time));
      break;
    }
  const std::string& text = varying.empty() ? held : varying;
  return (plan == nullptr ? "the approach to a step's start, with " : "") + (text.empty() ? "the start" : text);
}

/// The coordinates that no step prescribes, where an event happened: "knee.flexion 80.9 deg, knee.x 1.2 mm".
std::string free_coordinates(const Prepared& prepared, const PathEvent& event) {
  std::string out;
  for (int j = 0; j < static_cast<int>(event.coordinates.size()); ++j)
    for (int i = 0; i < 6; ++i) {
      const CoordinateRef c{j, i};
      const auto prescribed = [&](const auto& p) { return p.coordinate == QuantityRef(c); };
      const JointDef& joint = prepared.scene.joints[static_cast<std::size_t>(j)];
      if (!joint.leaves(i) || std::any_of(event.target.prescribed.begin(), event.target.prescribed.end(), prescribed))
        continue;
      const double value = event.coordinates[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
      const bool angle = i < 3;
      out += fmt::format("{}{} {:.6g} {}", out.empty() ? "" : ", ", coordinate_name(prepared.scene, c),
                         value * (angle ? 180 / M_PI : 1e3), angle ? "deg" : "mm");
    }
  return out;
}

std::string in_brackets(const std::string& text) { return text.empty() ? text : " (" + text + ")"; }

/// A peak of the reaction is where the joint would snap if that force drove it: the first one is told, the others
/// counted.
void say_reaction_turns(const Prepared& prepared, const std::vector<PathEvent>& events, std::vector<std::string>& out) {
  const auto turns = [](const PathEvent& e) { return e.kind == PathEvent::Kind::reaction_turns && e.step > 0; };
  const auto first = std::find_if(events.begin(), events.end(), turns);
  if (first == events.end()) return;
  const auto more = std::count_if(first + 1, events.end(), turns);
  out.push_back(fmt::format(
      "The reaction of what is prescribed is {} at {}: driven by such a load in its place, the path would turn back "
      "there (a limit point) and the joint would snap; prescribed, it goes on.{}",
      first->what, place(prepared, first->step, first->target),
      more == 0 ? "" : fmt::format(" {} more such {} in events.csv.", more, more == 1 ? "turn is" : "turns are")));
}

std::string joined_with_and(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

/// Which motions cost nothing, which forces can be traded, by name.
std::string undetermined(const Prepared& prepared, const PosePoint& point) {
  const Undetermined& u = point.undetermined;
  std::vector<std::string> motion, forces;
  for (const CoordinateRef& c : u.free_motion) motion.push_back(coordinate_name(prepared.scene, c));
  for (const QuantityRef& q : u.shared_reactions) {
    const JointDef& joint = prepared.scene.joints[static_cast<std::size_t>(q.first.joint)];
    const bool named = q.combination >= 0 || joint.leaves(q.first.index);  // what a joint holds has no name of its own
    const std::string name =
        named ? "the reaction of " + quantity_name(prepared.scene, q) : "reactions of joint " + joint.name;
    if (std::find(forces.begin(), forces.end(), name) == forces.end()) forces.push_back(name);
  }
  for (const int c : u.shared_contacts) {
    const ActiveContact& contact = point.pose.state.contacts[static_cast<std::size_t>(c)];
    forces.push_back(fmt::format("contact {}.{}", prepared.scene.contacts[static_cast<std::size_t>(contact.pair)].name,
                                 contact.number));
  }
  for (const int l : u.shared_ligaments)
    forces.push_back("ligament " + prepared.model.ligaments[static_cast<std::size_t>(l)].name);
  std::string out;
  if (!motion.empty())
    out +=
        fmt::format("Free is {}: prescribe it, or add the ligament or load that holds it. ", joined_with_and(motion));
  if (!forces.empty())
    out += fmt::format("Not determined one by one: {}. {} ", joined_with_and(forces),
                       u.shared_ligaments.empty()
                           ? "Prescribe one coordinate less, or give one of them a ligament's elasticity."
                           : "A ligament at a length where its force jumps can hold any force between: give it a law "
                             "without the jump.");
  if (out.empty()) return "Prescribe the free motion, or add the ligament or load that holds it.";
  out.pop_back();
  return out;
}

bool raises_a_load(const Prepared& prepared, int step) {
  if (step < 1) return false;
  const auto& factors = prepared.steps[static_cast<std::size_t>(step - 1)].factors;
  return std::any_of(factors.begin(), factors.end(), [](const auto& f) { return std::abs(f.to) > std::abs(f.from); });
}

/// What the user can do about a pose that was not found.
std::string advice_without_pose(const Prepared& prepared, const PosePoint& point, bool first, bool turned_back) {
  if (turned_back) return "Prescribe another coordinate from there on, or control the step by arc length.";
  const auto& surfaces = prepared.scene.surfaces;
  const bool meshed = std::any_of(surfaces.begin(), surfaces.end(),
                                  [](const SurfaceDef& s) { return s.shape == SurfaceDef::Shape::mesh; });
  if (first)
    return "Start nearer to where the joint balances (the joint's `start`), and check that something holds every "
           "motion that is not prescribed.";
  if (!prepared.scene.layers.empty() && raises_a_load(prepared, point.step))
    return "Its layers may carry no more than this (`modulus`, `thickness`, `search_depth`): smaller increments of the "
           "load tell how far they go.";
  return std::string("Try smaller increments") + (meshed ? " or another `fit_radius`." : ".");
}

/// To start elsewhere is of no use where a layer carries less than it is asked to.
std::string overload_advice(double part) {
  return fmt::format(
      "Under {:g} of its loads the joint balances here: all of them are more than its layers carry from here. Stiffer "
      "or "
      "thicker ones (`modulus`, `thickness`, `search_depth`) carry more, and a step that raises a load from {:g} to 1 "
      "tells how far these go.",
      part, part);
}

std::string advice(PoseStatus status) {
  switch (status) {
    case PoseStatus::over_edge:
      return "The surface ends there: extend its mesh or its patch, or shorten the motion.";
    case PoseStatus::overlap:
      return "Check the frames, units and outward sides of the surfaces, or start nearer with the joint's `start`.";
    case PoseStatus::overconstrained:
      return "Prescribe fewer coordinates.";
    case PoseStatus::chatter:
      return "Two sets of contacts exclude each other here: smaller increments or another `fit_radius` may part them.";
    case PoseStatus::flawed_mesh:
      return "Mend the mesh there (genu mesh-check FILE --repair OUT), or keep contact away with the surface's "
             "`patch`.";
    case PoseStatus::undetermined:
    case PoseStatus::no_equilibrium:
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
    out.push_back(fmt::format("Stepped over a window without a rigid solution where contacts change, from {} to {}.",
                              place(prepared, from->step, from->target), place(prepared, e.step, e.target)));
    from = nullptr;
  }
}

void say_locations(const Prepared& prepared, const std::vector<PoseRecord>& records,
                   const std::vector<ContactLocation>& locations, std::vector<std::string>& out) {
  for (const ContactLocation& c : locations) {
    if (c.doubtful == 0) continue;
    const PosePoint& worst = records[c.record].point;
    out.push_back(fmt::format(
        "The contact of {} is located to ± {:.2g} mm at {}: the surfaces are nearly parallel there (relative curvature "
        "{:.2g} 1/m, known to {:.2g} 1/m from the noise of the meshes). In {} of {} poses a place is doubtful in this "
        "way, "
        "typically to ± {:.2g} mm; the poses themselves are known better.",
        c.contact, 1e3 * c.spread, place(prepared, worst.step, worst.target), c.least_curvature,
        c.curvature_uncertainty, c.doubtful, c.poses, 1e3 * c.typical_spread));
  }
}

/// A path that ends a few reaches from a flaw may end because of it, and a search that finds nothing to start from
/// because of any.
void say_flaws(const Prepared& prepared, const PosePoint* last, std::vector<std::string>& out) {
  if (last == nullptr) {
    for (const auto& surface : prepared.surfaces)
      if (!surface->doubtful().empty())
        out.push_back("A flaw may be the cause: " + surface->doubtful().front().what + ".");
    return;
  }
  for (const ActiveContact& c : last->pose.state.contacts) {
    const auto& pair = prepared.model.pairs[static_cast<std::size_t>(c.pair)];
    for (const bool of_a : {true, false}) {
      const Vec3& foot = of_a ? c.geometry.a.p : c.geometry.b.p;
      for (const DoubtfulPlace& flaw : (of_a ? pair.a : pair.b)->doubtful())
        for (const Vec3& p : flaw.points) {
          if ((p - foot).norm() > kNearFlaw * flaw.reach) continue;
          out.push_back(fmt::format("A flaw {:.1f} mm from the last contact may be the cause: {}.",
                                    1e3 * (p - foot).norm(), flaw.what));
          return;
        }
    }
  }
}

/// What the poses are that are not stable.
std::string of_the_others(const std::vector<PoseRecord>& records, const RunSummary& summary) {
  if (summary.poses_stable == summary.poses_solved) return ".";
  const bool fall = std::all_of(records.begin(), records.end(), [](const PoseRecord& r) {
    const std::string said = to_string(r.point.stability);
    return said == to_string(Stability::Verdict::stable) || said == to_string(Stability::Verdict::unstable);
  });
  return fall ? "; left to itself the joint would leave the others (column `stability`)."
              : "; what the others are stands in column `stability`.";
}

/// Changes of stability, of which there can be as many as poses: the first of them.
class StabilityChanges {
 public:
  void add(std::string sentence, std::vector<std::string>& out) {
    constexpr int kSentencesShown = 12;
    if (++count_ <= kSentencesShown) out.push_back(std::move(sentence));
    left_ = std::max(0, count_ - kSentencesShown);
  }
  void end(std::vector<std::string>& out) const {
    if (left_ > 0) out.push_back(fmt::format("{} more changes of stability are in events.csv.", left_));
  }

 private:
  int count_ = 0, left_ = 0;
};

}  // namespace

std::vector<std::string> verdict_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                           const std::vector<PathEvent>& events, const RunSummary& summary) {
  std::vector<std::string> out;
  if (summary.poses_solved == summary.poses_asked && summary.exit_code == 0)
    out.push_back(fmt::format("Every pose is solved and certified; {} of {} stable{}", summary.poses_stable,
                              summary.poses_solved, of_the_others(records, summary)));
  else if (summary.poses_solved == 0)
    out.push_back(fmt::format("0 of {} poses are solved.", summary.poses_asked));
  else
    out.push_back(fmt::format(
        "{} of {} poses are solved; those are certified and kept{}.", summary.poses_solved, summary.poses_asked,
        summary.poses_stable == summary.poses_solved ? "" : fmt::format(", {} of them stable", summary.poses_stable)));
  say_windows(prepared, events, out);
  bool turned_back = false;
  StabilityChanges changes;
  for (const PathEvent& e : events) {
    turned_back = turned_back || e.kind == PathEvent::Kind::turns_back;
    if (e.kind == PathEvent::Kind::turns_back)
      out.push_back(
          fmt::format("The path turns back at {}{}: the smallest stiffness vanishes (or, where a contact lets go, "
                      "jumps below 0) and no equilibrium lies beyond. "
                      "Prescribe another coordinate, or follow it round with control = \"arc_length\".",
                      place(prepared, e.step, e.target), in_brackets(free_coordinates(prepared, e))));
    if (e.kind == PathEvent::Kind::limit_point)
      out.push_back(fmt::format("Limit point at {}{}: the path turns back there, {}.",
                                place(prepared, e.step, e.target), in_brackets(free_coordinates(prepared, e)),
                                e.what == to_string(Stability::Verdict::stable)
                                    ? "and is stable from here on"
                                    : "and is unstable from here on: a joint that is driven on snaps"));
    if (e.kind == PathEvent::Kind::bifurcation)
      out.push_back(fmt::format("Bifurcation at {}{}: another path of equilibria branches off.",
                                place(prepared, e.step, e.target), in_brackets(free_coordinates(prepared, e))));
    if (e.kind == PathEvent::Kind::closed)
      out.push_back("The path closes on itself: from here on it repeats what was found.");
    if (e.kind == PathEvent::Kind::snaps)
      out.push_back(fmt::format("From {} the joint would snap {}: begin there (the joint's `start`) to follow it on.",
                                place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::snapped)
      out.push_back(
          fmt::format("At {} the equilibrium that was followed ends and the joint snaps {}: later poses go on "
                      "from there.",
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
          fmt::format("From {} on the loads that have no potential (they follow a body, or their size depends on a "
                      "coordinate) can drive an oscillation (flutter): whether it grows depends on mass and damping, "
                      "which a quasi-static run does not know.",
                      place(prepared, e.step, e.target)));
    const bool told = &e != &events.front() && (&e - 1)->kind == PathEvent::Kind::limit_point && (&e - 1)->t == e.t;
    if (e.kind == PathEvent::Kind::stability_changed && !told)
      changes.add(fmt::format("The equilibrium becomes {} at {}.", e.what, place(prepared, e.step, e.target)), out);
    if (e.kind == PathEvent::Kind::over_edge)
      out.push_back(
          fmt::format("Contact {} reaches the edge of its surface at {}.", e.what, place(prepared, e.step, e.target)));
  }
  changes.end(out);
  say_reaction_turns(prepared, events, out);
  say_locations(prepared, records, summary.locations, out);
  for (const PoseRecord& r : records) {
    const PoseReport& report = r.point.report;
    if (report.status == PoseStatus::ok) continue;
    std::string what_next = advice(report.status);
    if (report.status == PoseStatus::no_equilibrium)
      what_next = advice_without_pose(prepared, r.point, &r == &records.front(), turned_back);
    if (&r == &records.front() && summary.bearable_loads > 0) what_next = overload_advice(summary.bearable_loads);
    if (report.status == PoseStatus::undetermined) what_next = undetermined(prepared, r.point);
    out.push_back(fmt::format("{} at {}: {}. {}", to_string(report.status),
                              place(prepared, r.point.step, r.point.target), report.why, what_next));
    if (report.status != PoseStatus::flawed_mesh)
      say_flaws(prepared, &r == &records.front() ? nullptr : &(&r - 1)->point, out);
    break;
  }
  return out;
}

}  // namespace genu
