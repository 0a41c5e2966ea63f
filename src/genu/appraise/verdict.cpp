#include "genu/appraise/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "genu/appraise/no_potential.h"
#include "genu/appraise/patella.h"
#include "genu/appraise/place.h"
#include "genu/appraise/shorter_sides.h"
#include "genu/appraise/tolerances.h"
#include "genu/appraise/unstable.h"

namespace genu {
namespace {

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
      out += fmt::format("{}{} {:.4g} {}", out.empty() ? "" : ", ", coordinate_name(prepared.scene, c),
                         value * (angle ? 180 / M_PI : 1e3), angle ? "deg" : "mm");
    }
  return out;
}

std::string in_brackets(const std::string& text) { return text.empty() ? text : " (" + text + ")"; }

/// After a snap: ", on another branch (stable) (knee.adduction ...)", from the event where it has come to rest.
std::string new_branch(const Prepared& prepared, const std::vector<PathEvent>& events, const PathEvent& snap) {
  const auto next = std::find_if(events.begin() + (&snap - events.data()), events.end(),
                                 [](const PathEvent& e) { return e.kind == PathEvent::Kind::new_branch; });
  if (next == events.end()) return {};
  return fmt::format(", on another branch ({}){}; `control = \"arc_length\"` follows the first one past its end",
                     next->what, in_brackets(free_coordinates(prepared, *next)));
}

/// "largest 6.68862099 Nm" of a table as "a local maximum of 6.689 Nm".
std::string turn_in_words(const std::string& words) {
  const std::size_t begin = words.find(' ') + 1, end = words.rfind(' ');
  if (end == std::string::npos) return words;
  const double value = std::strtod(words.c_str() + begin, nullptr);
  return fmt::format("a local {} of {:.4g}{}", words.starts_with("largest") ? "maximum" : "minimum", value,
                     words.substr(end));
}

/// At a peak of the reaction the joint would snap through under a dead load of that size: the first peak, and the
/// number of the others.
void say_reaction_turns(const Prepared& prepared, const std::vector<PathEvent>& events, std::vector<std::string>& out) {
  const auto turns = [](const PathEvent& e) { return e.kind == PathEvent::Kind::reaction_turns && e.step > 0; };
  const auto first = std::find_if(events.begin(), events.end(), turns);
  if (first == events.end()) return;
  const auto more = std::count_if(first + 1, events.end(), turns);
  out.push_back(
      fmt::format("The reaction of the prescribed coordinate has {} at {}. Under a dead load of that size the joint "
                  "would snap through "
                  "(limit point); here the coordinate is prescribed, so it does not.{}",
                  turn_in_words(first->what), place(prepared, first->step, first->target),
                  more == 0 ? "" : fmt::format(" See events.csv for {} more.", more)));
}

/// The free motions and the statically indeterminate forces, by name.
std::string undetermined(const Prepared& prepared, const PosePoint& point) {
  const Undetermined& u = point.undetermined;
  std::vector<std::string> motion, forces;
  for (const CoordinateRef& c : u.free_motion) motion.push_back(coordinate_name(prepared.scene, c));
  for (const QuantityRef& q : u.shared_reactions) {
    const JointDef& joint = prepared.scene.joints[static_cast<std::size_t>(q.first.joint)];
    const bool named = q.combination >= 0 || joint.leaves(q.first.index);  // what a joint holds has no name of its own
    std::string name =
        named ? "the reaction of " + quantity_name(prepared.scene, q) : "reactions of joint " + joint.name;
    for (const auto& p : point.target.prescribed)
      if (p.coordinate == q && !p.drivers.empty())
        name = fmt::format("the factor of load {}, which has no moment arm about {} here",
                           prepared.scene.loads[at(p.drivers.front())].name, quantity_name(prepared.scene, q));
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
    out += fmt::format("Free motion: {}. Prescribe it, or add a ligament or load that holds it. ",
                       joined_with_and(motion));
  if (!forces.empty())
    out += fmt::format("Statically indeterminate: {}. {} ", joined_with_and(forces),
                       u.shared_ligaments.empty()
                           ? "Prescribe one coordinate less, or make one of them elastic."
                           : "A ligament at a jump of its law can have any force between both sides: give it a law "
                             "without the jump.");
  if (out.empty()) return "Prescribe the free motion, or add a ligament or load that holds it.";
  out.pop_back();
  return out;
}

bool raises_a_load(const Prepared& prepared, int step) {
  if (step < 1) return false;
  const auto& factors = prepared.steps[static_cast<std::size_t>(step - 1)].factors;
  return std::any_of(factors.begin(), factors.end(), [](const auto& f) { return std::abs(f.to) > std::abs(f.from); });
}

/// What follows a path past the place where it turns back.
std::string past_a_turn(const Target& target) {
  return fmt::format("Prescribe {} coordinate from there on, or use control = \"arc_length\".",
                     target.prescribed.empty() ? "a" : "another");
}

/// What the user can do about a pose that was not found.
std::string advice_without_pose(const Prepared& prepared, const PosePoint& point, bool first, bool turned_back) {
  if (turned_back) return past_a_turn(point.target);
  const auto& surfaces = prepared.scene.surfaces;
  const bool meshed = std::any_of(surfaces.begin(), surfaces.end(),
                                  [](const SurfaceDef& s) { return s.shape == SurfaceDef::Shape::mesh; });
  if (point.report.adrift)
    return "Check the signs of the loads and their frames, or add what holds the joint against them.";
  if (first)
    return "Start nearer to equilibrium (the joint's `start`). Check that something holds every motion that is not "
           "prescribed.";
  if (!prepared.scene.layers.empty() && raises_a_load(prepared, point.step))
    return "The layers may not carry this load (`modulus`, `thickness`, `search_depth`). Smaller load increments show "
           "how much they carry.";
  return std::string("Follow the step with `control = \"arc_length\"`") +
         (meshed ? ", or try another `fit_radius`." : ".");
}

/// Another start does not help where a layer cannot carry the load, or where the path toward all of it turns back.
std::string overload_advice(double part, bool turned_back) {
  if (turned_back)
    return fmt::format(
        "The joint balances here under {:.4g} of its loads at the start. Lower them, begin at another value of what is "
        "prescribed, or add what holds the joint.",
        part);
  return fmt::format(
      "The joint balances here under {:.4g} of its loads at the start, but the layers may not carry all of them. Use "
      "stiffer or "
      "thicker layers (`modulus`, `thickness`, `search_depth`).",
      part);
}

std::string advice(PoseStatus status, std::size_t prescribed) {
  switch (status) {
    case PoseStatus::over_edge:
      return "The surface ends there, and rigid contact has no edges: extend its mesh or its patch, shorten the "
             "motion, "
             "or use layers (`model = \"cartilage\"`), which bear load up to their rim.";
    case PoseStatus::overlap:
      return "Check the frames, units and outward sides of the surfaces, or start nearer with the joint's `start`.";
    case PoseStatus::overconstrained:
      if (prescribed > 1) return "Prescribe fewer coordinates.";
      return "Try another `fit_radius`, or a cartilage layer, which can share the load among any number of places.";
    case PoseStatus::chatter:
      return "Two active sets exclude each other here. Follow the step with `control = \"arc_length\"`, or try another "
             "`fit_radius`.";
    case PoseStatus::flawed_mesh:
      return "Repair the mesh there (genu mesh-check FILE --repair OUT), or keep contact away with the surface's "
             "`patch`.";
    case PoseStatus::slips_off:
      return "Give the path another `side`, a via point, or a surface that holds it; or shorten the motion.";
    case PoseStatus::lifts_off:
      return "Name the surface once more in the path, for another place of touch, or smooth the hollow out of its "
             "mesh.";
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
    out.push_back(fmt::format("Contacts change from {} to {}, and no rigid solution exists there: stepped over.",
                              place(prepared, from->step, from->target), place(prepared, e.step, e.target)));
    from = nullptr;
  }
}

/// Vertices of a staircase are half a step off: no pose on it is known better.
void say_steps(const Prepared& prepared, std::vector<std::string>& out) {
  for (const SurfaceNote& note : prepared.notes) {
    if (!note.steps) continue;
    const StairSteps& steps = *note.steps;
    out.push_back(
        fmt::format("The mesh of {} is a staircase, a segmentation that was not smoothed: {} steps of {:.3g} mm. Poses "
                    "are known to about ± {:.1g} mm at best (--error-bars), and forces accordingly.",
                    note.name, steps.levels, 1e3 * steps.height, 2e3 * steps.rms));
  }
}

void say_locations(const Prepared& prepared, const std::vector<PoseRecord>& records,
                   const std::vector<ContactLocation>& locations, std::vector<std::string>& out) {
  for (const ContactLocation& c : locations) {
    if (c.doubtful == 0) continue;
    const PosePoint& worst = records[c.record].point;
    out.push_back(fmt::format(
        "The contact point of {} is uncertain by ± {:.2g} mm at {}: the surfaces are nearly parallel there (relative "
        "curvature {:.2g} ± {:.2g} 1/m, from the noise of the meshes). This holds for {} of {} poses, typically "
        "± {:.2g} mm; heights are known better.",
        c.contact, 1e3 * c.spread, place(prepared, worst.step, worst.target), c.least_curvature,
        c.curvature_uncertainty, c.doubtful, c.poses, 1e3 * c.typical_spread));
  }
}

/// A flaw near the end of a path, or any flaw where no first pose was found, may be the cause.
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

/// The surface whose edge a contact ("medial.1") reaches after a row: that to whose edge it was nearer there.
std::string surface_at_edge(const Prepared& prepared, const std::vector<PoseRecord>& records, const PathEvent& event) {
  const auto rows = static_cast<std::size_t>(std::max(0, event.rows_before));
  double least = std::numeric_limits<double>::infinity();
  std::string out = "its surface";
  if (rows == 0 || rows > records.size()) return out;
  for (const ActiveContact& c : records[rows - 1].point.pose.state.contacts) {
    const ContactDef& contact = prepared.scene.contacts[at(c.pair)];
    if (event.what != fmt::format("{}.{}", contact.name, c.number) && event.what != contact.name) continue;
    const auto& pair = prepared.model.pairs[at(c.pair)];
    for (const bool of_a : {true, false}) {
      const double distance = (of_a ? *pair.a : *pair.b).edge_distance(of_a ? c.geometry.a.p : c.geometry.b.p);
      if (!(distance < least)) continue;
      least = distance;
      out = prepared.scene.surfaces[at(of_a ? contact.surface_a : contact.surface_b)].name;
    }
  }
  return out;
}

void say_flutter(const Prepared& prepared, const PathEvent& event, std::vector<std::string>& out) {
  const std::vector<std::string> causes = without_potential(prepared.scene);
  out.push_back(fmt::format(
      "From {} on, an oscillation can grow (flutter): the stiffness is not symmetric. {}: {}. Whether the oscillation "
      "grows depends on mass and damping, which a quasi-static run does not include.",
      place(prepared, event.step, event.target), causes.size() == 1 ? "The cause" : "Causes may be",
      causes.empty() ? "a reaction or a driving load" : joined_with_and(causes)));
}

/// The end of the sentence "... 2 of 3 stable".
std::string of_the_others(const Prepared& prepared, const std::vector<PoseRecord>& records, const RunSummary& summary) {
  if (summary.poses_stable == summary.poses_solved) return ".";
  std::set<std::string> why;
  for (const PoseRecord& r : records) {
    const std::string verdict = to_string(r.point.stability);
    if (verdict == to_string(Stability::Verdict::stable)) continue;
    if (verdict != to_string(Stability::Verdict::unstable)) return " (see column `stability`).";
    why.insert(why_unstable(prepared, r.point));
  }
  const bool one_reason = why.size() == 1 && !why.begin()->empty();
  return fmt::format(", the others unstable{} (see column `stability`).", one_reason ? ": " + *why.begin() : "");
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
  for (const std::string& sentence : prepared.facing) out.push_back("This is no result to trust: " + sentence + ".");
  if (!prepared.facing.empty())
    out.push_back(fmt::format("{} of {} poses are solved with the surfaces as they are.", summary.poses_solved,
                              summary.poses_asked));
  else if (summary.poses_solved == summary.poses_asked && summary.exit_code == 0)
    out.push_back(fmt::format("Every pose is solved and certified; {} of {} stable{}", summary.poses_stable,
                              summary.poses_solved, of_the_others(prepared, records, summary)));
  else if (summary.poses_solved == 0)
    out.push_back(fmt::format("0 of {} poses are solved.", summary.poses_asked));
  else
    out.push_back(fmt::format(
        "{} of {} poses are solved; those are certified and kept{}.", summary.poses_solved, summary.poses_asked,
        summary.poses_stable == summary.poses_solved ? "" : fmt::format(", {} of them stable", summary.poses_stable)));
  if (summary.exit_code != 0)
    for (const std::string& doubt : patella_sentences(prepared, records, events)) out.push_back(as_sentence(doubt));
  say_windows(prepared, events, out);
  bool turned_back = false;
  StabilityChanges changes;
  for (const PathEvent& e : events) {
    turned_back = turned_back || e.kind == PathEvent::Kind::turns_back;
    if (e.kind == PathEvent::Kind::turns_back)
      out.push_back(fmt::format("The path turns back at {}{} (limit point): no equilibrium lies beyond.{}",
                                place(prepared, e.step, e.target), in_brackets(free_coordinates(prepared, e)),
                                e.step == 0 ? "" : " " + past_a_turn(e.target)));
    if (e.kind == PathEvent::Kind::limit_point)
      out.push_back(fmt::format("Limit point at {}{}: the path turns back and is {}.",
                                place(prepared, e.step, e.target), in_brackets(free_coordinates(prepared, e)),
                                e.what == to_string(Stability::Verdict::stable)
                                    ? "stable from here on"
                                    : "unstable from here on; under a dead load the joint would snap through"));
    if (e.kind == PathEvent::Kind::bifurcation)
      out.push_back(fmt::format("Bifurcation at {}{}: another equilibrium path branches off.",
                                place(prepared, e.step, e.target), in_brackets(free_coordinates(prepared, e))));
    if (e.kind == PathEvent::Kind::closed) out.push_back("The path is closed: from here on it repeats itself.");
    if (e.kind == PathEvent::Kind::snaps)
      out.push_back(fmt::format("At {} the joint would snap {}. Set the joint's `start` there to continue.",
                                place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::snapped)
      out.push_back(
          fmt::format("At {} the equilibrium path ends and the joint snaps {}. Later poses continue from there{}.",
                      place(prepared, e.step, e.target), e.what, new_branch(prepared, events, e)));
    if (e.kind == PathEvent::Kind::held)
      out.push_back(
          fmt::format("From {} on a ligament stays at the jump of its law, with a force between both sides: {}.",
                      place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::jump)
      out.push_back(fmt::format("At {} the force of a ligament drops and the joint jumps: {}.",
                                place(prepared, e.step, e.target), e.what));
    if (e.kind == PathEvent::Kind::flutter) say_flutter(prepared, e, out);
    const bool listed = &e != &events.front() && (&e - 1)->kind == PathEvent::Kind::limit_point &&
                        std::abs((&e - 1)->t - e.t) <= kLimitAndChange;
    if (e.kind == PathEvent::Kind::stability_changed && !listed)
      changes.add(fmt::format("The equilibrium becomes {} at {}.", e.what, place(prepared, e.step, e.target)), out);
    if (e.kind == PathEvent::Kind::over_edge)
      out.push_back(fmt::format("Contact {} reaches the edge of {} at {}.", e.what,
                                surface_at_edge(prepared, records, e), place(prepared, e.step, e.target)));
  }
  changes.end(out);
  say_reaction_turns(prepared, events, out);
  say_steps(prepared, out);
  say_locations(prepared, records, summary.locations, out);
  for (const std::string& sentence : shorter_sides(prepared.model, records)) out.push_back(sentence);
  for (const PoseRecord& r : records) {
    const PoseReport& report = r.point.report;
    if (report.status == PoseStatus::ok) continue;
    std::string what_next = advice(report.status, r.point.target.prescribed.size());
    if (report.status == PoseStatus::no_equilibrium)
      what_next = advice_without_pose(prepared, r.point, &r == &records.front(), turned_back);
    if (&r == &records.front() && summary.bearable_loads > 0)
      what_next = overload_advice(summary.bearable_loads, turned_back);
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
