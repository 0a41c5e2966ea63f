#include "genu/osim/references.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "genu/osim/frames.h"
#include "genu/scene/words.h"

namespace genu::osim {
namespace {

bool one_of(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class References {
 public:
  References(const Model& model, Diagnostics& out) : model_(model), out_(out) {
    frames_.push_back("/ground");
    for (const Body& b : model.bodies) frames_.push_back("/bodyset/" + b.name);
    for (const OffsetFrame& f : model.frames) frames_.push_back(f.path);
    for (const Joint& j : model.joints)
      for (const Coordinate& c : j.coordinates) coordinates_.push_back(c.name);
    for (const ContactMesh& m : model.contact_meshes) meshes_.push_back(m.name);
  }

  void check() {
    for (const OffsetFrame& f : model_.frames) frame(f.parent, "PhysicalOffsetFrame " + f.name, f.where);
    for (const Joint& j : model_.joints)
      for (const std::string& socket : {j.parent, j.child}) frame(socket, j.type + " " + j.name, j.where);
    for (const WrapObject& w : model_.wraps) frame(w.frame, w.type + " " + w.name, w.where);
    for (const Ligament& l : model_.ligaments) path(l.path);
    for (const Muscle& m : model_.muscles) path(m.path);
    for (const ContactMesh& m : model_.contact_meshes) frame(m.frame, "Smith2018ContactMesh " + m.name, m.where);
    for (const ContactForce& c : model_.contact_forces)
      for (const std::string& socket : {c.target, c.casting}) mesh(socket, c);
    for (const CoordinateSpring& s : model_.springs)
      coordinate(s.coordinate, "SpringGeneralizedForce " + s.name, s.where);
    for (const Coupler& c : model_.couplers)
      for (const std::string& name : {c.independent, c.dependent}) coordinate(name, named(c), c.where);
    chains_of_couplers();
  }

 private:
  static std::string named(const Coupler& c) { return "CoordinateCouplerConstraint " + c.name; }

  void refuse(Code code, const std::string& key, const SourceLocation& where, const std::string& found,
              const std::string& rule) {
    out_.add(error_at({model_.file, where}, code, key, found, rule));
  }

  void frame(const std::string& path, const std::string& key, const SourceLocation& where) {
    if (find_frame(model_, path)) return;
    refuse(Code::unknown_name, key, where, path,
           one_of(frames_, path) ? "hangs on frames that lead to no body of the model"
                                 : "is no frame or body of the model" + did_you_mean(path, frames_));
  }

  void coordinate(const std::string& name, const std::string& key, const SourceLocation& where) {
    if (!one_of(coordinates_, name))
      refuse(
          Code::unknown_name, key, where, name,
          (name.empty() ? "names no coordinate" : "is no coordinate of the model") + did_you_mean(name, coordinates_));
  }

  void mesh(const std::string& socket, const ContactForce& c) {
    if (!one_of(meshes_, last_name(socket)))
      refuse(Code::unknown_name, "Smith2018ArticularContactForce " + c.name, c.where, socket,
             "is no Smith2018ContactMesh of the model" + did_you_mean(last_name(socket), meshes_));
  }

  void path(const GeometryPath& path) {
    for (const PathPoint& point : path.points) {
      const std::string key = "path point " + point.name;
      frame(point.frame, key, point.where);
      if (point.condition) coordinate(point.condition->coordinate, key, point.where);
      if (!point.moving) continue;
      for (const std::string& name : point.moving->coordinates) coordinate(name, key, point.where);
    }
  }

  void chains_of_couplers() {
    std::map<std::string, const Coupler*> driver;
    for (const Coupler& c : model_.couplers)
      if (c.enforced && !driver.emplace(c.dependent, &c).second)
        refuse(Code::duplicate, named(c), c.where, c.dependent,
               "is driven by " + driver[c.dependent]->name + " too: one coordinate, one coupler");
    for (const Coupler& c : model_.couplers) {
      if (!c.enforced) continue;
      std::string at = c.independent;
      for (std::size_t steps = 0; steps < driver.size() && at != c.dependent && driver.count(at) > 0; ++steps)
        at = driver[at]->independent;
      if (at == c.dependent)
        refuse(Code::not_built, named(c), c.where, c.dependent, "drives itself, through the couplers of the model");
    }
  }

  const Model& model_;
  Diagnostics& out_;
  std::vector<std::string> frames_, coordinates_, meshes_;
};

}  // namespace

void check_references(const Model& model, Diagnostics& out) { References(model, out).check(); }

}  // namespace genu::osim
