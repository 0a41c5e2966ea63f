#include "genu/api/scene_numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/api/inside.h"
#include "genu/core/counted.h"
#include "genu/core/units.h"
#include "genu/scene/leave_out_bodies.h"
#include "genu/scene/words.h"

namespace genu::api {
namespace {

using Kind = Parameter::Kind;

/// What a table of numbers says of an object as a whole.
template <class Def>
std::string fault_of(const Def& def) {
  for (const NumberOf<Def>& number : kind_of(def).numbers)
    if (number.fault != nullptr)
      if (const char* why = number.fault(def); why != nullptr) return why;
  return {};
}

std::string fault_of_object(const SceneTables& scene, const Parameter& p) {
  switch (p.kind) {
    case Kind::surface_number:
      return fault_of(scene.surfaces[at(p.object)]);
    case Kind::load_number:
      return fault_of(scene.loads[at(p.object)]);
    case Kind::body_number:
      return fault_of(scene.bodies[at(p.object)]);
    case Kind::joint_number:
      return fault_of(scene.joints[at(p.object)]);
    case Kind::bushing_number:
      return fault_of(scene.bushings[at(p.object)]);
    default:
      return {};
  }
}

std::string fault_of(SceneTables& scene, const Parameter& p) {
  const double value = *parameter_number(scene, p);
  if (const NumberRow* row = parameter_row(scene, p))
    if (std::string why = row->fault(value); !why.empty()) return why;
  if (!std::isfinite(value)) return "must be finite";
  if (p.kind == Kind::slack_length && !(value > 0)) {
    const bool without_length = value == 0 && scene.ligaments[at(p.object)].law == "spring";
    if (!without_length) return "must be > 0 mm";
  }
  if (p.kind == Kind::reference_strain && !(value > -1)) return "must be > -1";
  if (p.kind == Kind::damping && !(value >= 0)) return "must be >= 0";
  return fault_of_object(scene, p);
}

bool is_vector(const SceneTables& scene, const Parameter& p) {
  const NumberRow* row = parameter_row(scene, p);
  return row != nullptr && !p.of_ligament() && row->size == 3;
}

bool is_point(const SceneTables& scene, const Parameter& p) {
  if (p.kind == Kind::from_point || p.kind == Kind::to_point || p.kind == Kind::via_point) return true;
  return is_vector(scene, p);
}

/// A number of an elastic layer.
struct LayerNumber {
  const char* key;
  const char* unit;
  double si;
  double LayerDef::*member;
  std::string (*fault)(double);
};

std::string above_zero(double x) { return std::isfinite(x) && x > 0 ? "" : "must be > 0"; }
std::string below_half(double x) { return x >= 0 && x < 0.5 ? "" : "must be >= 0 and < 0.5"; }

const LayerNumber kLayerNumbers[] = {{"modulus", "MPa", units::kMegapascal, &LayerDef::modulus, above_zero},
                                     {"poisson", "1", 1, &LayerDef::poisson, below_half}};

/// Of each object its index among those that stay; -1 for those that a pattern means.
template <class Defs>
std::vector<int> kept(const SceneTables& scene, const Defs& defs, const std::string& pattern, const char* kind) {
  std::vector<int> index;
  int next = 0;
  for (const auto& def : defs) index.push_back(means_object(scene, pattern, kind, def.name) ? -1 : next++);
  return index;
}

/// Takes out of `defs` what is not kept; how many.
template <class Defs>
std::size_t take_out(Defs& defs, const std::vector<int>& index) {
  std::size_t k = 0;
  return std::erase_if(defs, [&](const auto&) { return index[k++] < 0; });
}

/// Ligaments, which bundles name by their index.
std::size_t take_out_ligaments(genu::Scene& scene, const std::string& pattern) {
  const std::vector<int> index = kept(scene, scene.ligaments, pattern, "ligament");
  for (BundleDef& bundle : scene.bundles) {
    std::erase_if(bundle.members, [&](int member) { return index[at(member)] < 0; });
    for (int& member : bundle.members) member = index[at(member)];
  }
  return take_out(scene.ligaments, index);
}

/// Loads, which steps name by their index.
std::size_t take_out_loads(genu::Scene& scene, const std::string& pattern) {
  const std::vector<int> index = kept(scene, scene.loads, pattern, "load");
  const auto gone = [&](int load) { return index[at(load)] < 0; };
  for (const StepDef& step : scene.steps)
    for (const StepDef::Prescribed& p : step.prescribe)
      if (!p.drivers.empty() && std::all_of(p.drivers.begin(), p.drivers.end(), gone))
        refuse(Code::conflict, "without", with_quotes(pattern),
               "would leave nothing that holds " + quantity_name(scene, p.coordinate) + ", which a step drives");
  for (StepDef& step : scene.steps) {
    for (StepDef::Prescribed& p : step.prescribe) {
      std::erase_if(p.drivers, gone);
      for (int& driver : p.drivers) driver = index[at(driver)];
    }
    std::erase_if(step.factors, [&](const StepDef::Factor& f) { return gone(f.load); });
    for (StepDef::Factor& f : step.factors) f.load = index[at(f.load)];
  }
  return take_out(scene.loads, index);
}

std::size_t take_out_contacts(genu::Scene& scene, const std::string& pattern) {
  const std::size_t layers = std::erase_if(
      scene.layers, [&](const LayerDef& layer) { return means_object(scene, pattern, "contact", layer.pair.name); });
  return layers + take_out(scene.contacts, kept(scene, scene.contacts, pattern, "contact"));
}

/// Bodies with all that is on them.
std::size_t take_out_bodies(genu::Scene& scene, const std::string& pattern) {
  std::vector<int> bodies;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (means_body(pattern, scene.bodies[b].name)) bodies.push_back(static_cast<int>(b));
  if (const auto stays = cannot_leave_out(scene, bodies))
    refuse(Code::conflict, "without", with_quotes(pattern), scene.bodies[at(stays->body)].name + " " + stays->why);
  leave_out_bodies(scene, bodies);
  return bodies.size();
}

}  // namespace

bool means_object(const SceneTables& scene, const std::string& pattern, const std::string& kind,
                  const std::string& name) {
  return matches(scene, pattern, name) || matches(scene, pattern, kind + "." + name);
}

void leave_out(const std::string& pattern, genu::Scene& scene, std::string& what, bool& contacts) {
  std::vector<std::string> known;
  for (const LigamentDef& l : scene.ligaments) known.push_back(l.name);
  for (const LoadDef& l : scene.loads) known.push_back(l.name);
  for (const ContactDef& c : scene.contacts) known.push_back(c.name);
  for (const LayerDef& l : scene.layers) known.push_back(l.pair.name);
  for (const BundleDef& b : scene.bundles) known.push_back(b.name);
  for (const BushingDef& b : scene.bushings) known.push_back(b.name);
  for (const BodyDef& b : scene.bodies) known.push_back(b.name);
  const std::size_t ligaments = take_out_ligaments(scene, pattern), loads = take_out_loads(scene, pattern),
                    pairs = take_out_contacts(scene, pattern),
                    bushings = take_out(scene.bushings, kept(scene, scene.bushings, pattern, "bushing"));
  const auto add = [&](std::size_t n, const char* word) {
    if (n > 0) what += (what.empty() ? "" : ", ") + counted(n, word);
  };
  const std::size_t bodies = take_out_bodies(scene, pattern);
  add(bodies, "body");
  add(ligaments, "ligament");
  add(bushings, "bushing");
  add(pairs, "contact");
  add(loads, "load");
  contacts = pairs > 0 || bodies > 0;
  if (what.empty())
    refuse(Code::unknown_name, "without", with_quotes(pattern),
           "is no ligament, bundle, bushing, contact, load or body of this scene" + did_you_mean(pattern, known));
}

SceneNumbers::SceneNumbers(const SceneTables& scene) {
  bundles_.bundles = scene.bundles;
  SceneTables probe = scene;
  for (const Parameter& p : parameters_of(scene)) {
    if (parameter_number(probe, p) == nullptr) continue;
    SceneNumber number;
    number.name = p.name;
    number.unit = p.unit;
    number.si = p.si;
    number.object = p.group();
    number.moves_surfaces = p.of_surface() || (p.of_joint() && is_vector(scene, p));
    number.moves_points = is_point(scene, p);
    number.place = [p](SceneTables& s) { return parameter_number(s, p); };
    number.fault = [p](SceneTables& s) { return fault_of(s, p); };
    all_.push_back(std::move(number));
  }
  add_layers(scene);
  for (std::size_t k = 0; k < all_.size(); ++k) by_name_.try_emplace(all_[k].name, k);
}

void SceneNumbers::add_layers(const SceneTables& scene) {
  for (std::size_t k = 0; k < scene.layers.size(); ++k)
    for (const LayerNumber& n : kLayerNumbers) {
      SceneNumber number;
      number.name = scene.layers[k].pair.name + "." + n.key;
      number.unit = n.unit;
      number.si = n.si;
      number.object = "contact";
      const auto place = [k, member = n.member](SceneTables& s) { return &(s.layers[k].*member); };
      number.place = place;
      number.fault = [place, fault = n.fault](SceneTables& s) { return fault(*place(s)); };
      all_.push_back(std::move(number));
    }
}

std::vector<const SceneNumber*> SceneNumbers::matching(const std::string& pattern) const {
  if (const auto known = by_name_.find(pattern); known != by_name_.end()) return {&all_[known->second]};
  std::vector<const SceneNumber*> found;
  for (const SceneNumber& number : all_)
    if (means_object(bundles_, pattern, number.object, number.name)) found.push_back(&number);
  if (!found.empty()) return found;
  std::vector<std::string> names;
  for (const SceneNumber& number : all_) names.push_back(number.name);
  refuse(Code::unknown_name, "number", with_quotes(pattern),
         "is no number of this scene that can be changed" + did_you_mean(pattern, names));
}

}  // namespace genu::api
