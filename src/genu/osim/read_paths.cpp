#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "genu/osim/frames.h"
#include "genu/osim/read_parts.h"

namespace genu::osim {
namespace {

constexpr const char* kQuadrants[] = {"", "all", "x", "+x", "-x", "y", "+y", "-y", "z", "+z", "-z"};

PathPoint::Moving read_moving(const FileReader& reader, const XmlElement& e) {
  const PropertyReader p(reader, e);
  PathPoint::Moving moving;
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    moving.coordinates[at(i)] = p.coordinate(axis + "_");
    if (const XmlElement* location = e.child(axis + "_location"))
      moving.functions[at(i)] = PropertyReader(reader, *location).function(*location);
  }
  return moving;
}

PathPoint read_point(const FileReader& reader, const XmlElement& e, const std::string& path, const Model& model) {
  const PropertyReader p(reader, e);
  PathPoint point{e.name(),
                  frame_path(model, p.socket("parent_frame"), path + "/" + e.name()),
                  p.vector("location", Vec3::Zero()),
                  {},
                  {},
                  e.where};
  if (e.tag == "MovingPathPoint") {
    point.moving = read_moving(reader, e);
  } else if (e.tag == "ConditionalPathPoint") {
    const std::vector<double> range = p.numbers("range");
    if (range.size() != 2)
      p.refuse(Code::wrong_form, p.where("range"), "range", p.word("range"), "must be two numbers");
    else
      point.condition = PathPoint::Condition{p.coordinate(), range[0], range[1]};
  } else if (e.tag != "PathPoint") {
    p.refuse(Code::not_built, e.where, {}, {},
             "is a kind of point that genu does not read (it reads PathPoint, ConditionalPathPoint, MovingPathPoint)");
  }
  return point;
}

PathWrap read_wrap(const FileReader& reader, const XmlElement& e) {
  const PropertyReader p(reader, e);
  PathWrap wrap{p.word("wrap_object"), p.word("method", "hybrid"), -1, -1, e.where};
  if (wrap.object.empty()) p.refuse(Code::missing_key, e.where, "wrap_object", {}, "is missing");
  const std::vector<double> range = p.numbers("range");
  constexpr double kMostPathPoints = 1e6;
  for (const double end : range)
    if (range.size() != 2 || std::abs(end) > kMostPathPoints) {
      p.refuse(Code::wrong_form, p.where("range"), "range", p.word("range"), "must be two numbers of points");
      return wrap;
    }
  if (range.size() == 2) {
    wrap.first = static_cast<int>(range[0]);
    wrap.last = static_cast<int>(range[1]);
  }
  return wrap;
}

}  // namespace

GeometryPath read_path(const FileReader& reader, const XmlElement& owner, const Model& model) {
  GeometryPath path;
  const PropertyReader p(reader, owner);
  const XmlElement* e = owner.child("GeometryPath");
  if (e == nullptr) {
    p.refuse(Code::missing_key, owner.where, "GeometryPath", {}, "is missing");
    return path;
  }
  if (const XmlElement* points = e->objects_of("PathPointSet"))
    for (const XmlElement& point : points->children)
      path.points.push_back(read_point(reader, point, "/forceset/" + owner.name() + "/geometrypath", model));
  if (const XmlElement* wraps = e->objects_of("PathWrapSet"))
    for (const XmlElement& wrap : wraps->children) path.wraps.push_back(read_wrap(reader, wrap));
  if (path.points.size() < 2)
    p.refuse(Code::wrong_form, e->where, "PathPointSet", fmt::format("{}", path.points.size()),
             "a path has two points or more");
  return path;
}

bool read_wrap_object(const FileReader& reader, const XmlElement& e, const std::string& frame, Model& model) {
  const PropertyReader p(reader, e);
  WrapObject w;
  w.type = e.tag;
  w.name = e.name();
  w.frame = frame;
  w.active = p.flag("active", true);
  w.X_body_wrap = p.placement("xyz_body_rotation", "translation");
  w.quadrant = p.word("quadrant", "all");
  if (std::find(std::begin(kQuadrants), std::end(kQuadrants), w.quadrant) == std::end(kQuadrants))
    p.refuse(Code::unknown_name, p.where("quadrant"), "quadrant", w.quadrant, "must be all, x, -x, y, -y, z or -z");
  w.where = e.where;
  if (e.tag == "WrapEllipsoid") {
    w.kind = WrapObject::Kind::ellipsoid;
    w.radii = p.vector("dimensions", Vec3::Zero());
    if (!(w.radii.minCoeff() > 0))
      p.refuse(Code::out_of_range, p.where("dimensions"), "dimensions", p.word("dimensions"), "must be > 0");
  } else if (e.tag == "WrapCylinder") {
    w.kind = WrapObject::Kind::cylinder;
    w.radius = p.positive("radius");
    w.length = p.number("length", 0);
  } else if (e.tag == "WrapSphere") {
    w.kind = WrapObject::Kind::sphere;
    w.radius = p.positive("radius");
  } else if (e.tag == "WrapTorus") {
    w.kind = WrapObject::Kind::torus;
    w.radius = p.positive("inner_radius");
    w.ring = p.positive("outer_radius");
  } else {
    return false;
  }
  model.wraps.push_back(std::move(w));
  return true;
}

}  // namespace genu::osim
