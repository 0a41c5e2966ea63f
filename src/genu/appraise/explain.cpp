#include "genu/appraise/explain.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/counted.h"

namespace genu {
namespace {

std::string joined(const std::vector<std::string>& parts, const char* between = ", ") {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : between) + part;
  return out;
}

std::string axis_name(const Vec3& axis) {
  Eigen::Index i = 0;
  if (axis.cwiseAbs().maxCoeff(&i) < 1) return fmt::format("({:.4g}, {:.4g}, {:.4g})", axis[0], axis[1], axis[2]);
  return std::string(axis[i] < 0 ? "-" : "") + "xyz"[i];
}

/// The numbers of a load, but for vectors: the first as it is, others by their keys where they are given.
std::string numbers(const LoadDef& load) {
  std::string out;
  for (const NumberOf<LoadDef>& number : kind_of(load).numbers) {
    const NumberRow& row = number.row;
    const double value = *number.values_of(load);
    if (row.size > 1 || (!out.empty() && value == row.otherwise)) continue;
    const std::string unit = unit_name(row.unit);
    out += fmt::format(", {}{:g}{}{}", out.empty() ? "" : std::string(row.key) + " ", value / si(row.unit),
                       unit.empty() ? "" : " ", unit);
  }
  return out;
}

/// What a load is, and what that means for the tangent.
std::string kind_name(const SceneTables& scene, const LoadDef& load) {
  switch (load.kind) {
    case LoadDef::Kind::toward:
      return "toward a point of " + scene.bodies[at(load.toward_body)].name + numbers(load);
    case LoadDef::Kind::cable:
      return "a cable from " + scene.bodies[at(load.points.front().body)].name + " to " +
             scene.bodies[at(load.points.back().body)].name + numbers(load);
    case LoadDef::Kind::coordinate:
      return "on " + coordinate_name(scene, load.coordinate) + numbers(load);
    case LoadDef::Kind::wrench:
      break;
  }
  const std::string body = scene.bodies[at(load.body)].name;
  return (load.frame == LoadDef::Frame::body ? "follows " + body + ": unsymmetric tangent" : "dead, on " + body) +
         numbers(load);
}

std::string scale_name(const SceneTables& scene, const LoadDef& load) {
  if (!load.scale) return {};
  switch (load.scale->kind) {
    case ScaleDef::Kind::over_coordinate:
      return "; scaled over " + coordinate_name(scene, load.scale->coordinate);
    case ScaleDef::Kind::over_time:
      return "; scaled over time";
    case ScaleDef::Kind::feedback:
      return fmt::format("; feedback of {}{}", coordinate_name(scene, load.scale->coordinate),
                         load.scale->rate_gain != 0 ? " and its rate" : "");
    case ScaleDef::Kind::sine:
      return fmt::format("; a sine of {:g} Hz in time", load.scale->frequency);
    case ScaleDef::Kind::step:
      return fmt::format("; a step at {:g} s", load.scale->start);
  }
  return {};
}

class Explanation {
 public:
  explicit Explanation(const SceneTables& scene) : scene_(scene) {}

  std::string text() {
    out_ = fmt::format("{}{}{}\n\n", scene_.file, scene_.title.empty() ? "" : ": ", scene_.title);
    bodies();
    joints();
    effects();
    if (const double tolerance = scene_.solver.tolerance; tolerance != SolverDef{}.tolerance)
      line("solver", fmt::format("tolerance {:g} in the place of {:g}", tolerance, SolverDef{}.tolerance));
    for (std::size_t i = 0; i < scene_.steps.size(); ++i) step(i);
    if (scene_.dynamics) motion(*scene_.dynamics);
    return out_;
  }

 private:
  void line(const std::string& head, const std::string& text) { out_ += fmt::format("  {:<14}{}\n", head, text); }

  void bodies() {
    for (const BodyDef& body : scene_.bodies)
      line(&body == &scene_.bodies.front() ? "bodies" : "",
           body.name + (body.fixed ? ": fixed, its frame is the world's" : ": moves, 6 unknowns"));
  }

  static std::string coordinates(const JointDef& joint) {
    if (joint.type == JointDef::Type::fixed) return "none, holds 6";
    if (joint.type == JointDef::Type::revolute) {
      const Vec3& axis = joint.rotations[0].axis;
      return fmt::format("angle about ({:.4g}, {:.4g}, {:.4g}){}; holds the other 5", axis[0], axis[1], axis[2],
                         joint.stiffness > 0 ? joint.limits ? ", with a spring and limits" : ", with a spring"
                         : joint.limits      ? ", with limits"
                                             : "");
    }
    std::vector<std::string> names;
    for (const auto& r : joint.rotations) names.push_back(fmt::format("{} about {}", r.name, axis_name(r.axis)));
    return fmt::format("angles {}; origin {}, {}, {}", joined(names, ", then "), joint.translations[0],
                       joint.translations[1], joint.translations[2]);
  }

  std::string terms(const CombinationDef& combination) const {
    std::vector<std::string> parts;
    for (const auto& t : combination.terms)
      parts.push_back(fmt::format("{:g} {}", t.factor, coordinate_name(scene_, t.coordinate)));
    return joined(parts, " + ");
  }

  void joints() {
    constexpr const char* kTypes[] = {"free", "revolute", "fixed"};
    for (const JointDef& joint : scene_.joints) {
      line(&joint == &scene_.joints.front() ? "coordinates" : "",
           fmt::format("{}: {} in {}, {}", joint.name, scene_.bodies[at(joint.child)].name,
                       scene_.bodies[at(joint.parent)].name, kTypes[static_cast<int>(joint.type)]));
      line("", "  " + coordinates(joint));
      if (joint.grood_suntay)
        line("", fmt::format("  as a {} knee after Grood and Suntay: femur {}, tibia {}",
                             joint.grood_suntay->right ? "right" : "left",
                             scene_.bodies[at(joint.grood_suntay->femur.body)].name,
                             scene_.bodies[at(joint.grood_suntay->tibia.body)].name));
    }
    for (const CombinationDef& combination : scene_.combinations)
      line("", combination.name + " = " + terms(combination));
  }

  void effect(const std::string& name, std::size_t count, const std::string& brings) {
    if (count > 0) line(head("effects"), fmt::format("{:<16}{:>4}   {}", name, count, brings));
    if (count == 0) off_.push_back(name);
  }

  /// The heading on the first line of a block, nothing on those after.
  std::string head(const std::string& name) {
    if (last_head_ == name) return "";
    return last_head_ = name;
  }

  void effects() {
    std::vector<std::string> pairs, laws;
    for (const ContactDef& c : scene_.contacts)
      pairs.push_back(fmt::format("{} ({} on {})", c.name, scene_.surfaces[at(c.surface_a)].name,
                                  scene_.surfaces[at(c.surface_b)].name));
    std::vector<std::string> layers;
    for (const LayerDef& l : scene_.layers)
      layers.push_back(fmt::format("{} ({} on {}, {}, {})", l.pair.name, scene_.surfaces[at(l.pair.surface_a)].name,
                                   scene_.surfaces[at(l.pair.surface_b)].name,
                                   l.law == LayerDef::Law::linear ? "linear" : "logarithmic", quadrature_name(l)));
    for (const LigamentDef& l : scene_.ligaments)
      if (std::find(laws.begin(), laws.end(), l.law) == laws.end()) laws.push_back(l.law);
    std::vector<std::string> loads;
    for (const LoadDef& l : scene_.loads)
      loads.push_back(fmt::format("{} ({}{})", l.name, kind_name(scene_, l), scale_name(scene_, l)));
    std::vector<std::string> heavy;
    for (const BodyDef& b : scene_.bodies)
      if (scene_.gravity && b.mass > 0)
        heavy.push_back(fmt::format("{} {:g} kg", b.name, b.mass));
      else if (scene_.gravity && b.solid)
        heavy.push_back(b.name + " of " + b.solid->file.text());
    effect("rigid contact", scene_.contacts.size(), "pairs: " + joined(pairs));
    effect("cartilage layer", layers.size(), "pairs: " + joined(layers) + "; no unknowns");
    effect("ligaments", scene_.ligaments.size(), "laws: " + joined(laws) + "; no unknowns");
    effect("bushings", scene_.bushings.size(), "springs between frames of two bodies; no unknowns");
    effect("loads", scene_.loads.size(), joined(loads) + "; no unknowns");
    effect("gravity", heavy.size(), "weights: " + joined(heavy) + "; no unknowns");
    if (scene_.dynamics) effect("dynamics", 1, "inertia and dampers; motion over time in the place of steps");
    if (!off_.empty()) line("off", joined(off_) + ": not named by the scene, costs nothing");
  }

  std::string quadrature_name(const LayerDef& l) const {
    if (l.quadrature == LayerDef::Quadrature::smooth)
      return fmt::format("summed over smooth surfaces to {:g} of the force", l.tolerance);
    return "rays from the triangles of " + scene_.surfaces[at(l.cast_from)].name +
           (l.rim == LayerDef::Rim::cut ? ", cut at the rim" : "");
  }

  std::string value(const StepDef::Prescribed& p) const {
    const bool angle = p.coordinate.is_rotation();
    const double unit = angle ? 180 / M_PI : 1e3;
    const char* word = angle ? "deg" : "mm";
    const std::string name = quantity_name(scene_, p.coordinate);
    if (p.from == p.to) return fmt::format("{} held at {:.6g} {}", name, unit * p.to, word);
    return fmt::format("{} from {:.6g} to {:.6g} {}", name, unit * p.from, unit * p.to, word);
  }

  void row(std::size_t unknowns, const std::string& what, std::size_t equations, const std::string& balance) {
    out_ += fmt::format("    {:>4}  {:<44}{:>4}  {}\n", unknowns, what, equations, balance);
  }

  /// "time 0 to 2 s", where the file asks for a duration or a load changes in time.
  std::string time_of(std::size_t i) const {
    double start = 0;
    for (std::size_t k = 0; k < i; ++k) start += scene_.steps[k].duration;
    const auto in_time = [](const LoadDef& l) { return l.in_time(); };
    const bool shown = scene_.steps[i].duration != 1 || std::any_of(scene_.loads.begin(), scene_.loads.end(), in_time);
    return shown ? fmt::format(", time {:g} to {:g} s", start, start + scene_.steps[i].duration) : std::string();
  }

  void motion(const DynamicsDef& d) {
    std::size_t moving = 0, held = 0;
    for (const BodyDef& body : scene_.bodies) moving += body.fixed ? 0 : 1;
    for (const JointDef& joint : scene_.joints)
      held += joint.type == JointDef::Type::free ? 0 : joint.type == JointDef::Type::fixed ? 6 : 5;
    out_ += fmt::format("\nmotion: {:g} s, a row every {:g} s, tolerance {:g}\n", d.duration, d.output_interval,
                        d.tolerance);
    out_ += "        unknowns                                            equations\n";
    row(6 * moving, "accelerations of the moving bodies", 6 * moving, "M a + b = forces + what joints exert");
    row(held, "reactions of joints", held, "J a = -J' v: joints hold their coordinates");
    out_ += fmt::format("    {:>4}  in all at each moment; {} freedoms\n", 6 * moving + held, 6 * moving - held);
  }

  void step(std::size_t i) {
    const StepDef& s = scene_.steps[i];
    std::vector<std::string> changes;
    for (const auto& p : s.prescribe) changes.push_back(value(p));
    for (const auto& f : s.factors)
      changes.push_back(f.from == f.to
                            ? fmt::format("load {} x {:g}", scene_.loads[at(f.load)].name, f.to)
                            : fmt::format("load {} x {:g} to {:g}", scene_.loads[at(f.load)].name, f.from, f.to));
    out_ += fmt::format("\nstep {}: {}{}; {}\n", i + 1, counted(at(s.increments), "increment"), time_of(i),
                        changes.empty() ? "free equilibrium" : joined(changes));
    system(s);
  }

  void system(const StepDef& s) {
    out_ += "        unknowns                                            equations\n";
    std::size_t moving = 0;
    for (const BodyDef& body : scene_.bodies) {
      if (body.fixed) continue;
      ++moving;
      row(6, fmt::format("twist of {}", body.name), 6, "its equilibrium: 3 forces, 3 moments");
    }
    for (const auto& p : s.prescribe) {
      const std::string name = quantity_name(scene_, p.coordinate);
      if (!p.drivers.empty()) {
        std::vector<std::string> loads;
        for (const int driver : p.drivers) loads.push_back(scene_.loads[at(driver)].name);
        row(1, "factor of " + joined(loads), 1, name + " = its value");
        continue;
      }
      row(1, fmt::format("reaction of {} ({})", name, p.coordinate.is_rotation() ? "moment" : "force"), 1,
          name + " = its value");
    }
    std::size_t constraints = s.prescribe.size();
    for (const JointDef& joint : scene_.joints) {
      if (joint.type == JointDef::Type::free) continue;
      const std::size_t held = joint.type == JointDef::Type::fixed ? 6 : 5;
      constraints += held;
      row(held, fmt::format("reaction of {} (3 forces, {} moments)", joint.name, held - 3), held,
          "what the joint holds = its value");
    }
    if (s.arc_length) row(1, "how far the step has come", 1, "by arc length from the last pose");
    const std::size_t square = 6 * moving + constraints + (s.arc_length ? 1 : 0);
    if (scene_.contacts.empty()) {
      out_ += fmt::format("    {:>4}  in all\n", square);
      return;
    }
    out_ +=
        "     5 N  for each of N contact points found: where       5 N  closure 2, gap 1, tangency 2\n"
        "          on either surface (2 + 2), normal force\n";
    const std::size_t most = 6 * moving - std::min(6 * moving, constraints);
    out_ += fmt::format("     {} + 5 N in all (6B + M + 5N{}: B = {}, M = {}); room for N <= {}", square,
                        s.arc_length ? " + 1" : "", moving, constraints, most);
    const std::size_t likely = std::min(most, scene_.contacts.size());
    out_ += fmt::format("; N = {}: {} x {}\n", likely, square + 5 * likely, square + 5 * likely);
  }

  const SceneTables& scene_;
  std::vector<std::string> off_;
  std::string last_head_, out_;
};

}  // namespace

std::string explain(const SceneTables& scene) { return Explanation(scene).text(); }

}  // namespace genu
