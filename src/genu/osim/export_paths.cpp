#include <algorithm>
#include <cmath>
#include <optional>

#include "genu/osim/model_draft.h"
#include "genu/osim/scene_words.h"
#include "genu/osim/tolerances.h"

namespace genu::osim {
namespace {

constexpr double kWrapCylinderLength = 1;  // m: genu's cylinders have no ends, OpenSim's have

/// Angles of successive rotations about x, y and z. Where the second is 90 deg the third is taken as 0.
Vec3 xyz_angles(const Mat3& R) {
  const double cosine = std::hypot(R(0, 0), R(0, 1)), second = std::atan2(R(0, 2), cosine);
  if (cosine < kAxisRounding) return {std::atan2(R(2, 1), R(1, 1)), second, 0};
  return {std::atan2(-R(1, 2), R(2, 2)), second, std::atan2(-R(0, 1), R(0, 0))};
}

/// The axis of the frame that a side lies along: "x", "-z"; empty where it is none.
std::string quadrant_of(const Vec3& side, const Mat3& R) {
  for (int i = 0; i < 3; ++i) {
    const double along = R.col(i).dot(side.normalized());
    if (std::abs(along) >= 1 - kAxisRounding) return (along < 0 ? "-" : "") + std::string(1, "xyz"[i]);
  }
  return {};
}

const char* tag_of(SurfaceDef::Shape shape) {
  switch (shape) {
    case SurfaceDef::Shape::sphere:
      return "WrapSphere";
    case SurfaceDef::Shape::ellipsoid:
      return "WrapEllipsoid";
    case SurfaceDef::Shape::cylinder:
      return "WrapCylinder";
    case SurfaceDef::Shape::torus:
      return "WrapTorus";
    default:
      return nullptr;
  }
}

/// The surface's frame, turned where its shape allows so that x is the side.
Mat3 turned_to(const SurfaceDef& s, const std::optional<Vec3>& side) {
  if (!side || !quadrant_of(*side, s.placement.R).empty()) return s.placement.R;
  const Vec3 x = side->normalized(), z = s.placement.R.col(2);
  const bool round = s.shape == SurfaceDef::Shape::cylinder || s.shape == SurfaceDef::Shape::torus;
  Mat3 R = s.placement.R;
  if (s.shape == SurfaceDef::Shape::sphere) {
    R.col(2) = x.unitOrthogonal();
  } else if (!round || std::abs(x.dot(z)) > kAxisRounding) {
    return R;
  }
  R.col(0) = x;
  R.col(1) = R.col(2).cross(x);
  return R;
}

class PathExporter {
 public:
  PathExporter(ModelDraft& draft, XmlWriter& out) : draft_(draft), out_(out) {}

  void ligament(std::size_t index) {
    const LigamentDef& l = draft_.scene.ligaments[index];
    const double slack = draft_.request.slack_lengths[index];
    const bool straight = l.via.empty() && l.wraps.empty();
    if (const std::string why = why_not(l.wraps); !why.empty()) return draft_.left_out("ligament", l.name, why);
    if (l.law == "blankevoort")
      blankevoort(l, slack);
    else if (l.law == "linear")
      path_spring(l, slack);
    else if (l.law == "spring" && straight)
      point_spring(l, slack);
    else
      return draft_.left_out("ligament", l.name,
                             l.law == "spring" ? "WARNING: a spring of OpenSim has no points between its ends"
                                               : "WARNING: OpenSim has no ligament with the law " + l.law);
    draft_.kept("ligament", l.name, "/forceset/" + l.name, remarks(l.wraps, l.damping != 0));
  }

  void cable(const LoadDef& l) {
    if (const std::string why = why_not(l.wraps); !why.empty()) return draft_.left_out("load", l.name, why);
    out_.open("PathActuator", l.name);
    path(l.points, l.wraps);
    out_.number("optimal_force", 1);
    out_.close("PathActuator");
    draft_.forces_head += "\t/forceset/" + l.name + "/actuation";
    draft_.forces_row += fmt::format("\t{}", l.value * l.activation);
    draft_.kept("load", l.name, "/forceset/" + l.name,
                std::string("its tension is in forces.sto") + (l.scale ? "; WARNING: its scale is left out" : "") +
                    (by_steps(l) ? "; WARNING: the factor that steps give it is left out" : ""));
  }

 private:
  /// Whether a step changes the load's factor, or asks for it.
  bool by_steps(const LoadDef& l) const {
    const int load = static_cast<int>(&l - draft_.scene.loads.data());
    for (const StepDef& step : draft_.scene.steps) {
      for (const auto& p : step.prescribe)
        if (std::find(p.drivers.begin(), p.drivers.end(), load) != p.drivers.end()) return true;
      for (const auto& f : step.factors)
        if (f.load == load && (f.from != 1 || f.to != 1)) return true;
    }
    return false;
  }

  std::string why_not(const std::vector<WrapDef>& wraps) const {
    for (const WrapDef& w : wraps) {
      const SurfaceDef& s = draft_.scene.surfaces[at(w.surface)];
      if (tag_of(s.shape) == nullptr || s.inside)
        return "WARNING: wraps round surface." + s.name + ", which OpenSim has no wrap object for";
      if (w.side && quadrant_of(*w.side, turned_to(s, w.side)).empty())
        return "WARNING: its side of surface." + s.name + " is no axis of that surface, as OpenSim's quadrants are";
    }
    return {};
  }

  std::string remarks(const std::vector<WrapDef>& wraps, bool damped) const {
    bool inside = false;
    for (const WrapDef& w : wraps) inside |= !w.ignore_inside;
    std::string text = inside ? "in OpenSim it passes through an obstacle that one of its ends lies in" : "";
    if (damped) text += std::string(text.empty() ? "" : "; ") + "its damping is left out";
    return text;
  }

  void blankevoort(const LigamentDef& l, double slack) {
    out_.open("Blankevoort1991Ligament", l.name);
    path(l.path_points(), l.wraps);
    out_.number("linear_stiffness", l.number("stiffness"));
    out_.number("transition_strain", l.number("transition_strain"));
    out_.number("damping_coefficient", 0);
    out_.number("slack_length", slack);
    out_.close("Blankevoort1991Ligament");
  }

  void path_spring(const LigamentDef& l, double slack) {
    out_.open("PathSpring", l.name);
    path(l.path_points(), l.wraps);
    out_.number("resting_length", slack);
    out_.number("stiffness", l.number("stiffness") / slack);
    out_.number("dissipation", 0);
    out_.close("PathSpring");
  }

  void point_spring(const LigamentDef& l, double slack) {
    out_.open("PointToPointSpring", l.name);
    out_.text("socket_body1", draft_.body_path(l.from.body));
    out_.text("socket_body2", draft_.body_path(l.to.body));
    out_.vector("point1", l.from.point);
    out_.vector("point2", l.to.point);
    out_.number("stiffness", l.number("stiffness"));
    out_.number("rest_length", slack);
    out_.close("PointToPointSpring");
  }

  void path(const std::vector<PathEnd>& points, const std::vector<WrapDef>& wraps) {
    out_.open("GeometryPath", "geometrypath");
    out_.open("PathPointSet");
    out_.open("objects");
    for (std::size_t k = 0; k < points.size(); ++k) {
      out_.open("PathPoint", fmt::format("p{}", k + 1));
      out_.text("socket_parent_frame", draft_.body_path(points[k].body));
      out_.vector("location", points[k].point);
      out_.close("PathPoint");
    }
    out_.close("objects");
    out_.close("PathPointSet");
    if (!wraps.empty()) path_wraps(wraps);
    out_.close("GeometryPath");
  }

  void path_wraps(const std::vector<WrapDef>& wraps) {
    out_.open("PathWrapSet");
    out_.open("objects");
    for (std::size_t k = 0; k < wraps.size(); ++k) {
      out_.open("PathWrap", fmt::format("w{}", k + 1));
      out_.text("wrap_object", wrap_object(wraps[k]));
      out_.text("method", "hybrid");
      out_.text("range", fmt::format("{} {}", wraps[k].after + 1, wraps[k].after + 2));
      out_.close("PathWrap");
    }
    out_.close("objects");
    out_.close("PathWrapSet");
  }

  /// The name of the object, which is written when it is first asked for. Each side has one of its own.
  std::string wrap_object(const WrapDef& w) {
    const SurfaceDef& s = draft_.scene.surfaces[at(w.surface)];
    const std::string side = w.side ? vector_text(*w.side) : std::string();
    std::string& name = draft_.wraps[{w.surface, side}];
    if (!name.empty()) return name;
    std::size_t others = 0;
    for (const auto& [key, known] : draft_.wraps) others += key.first == w.surface && !known.empty();
    name = others == 0 ? s.name : fmt::format("{}_side{}", s.name, others + 1);
    XmlWriter& out = draft_.wrap_objects[s.body];
    const Mat3 R = turned_to(s, w.side);
    out.open(tag_of(s.shape), name);
    out.flag("active", true);
    out.vector("xyz_body_rotation", xyz_angles(R));
    out.vector("translation", s.placement.p);
    out.text("quadrant", w.side ? quadrant_of(*w.side, R) : "all");
    size(s, out);
    out.close(tag_of(s.shape));
    return name;
  }

  static void size(const SurfaceDef& s, XmlWriter& out) {
    if (s.shape == SurfaceDef::Shape::ellipsoid) return out.vector("dimensions", s.radii);
    if (s.shape == SurfaceDef::Shape::torus) {
      out.number("inner_radius", s.minor_radius);
      return out.number("outer_radius", s.major_radius);
    }
    out.number("radius", s.radius);
    if (s.shape == SurfaceDef::Shape::cylinder) out.number("length", kWrapCylinderLength);
  }

  ModelDraft& draft_;
  XmlWriter& out_;
};

}  // namespace

void write_path_forces(ModelDraft& draft, XmlWriter& out) {
  PathExporter exporter(draft, out);
  for (std::size_t i = 0; i < draft.scene.ligaments.size(); ++i) exporter.ligament(i);
  for (const LoadDef& l : draft.scene.loads)
    if (l.kind == LoadDef::Kind::cable) exporter.cable(l);
}

}  // namespace genu::osim
