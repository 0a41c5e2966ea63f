#include "genu/results/extensor_columns.h"

#include "genu/model/linearization.h"

namespace genu {
namespace {

bool pulls_at(const LoadDef& load, int body) {
  if (load.kind == LoadDef::Kind::toward) return load.body == body || load.toward_body == body;
  if (load.kind != LoadDef::Kind::cable) return false;
  return (load.points.front().body == body) != (load.points.back().body == body);
}

/// Whether it runs from the patella to another bone than the femur.
bool is_tendon(const LigamentDef& ligament, const GroodSuntayDef& axes) {
  const int patella = axes.tibia.body, from = ligament.from.body, to = ligament.to.body;
  if ((from == patella) == (to == patella)) return false;
  return (from == patella ? to : from) != axes.femur.body;
}

bool is_between(const PlacedScene& scene, const ContactDef& contact, const GroodSuntayDef& axes) {
  const int a = scene.surfaces[at(contact.surface_a)].body, b = scene.surfaces[at(contact.surface_b)].body;
  return (a == axes.femur.body && b == axes.tibia.body) || (b == axes.femur.body && a == axes.tibia.body);
}

}  // namespace

std::vector<ExtensorMechanism> extensor_mechanisms(const PlacedScene& scene) {
  std::vector<ExtensorMechanism> out;
  for (const JointDef& joint : scene.joints) {
    if (!joint.grood_suntay || !joint.grood_suntay->patella) continue;
    const GroodSuntayDef& axes = *joint.grood_suntay;
    ExtensorMechanism one;
    one.joint = joint.name;
    for (std::size_t i = 0; i < scene.loads.size(); ++i)
      if (pulls_at(scene.loads[i], axes.tibia.body)) one.quadriceps.push_back(i);
    for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
      if (is_tendon(scene.ligaments[i], axes)) one.tendon.push_back(i);
    for (const ContactDef& contact : scene.contacts)
      if (is_between(scene, contact, axes)) one.contacts.push_back(contact.name);
    for (const LayerDef& layer : scene.layers)
      if (is_between(scene, layer.pair, axes)) one.contacts.push_back(layer.pair.name);
    if (!one.quadriceps.empty() && !one.tendon.empty()) out.push_back(std::move(one));
  }
  return out;
}

double load_tension(const JointModel& model, const Target& target, const State& state, std::size_t load) {
  const Load& l = model.loads[load];
  return l.value * load_scale(l, state, target.time).factor * load_factor(target, state, load);
}

void add_extensor_columns(const PlacedScene& scene, ResultTable& table) {
  for (const ExtensorMechanism& one : extensor_mechanisms(scene))
    for (const std::string& name : {one.quadriceps_column(), one.tendon_column(), one.ratio_column()})
      table.add_column(name);
}

void set_extensor_columns(const PlacedScene& scene, const JointModel& model, const Target& target, const State& state,
                          ResultTable& table) {
  const std::size_t row = table.rows() - 1;
  for (const ExtensorMechanism& one : extensor_mechanisms(scene)) {
    double muscle = 0, tendon = 0;
    for (const std::size_t load : one.quadriceps) muscle += load_tension(model, target, state, load);
    for (const std::size_t i : one.tendon) tendon += table.number(row, scene.ligaments[i].name + ".force_N");
    table.set(one.quadriceps_column(), muscle);
    table.set(one.tendon_column(), tendon);
    if (muscle != 0) table.set(one.ratio_column(), tendon / muscle);
  }
}

}  // namespace genu
