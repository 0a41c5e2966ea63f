#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/osim/path_plan.h"
#include "genu/osim/scene_draft.h"

namespace genu::osim {
namespace {

constexpr const char* kStays = "pulls on one rigid body alone: no effect while the rest is frozen";
constexpr const char* kOff = "its appliesForce is false in the model";

/// The side of a wrap object that its quadrant names, as a direction of the body; empty where it is "all".
std::string side_text(const WrapObject& w, const Pose& X_rigid_wrap) {
  const bool against = w.quadrant.starts_with('-');
  const std::string axis = w.quadrant.substr(against || w.quadrant.starts_with('+') ? 1 : 0);
  if (axis != "x" && axis != "y" && axis != "z") return {};
  return vector_text(X_rigid_wrap.R.col(axis[0] - 'x') * (against ? -1 : 1));
}

class PathWriter {
 public:
  explicit PathWriter(SceneDraft& draft) : draft_(draft) {}

  void write_ligament(const Ligament& l) {
    const PathPlan plan = plan_of(l.path, l.applies, l.where);
    if (plan.points.empty()) return;
    const std::string name = draft_.ligaments.of(l.where, l.name);
    sections_ += fmt::format("{}\n[ligament.{}]\n{}", source_comment(l.type, l.name, l.where), name, path_text(plan));
    sections_ += law_text(l) + "\n";
    std::string detail = remarks_of(plan);
    if (l.damping != 0)
      detail += (detail.empty() ? "" : "; ") + fmt::format("damping {:g} acts in motion only", l.damping);
    draft_.outcomes.kept(l.where, "ligament." + name, {}, detail);
  }

  void write_muscle(const Muscle& m) {
    const PathPlan plan = plan_of(m.path, m.applies, m.where);
    if (plan.points.empty()) return;
    const std::string name = draft_.loads.of(m.where, m.name);
    const auto given = draft_.request.tensions.find(m.name);
    const bool has = given != draft_.request.tensions.end();
    std::string detail = remarks_of(plan);
    if (has && given->second < 0)
      detail += (detail.empty() ? "" : "; ") +
                fmt::format("WARNING: it would push with {:g} N, which no cable does: here 0", -given->second);
    sections_ += fmt::format("{}; largest isometric force {:g} N\n[load.{}]\n{}magnitude = {}\n\n",
                             source_comment(m.type, m.name, m.where), m.max_isometric_force, name, path_text(plan),
                             number_text(has ? std::max(0.0, given->second) : 0));
    draft_.outcomes.kept(m.where, "load." + name,
                         has ? "a cable with the tension given" : "a cable without tension: --forces gives one",
                         detail);
  }

  /// The surfaces, then what wraps round them.
  void finish(const char* heading) {
    draft_.text += heading + std::exchange(surfaces_, {}) + std::exchange(sections_, {});
  }

  void tell_unused_wraps() {
    for (const WrapObject& w : draft_.model.wraps)
      if (written_.count(&w) == 0) draft_.outcomes.left_out(w.where, "no path that is imported wraps round it");
  }

 private:
  /// Without points where the path is left out.
  PathPlan plan_of(const GeometryPath& path, bool applies, const SourceLocation& where) {
    PathPlan plan = plan_path(draft_.model, draft_.skeleton, path);
    if (!applies)
      draft_.outcomes.left_out(where, kOff);
    else if (!plan.problem.empty())
      draft_.outcomes.left_out(where, "WARNING: its path cannot be imported", plan.problem);
    else if (!plan.crosses())
      draft_.outcomes.left_out(where, kStays);
    else
      return plan;
    return {};
  }

  static std::string remarks_of(const PathPlan& plan) {
    std::string text;
    for (const std::string& remark : plan.remarks) text += (text.empty() ? "" : "; ") + remark;
    return text;
  }

  std::string end_text(const PathPlan::Point& p) {
    return fmt::format("{{ body = \"{}\", point = {} }}", draft_.body_name(p.rigid), point_text(p.point));
  }

  std::string wrap_text(const WrapObject& w) {
    const std::string name = surface_of(w), side = side_text(w, place_wrap(draft_.skeleton, w).X_rigid_wrap);
    return fmt::format("{{ surface = \"{}\",{} inside = \"ignore\" }}", name,
                       side.empty() ? "" : " side = " + side + ",");
  }

  std::string path_text(const PathPlan& plan) {
    std::string between;
    std::size_t wrap = 0;
    for (std::size_t k = 0; k + 1 < plan.points.size(); ++k) {
      if (k > 0) between += (between.empty() ? "" : ", ") + end_text(plan.points[k]);
      for (; wrap < plan.wraps.size() && plan.wraps[wrap].after == k; ++wrap)
        between += (between.empty() ? "" : ", ") + wrap_text(*plan.wraps[wrap].object);
    }
    const char* key = plan.points.size() == 2 ? "wrap" : plan.wraps.empty() ? "via" : "path";
    return fmt::format("from = {}\nto = {}\n", end_text(plan.points.front()), end_text(plan.points.back())) +
           (between.empty() ? "" : fmt::format("{} = [{}]\n", key, between));
  }

  static std::string law_text(const Ligament& l) {
    const std::string slack = fmt::format("slack_length = {}\n", number_text(l.slack_length * to::kMillimetre));
    if (l.law == Ligament::Law::spring)
      return fmt::format("law = \"spring\"\nstiffness = {}\n", number_text(l.stiffness * units::kMillimetre)) + slack;
    if (l.law == Ligament::Law::linear)
      return fmt::format("law = \"linear\"\nstiffness = {}\n", number_text(l.stiffness)) + slack;
    return fmt::format("law = \"blankevoort\"\nstiffness = {}\n", number_text(l.stiffness)) + slack +
           fmt::format("transition_strain = {}\n", number_text(l.transition_strain));
  }

  static std::string shape_text(const WrapObject& w) {
    switch (w.kind) {
      case WrapObject::Kind::ellipsoid:
        return fmt::format("shape = \"ellipsoid\"\nradii = {}\n", point_text(w.radii));
      case WrapObject::Kind::cylinder:
        return fmt::format("shape = \"cylinder\"\nradius = {}\n", number_text(w.radius * to::kMillimetre));
      case WrapObject::Kind::sphere:
        return fmt::format("shape = \"sphere\"\nradius = {}\n", number_text(w.radius * to::kMillimetre));
      case WrapObject::Kind::torus:
        return fmt::format("shape = \"torus\"\nmajor_radius = {}\nminor_radius = {}\n",
                           number_text(w.ring * to::kMillimetre), number_text(w.radius * to::kMillimetre));
    }
    return {};
  }

  std::string surface_of(const WrapObject& w) {
    const std::string name = draft_.surfaces.of(w.where, w.name);
    if (!written_.insert(&w).second) return name;
    const auto [rigid, X] = place_wrap(draft_.skeleton, w);
    surfaces_ += fmt::format("{}\n[surface.{}]\nbody = \"{}\"\n{}origin = {}\nx_axis = {}\nz_axis = {}\n\n",
                             source_comment(w.type, w.name, w.where), name, draft_.body_name(rigid), shape_text(w),
                             point_text(X.p), vector_text(X.R.col(0)), vector_text(X.R.col(2)));
    draft_.outcomes.kept(w.where, "surface." + name,
                         w.kind == WrapObject::Kind::cylinder ? "without ends: in the model it has a length" : "");
    return name;
  }

  SceneDraft& draft_;
  std::string surfaces_, sections_;
  std::set<const WrapObject*> written_;
};

/// -k (q - q0) is feedback of the coordinate on itself; a scene has its gain per mm or deg.
void write_spring(SceneDraft& draft, const CoordinateSpring& s) {
  const std::string coordinate = draft.coordinate_name(s.coordinate);
  // SI per unit of the scene
  const double unit = is_angle(draft.model, s.coordinate) ? units::kDegree : units::kMillimetre;
  const std::string name = draft.loads.of(s.where, s.name);
  draft.text +=
      fmt::format("{}\n[load.{}]\non = \"{}\"\nscale = {{ feedback = {{ of = \"{}\", target = {}, gain = {} }} }}\n\n",
                  source_comment("SpringGeneralizedForce", s.name, s.where), name, coordinate, coordinate,
                  number_text(s.rest / unit), number_text(s.stiffness * unit));
  draft.outcomes.kept(s.where, "load." + name, {},
                      s.viscosity != 0 ? fmt::format("viscosity {:g} acts in motion only", s.viscosity) : "");
}

}  // namespace

void write_paths(SceneDraft& draft) {
  PathWriter writer(draft);
  for (const Ligament& l : draft.model.ligaments) writer.write_ligament(l);
  writer.finish(
      "# --- Ligaments, with what they wrap round: shortest paths. An end inside a surface passes through, as in "
      "OpenSim ---\n");
  for (const Muscle& m : draft.model.muscles) writer.write_muscle(m);
  writer.finish("# --- Muscles: cables, `magnitude` is the tension in N ---\n");
  writer.tell_unused_wraps();
}

void write_springs(SceneDraft& draft) {
  for (const CoordinateSpring& s : draft.model.springs) {
    if (!s.applies)
      draft.outcomes.left_out(s.where, kOff);
    else if (!draft.skeleton.moves(s.coordinate))
      draft.outcomes.left_out(s.where, "acts on a coordinate that is frozen or unknown");
    else if (s.stiffness == 0)
      draft.outcomes.left_out(s.where, "has no stiffness: without effect at rest; its viscosity would damp motion",
                              fmt::format("viscosity {:g}", s.viscosity));
    else
      write_spring(draft, s);
  }
}

}  // namespace genu::osim
