#include "genu/model/parameter_rates.h"

#include "genu/model/ligament_rates.h"
#include "genu/model/load_rates.h"
#include "genu/model/path_change.h"
#include "genu/model/surface_rates.h"

namespace genu {
namespace {

using Kind = Parameter::Kind;

void add_wrench(const JointModel& model, int body_a, int body_b, const Vec12& wrench, VecX& out) {
  const int bodies[2] = {body_a, body_b};
  for (int i = 0; i < 2; ++i) {
    const int moving = bodies[i] < 0 ? -1 : model.bodies[at(bodies[i])].moving;
    if (moving >= 0) out.segment<6>(6 * moving) += wrench.segment<6>(6 * i);
  }
}

void add_load_rate(const PlacedScene& scene, const JointModel& model, const State& state, const Target& target,
                   const Parameter& parameter, VecX& out) {
  const Load& load = model.loads[at(parameter.object)];
  const double scale = load_scale(load, state, target.time).factor;
  if (parameter.kind == Kind::factor) {
    add_load_wrench(model, state, load, scale, out);
    return;
  }
  const double factor = scale * load_factor(target, state, at(parameter.object));
  const Load change = load_change(scene, parameter);
  if (load.kind == Load::Kind::cable) {
    load.path.add_tension(state.poses, factor * change.value, out, state.wraps);
    return;
  }
  Vec12 wrench;
  if (load.kind == Load::Kind::coordinate)
    wrench =
        change.value * joint_point(model, state, load.coordinate.joint).gradient(load.coordinate.index).transpose();
  else
    wrench = load_wrench_rate(load, change, state.poses[at(load.body_a)],
                              load.body_b < 0 ? Pose() : state.poses[at(load.body_b)]);
  add_wrench(model, load.body_a, load.body_b, factor * wrench, out);
}

void add_weight_rate(const PlacedScene& scene, const JointModel& model, const State& state, const Parameter& parameter,
                     VecX& out) {
  for (const Load& weight : model.weights) {
    if (weight.body_a != parameter.object) continue;
    const Vec12 wrench = load_wrench_rate(weight, load_change(scene, parameter), state.poses[at(weight.body_a)], {});
    add_wrench(model, weight.body_a, -1, wrench, out);
  }
}

/// The spring of the joint at 1 less that at 0 of the number: the change by the number.
JointSpring spring_change(const JointDef& joint, const Parameter& parameter) {
  JointDef def = joint;
  double& number = kind_of(def).numbers[at(parameter.number)].values(def)[parameter.component];
  number = 0;
  const JointSpring zero = make_spring(def, parameter.object);
  number = 1;
  const JointSpring one = make_spring(def, parameter.object);
  const auto change = [](double a, double b) { return a == b ? 0 : a - b; };  // of infinite limits, too
  return {.joint = one.joint,
          .stiffness = change(one.stiffness, zero.stiffness),
          .lower = change(one.lower, zero.lower),
          .upper = change(one.upper, zero.upper),
          .stop = change(one.stop, zero.stop)};
}

void add_spring_rate(const PlacedScene& scene, const JointModel& model, const State& state, const Parameter& parameter,
                     VecX& out) {
  const auto& joint = model.joints[at(parameter.object)];
  const JointPoint point = joint_point(model, state, parameter.object);
  const JointDef& def = scene.joints[at(parameter.object)];
  const double rate = make_spring(def, parameter.object).moment_rate(point.values()[0], spring_change(def, parameter));
  add_wrench(model, joint.parent, joint.child, rate * point.gradient(0).transpose(), out);
}

void add_bushing_rate(const JointModel& model, const State& state, const Parameter& parameter, VecX& out) {
  const Bushing& b = model.bushings[at(parameter.object)];
  const BushingPoint point(b, state.poses[at(b.body_a)], state.poses[at(b.body_b)]);
  const int i = 3 * parameter.number + parameter.component;  // its rows are those of the six directions
  if (i < 6) add_wrench(model, b.body_a, b.body_b, point.wrench(-point.displacement()[i] * Vec6::Unit(i)), out);
}

void add_contact_rates(const PlacedScene& scene, const JointModel& model, const State& state,
                       const Parameter& parameter, Linearization& out) {
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    const ActiveContact& contact = state.contacts[c];
    const PairChange change = pair_change(scene, parameter, contact.pair, contact.geometry);
    if (change.none) continue;
    const auto& pair = model.pairs[at(contact.pair)];
    const ContactChange rate = contact_change(state.poses[at(pair.body_a)], state.poses[at(pair.body_b)],
                                              contact.geometry, contact.force, change.a, change.b);
    out.contacts[c].residual = rate.residual;
    add_wrench(model, pair.body_a, pair.body_b, rate.wrench, out.wrench);
  }
}

/// Of the cables that touch the surface.
void add_cable_rates(const PlacedScene& scene, const JointModel& model, const State& state, const Target& target,
                     const Parameter& parameter, VecX& out) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    if (load.kind != Load::Kind::cable) continue;
    const std::vector<WrapDef>& wraps = scene.loads[i].wraps;
    if (!touches(wraps, load.path, state.wraps, parameter.object)) continue;
    const auto change = change_by_surface(wraps, load.path, state.poses, state.wraps, parameter, scene.surfaces);
    const double tension = load.value * load_scale(load, state, target.time).factor * load_factor(target, state, i);
    add_pull_rate(load.path, state.poses, state.wraps, change, tension, out);
  }
}

}  // namespace

PairChange pair_change(const PlacedScene& scene, const Parameter& parameter, int pair, const ContactGeometry& contact) {
  PairChange out;
  if (!parameter.of_surface()) return out;
  const ContactDef& def = scene.contacts[at(pair)];
  const SurfaceDef& surface = scene.surfaces[at(parameter.object)];
  if (def.surface_a == parameter.object) out.a = surface_change(surface, parameter, contact.a);
  if (def.surface_b == parameter.object) out.b = surface_change(surface, parameter, contact.b);
  out.none = def.surface_a != parameter.object && def.surface_b != parameter.object;
  return out;
}

void residual_rate(const PlacedScene& scene, const JointModel& model, const State& state, const Target& target,
                   const Parameter& parameter, Linearization& out) {
  out.wrench.setZero(6 * model.moving_count);
  out.constraint.setZero(static_cast<Eigen::Index>(constraint_count(model, target)));
  out.contacts.resize(state.contacts.size());
  for (ContactBlock& block : out.contacts) block.residual.setZero();
  for (std::size_t l = 0; l < model.ligaments.size(); ++l) {
    if (!concerns(scene.ligaments[l], static_cast<int>(l), parameter)) continue;
    const LigamentRate rate = ligament_rate({scene.ligaments[l], model.ligaments[l], model.reference_poses, state.poses,
                                             model.reference_wraps, state.wraps, model.moving_count},
                                            parameter, scene.surfaces);
    if (rate.wrench.size() > 0) out.wrench += rate.wrench;
  }
  if (parameter.of_surface()) {
    add_contact_rates(scene, model, state, parameter, out);
    add_cable_rates(scene, model, state, target, parameter, out.wrench);
  } else if (parameter.of_load()) {
    add_load_rate(scene, model, state, target, parameter, out.wrench);
  } else if (parameter.of_body()) {
    add_weight_rate(scene, model, state, parameter, out.wrench);
  } else if (parameter.of_joint()) {
    add_spring_rate(scene, model, state, parameter, out.wrench);
  } else if (parameter.of_bushing()) {
    add_bushing_rate(model, state, parameter, out.wrench);
  } else if (!parameter.of_ligament()) {
    for (std::size_t m = 0; m < target.prescribed.size(); ++m)
      if (target.prescribed[m].coordinate == parameter.quantity) out.constraint[static_cast<Eigen::Index>(m)] = -1;
  }
}

}  // namespace genu
