#include "genu/assemble/parameter_values.h"

#include <vector>

#include <fmt/format.h>

#include "genu/law/laws.h"

namespace genu {
namespace {

using Kind = Parameter::Kind;

/// Keys from the root, and the element of the array they lead to.
struct Path {
  std::vector<std::string> keys;
  int via = -1;      ///< element of the array at the last key, and then `point`
  int element = -1;  ///< of the array at the end
  double unit = 1;
};

Path ligament_path(const SceneTables& scene, const Parameter& p) {
  const LigamentDef& l = scene.ligaments[at(p.object)];
  const double length = scene.length_unit;
  const auto of = [&](const std::string& key, double unit) { return Path{{"ligament", l.name, key}, -1, -1, unit}; };
  switch (p.kind) {
    case Kind::law_number:
      return of(l.numbers[at(p.component)].key, find_law(l.law)->numbers[at(p.component)].si(length));
    case Kind::slack_length:
      return of("slack_length", length);
    case Kind::reference_strain:
      return of("reference_strain", 1);
    case Kind::reference_force:
      return of("reference_force", 1);
    case Kind::damping:
      return of("damping", 1 / length);
    case Kind::via_point:
      return {{"ligament", l.name, "via"}, p.component / 3, p.component % 3, length};
    default:
      return {{"ligament", l.name, p.kind == Kind::from_point ? "from" : "to", "point"}, -1, p.component, length};
  }
}

Path load_path(const SceneTables& scene, const Parameter& p) {
  const LoadDef& l = scene.loads[at(p.object)];
  switch (p.kind) {
    case Kind::force:
      return {{"load", l.name, "force"}, -1, p.component, 1};
    case Kind::moment:
      return {{"load", l.name, "moment"}, -1, p.component, 1};
    case Kind::point:
      return {{"load", l.name, "point"}, -1, p.component, scene.length_unit};
    case Kind::toward_point:
      return {{"load", l.name, "toward", "point"}, -1, p.component, scene.length_unit};
    default:
      return {{"load", l.name, l.kind == LoadDef::Kind::toward ? "magnitude" : "value"}, -1, -1, 1};
  }
}

Path path_of(const SceneTables& scene, const Parameter& p) {
  if (p.of_ligament()) return ligament_path(scene, p);
  if (p.of_load()) return load_path(scene, p);
  if (p.of_joint())
    return {{"joint", scene.joints[at(p.object)].name, p.kind == Kind::joint_stiffness ? "stiffness" : "damping"},
            -1,
            -1,
            1 / scene.angle_unit};
  const std::string& body = scene.bodies[at(p.object)].name;
  if (p.kind == Kind::mass) return {{"body", body, "mass"}, -1, -1, 1};
  return {{"body", body, "centre_of_mass"}, -1, p.component, scene.length_unit};
}

double* ligament_number(LigamentDef& l, const Parameter& p) {
  switch (p.kind) {
    case Kind::law_number:
      return &l.numbers[at(p.component)].value;
    case Kind::slack_length:
    case Kind::reference_strain:
    case Kind::reference_force:
      return &l.rest_value;
    case Kind::damping:
      return &l.damping;
    case Kind::from_point:
      return &l.from.point[p.component];
    case Kind::to_point:
      return &l.to.point[p.component];
    case Kind::via_point:
      return &l.via[at(p.component / 3)].point[p.component % 3];
    default:
      return nullptr;
  }
}

double* load_number(LoadDef& l, const Parameter& p) {
  switch (p.kind) {
    case Kind::force:
      return &l.force[p.component];
    case Kind::moment:
      return &l.moment[p.component];
    case Kind::point:
      return &l.point[p.component];
    case Kind::toward_point:
      return &l.toward_point[p.component];
    case Kind::magnitude:
      return &l.value;
    default:
      return nullptr;
  }
}

}  // namespace

double* parameter_number(Scene& scene, const Parameter& p) {
  if (p.of_ligament()) return ligament_number(scene.ligaments[at(p.object)], p);
  if (p.of_load()) return load_number(scene.loads[at(p.object)], p);
  switch (p.kind) {
    case Kind::joint_stiffness:
      return &scene.joints[at(p.object)].stiffness;
    case Kind::joint_damping:
      return &scene.joints[at(p.object)].damping;
    case Kind::mass:
      return &scene.bodies[at(p.object)].mass;
    case Kind::centre_of_mass:
      return &scene.bodies[at(p.object)].centre_of_mass[p.component];
    default:
      return nullptr;
  }
}

ParameterPlace parameter_place(const SceneTables& scene, const Parameter& parameter, const TomlNode& document) {
  const Path path = path_of(scene, parameter);
  ParameterPlace place{&document, "", path.unit};
  const auto element = [&](int k) {
    const bool there = place.node && place.node->kind == TomlNode::Kind::array && at(k) < place.node->children.size();
    place.node = there ? &place.node->children[at(k)] : nullptr;
    place.key += fmt::format("[{}]", k + 1);
  };
  const auto member = [&](const std::string& key) {
    place.node = place.node ? place.node->member(key) : nullptr;
    place.key += (place.key.empty() ? "" : ".") + key;
  };
  for (const std::string& key : path.keys) member(key);
  if (path.via >= 0) {
    element(path.via);
    member("point");
  }
  if (path.element >= 0) element(path.element);
  return place;
}

}  // namespace genu
