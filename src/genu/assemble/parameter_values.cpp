#include "genu/assemble/parameter_values.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace genu {
namespace {

using Kind = Parameter::Kind;

/// A member by its key, or an element of an array by its index.
struct Hop {
  std::string key;
  int element = -1;
};
using Path = std::vector<Hop>;

Path element(Path path, int k) {
  path.push_back({{}, k});
  return path;
}

/// The path of the object that a parameter is of.
Path object_path(const SceneTables& scene, const Parameter& p) {
  if (p.of_ligament()) return {{"ligament"}, {scene.ligaments[at(p.object)].name}};
  if (p.of_surface()) return {{"surface"}, {scene.surfaces[at(p.object)].name}};
  if (p.of_load()) return {{"load"}, {scene.loads[at(p.object)].name}};
  if (p.of_bushing()) return {{"bushing"}, {scene.bushings[at(p.object)].name}};
  if (p.of_joint()) return {{"joint"}, {scene.joints[at(p.object)].name}};
  return {{"body"}, {scene.bodies[at(p.object)].name}};
}

struct KeyAndUnit {
  Path path;  ///< in the object
  double si = 1;
};

KeyAndUnit ligament_key(const Parameter& p, const ChosenUnits& chosen) {
  switch (p.kind) {
    case Kind::slack_length:
      return {{{"slack_length"}}, chosen.length};
    case Kind::reference_strain:
      return {{{"reference_strain"}}, 1};
    case Kind::reference_force:
      return {{{"reference_force"}}, 1};
    case Kind::damping:
      return {{{kLigamentDamping.key}}, si(kLigamentDamping.unit, chosen)};
    case Kind::via_point:
      return {{{"via"}, {{}, p.component / 3}, {"point"}, {{}, p.component % 3}}, chosen.length};
    default:
      return {{{p.kind == Kind::from_point ? "from" : "to"}, {"point"}, {{}, p.component}}, chosen.length};
  }
}

/// A coefficient has the unit that makes its term a length.
KeyAndUnit term_key(const SurfaceDef& surface, const Parameter& p, const ChosenUnits& chosen) {
  const SurfaceDef::Term& term = surface.terms[at(p.component)];
  const int lengths = term.j + (surface.shape == SurfaceDef::Shape::polynomial ? term.i : 0);
  return {{{"terms"}, {{}, p.component}, {{}, 2}}, std::pow(chosen.length, 1 - lengths)};
}

KeyAndUnit row_key(const NumberRow& row, int component, const ChosenUnits& chosen) {
  Path path;
  if (row.table != nullptr) path.push_back({row.table});
  path.push_back({row.key});
  return {row.size > 1 ? element(path, component) : path, si(row.unit, chosen)};
}

KeyAndUnit key_of(const SceneTables& scene, const Parameter& p) {
  const ChosenUnits chosen{scene.length_unit, scene.angle_unit, {}, {}};
  if (const NumberRow* row = parameter_row(scene, p)) return row_key(*row, p.component, chosen);
  if (p.kind == Kind::term) return term_key(scene.surfaces[at(p.object)], p, chosen);
  return ligament_key(p, chosen);
}

}  // namespace

ParameterPlace parameter_place(const SceneTables& scene, const Parameter& parameter, const TomlNode& document) {
  const KeyAndUnit key = key_of(scene, parameter);
  ParameterPlace place{&document, "", key.si};
  Path path = object_path(scene, parameter);
  path.insert(path.end(), key.path.begin(), key.path.end());
  for (const Hop& hop : path) {
    if (hop.element < 0) {
      place.node = place.node ? place.node->member(hop.key) : nullptr;
      place.key += (place.key.empty() ? "" : ".") + hop.key;
      continue;
    }
    const bool there =
        place.node && place.node->kind == TomlNode::Kind::array && at(hop.element) < place.node->children.size();
    place.node = there ? &place.node->children[at(hop.element)] : nullptr;
    place.key += fmt::format("[{}]", hop.element + 1);
  }
  return place;
}

}  // namespace genu
