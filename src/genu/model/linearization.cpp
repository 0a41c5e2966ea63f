#include "genu/model/linearization.h"

#include <algorithm>

#include "genu/contact/elastic_layer.h"
#include "genu/model/bushing_forces.h"
#include "genu/model/twist.h"
#include "genu/model/two_body_scatter.h"

namespace genu {
namespace {

int moving_index(const JointModel& model, int body) { return body < 0 ? -1 : model.bodies[at(body)].moving; }

TwoBodyScatter scatter_on(const JointModel& model, int body_a, int body_b) {
  return {moving_index(model, body_a), moving_index(model, body_b)};
}

/// A joint of a state whose coordinates match its poses.
JointPoint point_of(const JointModel& model, const State& state, int index) {
  const auto& joint = model.joints[at(index)];
  return joint.coordinates.derivatives(state.poses[at(joint.parent)], state.poses[at(joint.child)],
                                       state.coordinates[at(index)]);
}

void add_straight(const JointModel::Ligament& l, const State& state, int piece, TwoBodyWrench& pull,
                  Linearization& out) {
  const LigamentPath::Point &a = l.path.from(), &b = l.path.to();
  const TwoBodyScatter scatter(a.moving, b.moving);
  const TautLine line{a.p, b.p};
  const Pose &X_WA = state.poses[at(a.body)], &X_WB = state.poses[at(b.body)];
  const bool taut = out.derivatives
                        ? evaluate_straight(l.law, line, X_WA, X_WB, pull, piece, scatter.which_move())
                        : evaluate_straight_wrench(l.law, line, X_WA, X_WB, pull, piece, scatter.which_move());
  if (!taut) return;
  scatter.add_wrench(pull.on_a, pull.on_b, out.wrench);
  if (out.derivatives) scatter.add_stiffness(pull.stiffness, out.stiffness);
}

void add_path(const JointModel::Ligament& l, const State& state, const LawValue& tension, Linearization& out) {
  l.path.linearize(state.poses, tension, out.length_gradient, out.wrench, out.derivatives ? &out.stiffness : nullptr,
                   state.wraps);
}

/// The multiplier is the tension, so the gradient of the constraint is that of shortening.
void add_held_ligament(const JointModel::Ligament& l, const State& state, const LigamentPiece& piece, Eigen::Index row,
                       Linearization& out) {
  add_path(l, state, {piece.force, 0, 0}, out);
  out.gradient.row(row) = -out.length_gradient.transpose();
  out.constraint[row] = l.law.sharp_breaks()[at(piece.piece)].length - l.path.length(state.poses, state.wraps);
}

void add_ligaments(const JointModel& model, const State& state, Eigen::Index first_held, Linearization& out) {
  TwoBodyWrench& pull = out.pull;
  auto piece = state.pieces.begin();
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto& l = model.ligaments[i];
    const bool has_piece = piece != state.pieces.end() && at(piece->ligament) == i;
    const int k = has_piece && !piece->by_length ? piece->piece : LigamentLaw::kByLength;
    if (has_piece && piece->held)
      add_held_ligament(l, state, *piece, first_held++, out);
    else if (l.path.is_straight())
      add_straight(l, state, k, pull, out);
    else if (const LawValue tension = l.law.evaluate(l.path.length(state.poses, state.wraps), k);
             tension.force != 0 || tension.stiffness != 0)
      add_path(l, state, tension, out);
    if (has_piece) ++piece;
  }
}

void add_cable(const JointModel& model, const State& state, const Load& load, double factor,
               const LoadScale::Value& scale, Linearization& out) {
  load.path.linearize(state.poses, {factor * scale.factor * load.value, 0, 0}, out.length_gradient, out.wrench,
                      out.derivatives ? &out.stiffness : nullptr, state.wraps);
  if (!out.derivatives || scale.slope == 0 || !load.scale || !load.scale->coordinate()) return;
  const CoordinateRef& q = *load.scale->coordinate();
  const JointPoint::Gradient gradient = point_of(model, state, q.joint).gradient(q.index);
  const auto& joint = model.joints[at(q.joint)];
  const int moving[2] = {model.bodies[at(joint.parent)].moving, model.bodies[at(joint.child)].moving};
  for (int i = 0; i < 2; ++i)
    if (moving[i] >= 0)
      out.stiffness.middleCols<6>(6 * moving[i]) -=
          (factor * scale.slope * load.value) * out.length_gradient * gradient.segment<6>(6 * i);
}

void add_load(const JointModel& model, const State& state, const Load& load, double factor, double time,
              const VecX* twist, Linearization& out) {
  LoadScale::Value scale = load_scale(load, state, time);
  if (twist != nullptr) scale.factor = load_scale_in_motion(model, load, state, time, *twist);
  if (load.kind == Load::Kind::cable) return add_cable(model, state, load, factor, scale, out);
  const LoadWrench unit = load_wrench(model, state, load);
  const TwoBodyScatter scatter = scatter_on(model, load.body_a, load.body_b);
  scatter.add_wrench(factor * scale.factor * unit.wrench, out.wrench);
  if (!out.derivatives) return;
  scatter.add_stiffness(factor * scale.factor * unit.stiffness, out.stiffness);
  if (scale.slope == 0 || !load.scale || !load.scale->coordinate()) return;
  // The pose changes the factor too: wrench times d factor / dq times grad q.
  const CoordinateRef& q = *load.scale->coordinate();
  const JointPoint::Gradient gradient = point_of(model, state, q.joint).gradient(q.index);
  const auto& joint = model.joints[at(q.joint)];
  scatter.add_stiffness(factor * scale.slope * unit.wrench * gradient, scatter_on(model, joint.parent, joint.child),
                        out.stiffness);
}

void add_loads(const JointModel& model, const State& state, const Target& target, const VecX* twist,
               Linearization& out) {
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    if (target.load_factors[i] != 0)
      add_load(model, state, model.loads[i], target.load_factors[i], target.time, twist, out);
}

void add_weights(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  for (const Load& weight : model.weights) add_load(model, state, weight, 1, target.time, nullptr, out);
}

/// Adds `factor` times a coordinate to constraint `row`, and the wrench of its part of the multiplier.
void add_coordinate(const JointModel& model, const JointPoint& point, const CoordinateRef& c, double factor,
                    double multiplier, Eigen::Index row, Linearization& out) {
  const auto& joint = model.joints[at(c.joint)];
  const JointPoint::Gradient gradient = factor * point.gradient(c.index);
  out.constraint(row) += factor * point.values()[at(c.index)];
  const int parent = model.bodies[at(joint.parent)].moving, child = model.bodies[at(joint.child)].moving;
  if (parent >= 0) out.gradient.block<1, 6>(row, 6 * parent) += gradient.head<6>();
  if (child >= 0) out.gradient.block<1, 6>(row, 6 * child) += gradient.tail<6>();
  if (multiplier == 0) return;
  const TwoBodyScatter scatter = scatter_on(model, joint.parent, joint.child);
  scatter.add_wrench(multiplier * gradient.transpose(), out.wrench);
  if (out.derivatives) scatter.add_stiffness(factor * multiplier * point.hessian(c.index), out.stiffness);
}

/// Loads that hold a coordinate: with the multiplier as their factor, and what a unit of it adds.
void add_drivers(const JointModel& model, const State& state, const Target& target, std::size_t m,
                 Linearization::LoadColumn& column, Linearization& out) {
  column.row = static_cast<Eigen::Index>(m);
  column.wrench.setZero(out.wrench.size());
  for (const int driver : target.prescribed[m].drivers) {
    const Load& load = model.loads[at(driver)];
    if (state.multipliers[m] != 0) add_load(model, state, load, state.multipliers[m], target.time, nullptr, out);
    add_load_wrench(model, state, load, load_scale(load, state, target.time).factor, column.wrench);
  }
}

void add_prescribed(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  const auto driven = [](const Target::Prescribed& p) { return !p.drivers.empty(); };
  out.load_columns.resize(static_cast<std::size_t>(  // keeps its memory
      std::count_if(target.prescribed.begin(), target.prescribed.end(), driven)));
  auto column = out.load_columns.begin();
  for (std::size_t m = 0; m < target.prescribed.size(); ++m) {
    const auto row = static_cast<Eigen::Index>(m);
    const bool reacts = target.prescribed[m].drivers.empty();
    for_terms(model, target.prescribed[m].coordinate, [&](const CoordinateRef& c, double factor) {
      add_coordinate(model, point_of(model, state, c.joint), c, factor, reacts ? state.multipliers[m] : 0, row, out);
    });
    out.constraint(row) -= target.prescribed[m].value;
    if (!reacts) add_drivers(model, state, target, m, *column++, out);
  }
}

void add_held(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  auto row = static_cast<Eigen::Index>(target.prescribed.size());
  JointPoint point;
  int evaluated = -1;
  for (const auto& held : model.held) {
    if (held.coordinate.joint != evaluated) point = point_of(model, state, evaluated = held.coordinate.joint);
    add_coordinate(model, point, held.coordinate, 1, state.multipliers[static_cast<std::size_t>(row)], row, out);
    out.constraint(row++) -= held.value;
  }
}

void add_constraints(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  EffectMeter* meter = model.meter.get();
  evaluate_effect(meter, Effect::prescribed, target.prescribed.size(),
                  [&] { add_prescribed(model, state, target, out); });
  evaluate_effect(meter, Effect::held, model.held.size(), [&] { add_held(model, state, target, out); });
}

void add_joint_springs(const JointModel& model, const State& state, Linearization& out) {
  for (const auto& spring : model.joint_springs) {
    const auto& joint = model.joints[at(spring.joint)];
    const JointPoint point = point_of(model, state, spring.joint);
    const JointPoint::Gradient gradient = point.gradient(0);
    const double angle = point.values()[0];
    const TwoBodyScatter scatter = scatter_on(model, joint.parent, joint.child);
    const double moment = spring.moment(angle);
    if (moment == 0 && spring.slope(angle) == 0) continue;
    scatter.add_wrench(moment * gradient.transpose(), out.wrench);
    if (!out.derivatives) continue;
    scatter.add_stiffness(spring.slope(angle) * gradient.transpose() * gradient + moment * point.hessian(0),
                          out.stiffness);
  }
}

void add_contacts(const JointModel& model, const State& state, Linearization& out) {
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    const ActiveContact& contact = state.contacts[c];
    const auto& pair = model.pairs[at(contact.pair)];
    ContactBlock& block = out.contacts[c];
    out.contact_bodies[c] = {model.bodies[at(pair.body_a)].moving, model.bodies[at(pair.body_b)].moving};
    const TwoBodyScatter scatter = scatter_on(model, pair.body_a, pair.body_b);
    const Pose &X_Wa = state.poses[at(pair.body_a)], &X_Wb = state.poses[at(pair.body_b)];
    out.derivatives ? evaluate_contact(X_Wa, X_Wb, contact.geometry, contact.force, block, scatter.which_move())
                    : evaluate_contact_residual(X_Wa, X_Wb, contact.geometry, block);
    scatter.add_wrench(contact.force * block.direction, out.wrench);
    if (out.derivatives) scatter.add_stiffness(block.wrench_d_twist, out.stiffness);
  }
}

LayerMemories& memories_of(Linearization& out) {
  if (!out.layers) out.layers = std::make_shared<LayerMemories>();
  return *out.layers;
}

void add_layers(const JointModel& model, const State& state, const VecX* twist, Linearization& out) {
  out.layer_wrench.setZero(out.wrench.size());
  memories_of(out).each.resize(model.layers.size());
  LayerWrench pressed;
  Vec12 twists;
  out.layer_damped = 0;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    const auto& layer = model.layers[k];
    if (twist != nullptr)
      twists << twist_of_body(model, layer.body_a, *twist), twist_of_body(model, layer.body_b, *twist);
    out.layers->each[k].cancelled = out.layers->cancelled;
    layer.layer->evaluate(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], out.layers->each[k], pressed,
                          state.layer_level(k), twist != nullptr ? &twists : nullptr);
    out.layer_loads[k] = pressed.load;
    out.layer_damped += pressed.damped;
    out.layer_errors[k] = pressed.error;
    const TwoBodyScatter scatter = scatter_on(model, layer.body_a, layer.body_b);
    scatter.add_wrench(pressed.wrench, out.layer_wrench);
    scatter.add_stiffness(pressed.stiffness, out.stiffness);
  }
  out.wrench += out.layer_wrench;
}

/// Terms without unknowns of their own: ligaments (held ones from row `first_held` on), loads, weights, joint springs,
/// elastic layers.
void add_forces(const JointModel& model, const State& state, const Target& target, Eigen::Index first_held,
                const VecX* twist, Linearization& out) {
  out.layer_loads.resize(model.layers.size());
  out.layer_errors.resize(model.layers.size());
  const auto effect = [&](Effect kind, std::size_t count, const auto& add) {
    evaluate_effect(model.meter.get(), kind, count, add);
  };
  effect(Effect::ligaments, model.ligaments.size(), [&] { add_ligaments(model, state, first_held, out); });
  effect(Effect::loads, model.loads.size(), [&] { add_loads(model, state, target, twist, out); });
  effect(Effect::weights, model.weights.size(), [&] { add_weights(model, state, target, out); });
  effect(Effect::joint_springs, model.joint_springs.size(), [&] { add_joint_springs(model, state, out); });
  effect(Effect::bushings, model.bushings.size(),
         [&] { add_bushings(model, state, out.wrench, out.derivatives ? &out.stiffness : nullptr); });
  effect(Effect::layers, model.layers.size(), [&] { add_layers(model, state, twist, out); });
}

void place_own_origins(const JointModel& model, const State& state, VecX& out) {
  const bool moved = std::any_of(model.bodies.begin(), model.bodies.end(),
                                 [](const auto& b) { return b.moving >= 0 && !b.centre.isZero(0); });
  if (!moved) return;
  out.resize(3 * model.moving_count);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (const int k = model.bodies[i].moving; k >= 0)
      out.segment<3>(3 * k) = state.poses[i].R * own_origin(model, static_cast<int>(i));
}

}  // namespace

void stop_layers_when(const Cancelled& cancelled, Linearization& out) { memories_of(out).cancelled = cancelled; }

void linearize(const JointModel& model, const State& state, const Target& target, Linearization& out,
               Derivatives wanted) {
  out.derivatives = wanted == Derivatives::all || !model.layers.empty();  // layers compute both together
  const int n = 6 * model.moving_count;
  const auto held_from = static_cast<Eigen::Index>(constraint_count(model, target));
  const Eigen::Index m = held_from + held_count(state);
  out.wrench.setZero(n);
  if (out.derivatives) out.stiffness.setZero(n, n);
  out.gradient.setZero(m, n);
  out.constraint.setZero(m);
  out.contacts.resize(state.contacts.size());
  out.contact_bodies.resize(state.contacts.size());
  add_constraints(model, state, target, out);
  evaluate_effect(model.meter.get(), Effect::rigid_contacts, state.contacts.size(),
                  [&] { add_contacts(model, state, out); });
  add_forces(model, state, target, held_from, nullptr, out);
  place_own_origins(model, state, out.own_origins);
}

void linearize_forces(const JointModel& model, const State& state, const Target& target, Linearization& out,
                      const VecX* twist) {
  const int n = 6 * model.moving_count;
  const Eigen::Index held = held_count(state);
  out.derivatives = true;
  out.wrench.setZero(n);
  out.stiffness.setZero(n, n);
  out.gradient.setZero(held, n);
  out.constraint.setZero(held);
  out.contacts.clear();
  out.contact_bodies.clear();
  add_forces(model, state, target, 0, twist, out);
}

void linearize_constraints(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  const int n = 6 * model.moving_count;
  const auto m = static_cast<Eigen::Index>(constraint_count(model, target));
  out.derivatives = true;
  out.wrench.setZero(n);
  out.stiffness.setZero(n, n);
  out.gradient.setZero(m, n);
  out.constraint.setZero(m);
  add_constraints(model, state, target, out);
}

JointPoint joint_point(const JointModel& model, const State& state, int index) {
  const auto& joint = model.joints[at(index)];
  return joint.coordinates.evaluate(state.poses[at(joint.parent)], state.poses[at(joint.child)],
                                    state.coordinates[at(index)]);
}

LoadWrench load_wrench(const JointModel& model, const State& state, const Load& load) {
  if (load.kind == Load::Kind::coordinate) return load.on_coordinate(joint_point(model, state, load.coordinate.joint));
  return load.between(state.poses[at(load.body_a)], load.body_b < 0 ? Pose() : state.poses[at(load.body_b)]);
}

void add_load_wrench(const JointModel& model, const State& state, const Load& load, double factor, VecX& wrench) {
  if (load.kind == Load::Kind::cable)
    load.path.add_tension(state.poses, factor * load.value, wrench, state.wraps);
  else
    scatter_on(model, load.body_a, load.body_b).add_wrench(factor * load_wrench(model, state, load).wrench, wrench);
}

LoadScale::Value load_scale(const Load& load, const State& state, double time) {
  if (!load.scale) return {};
  const auto& q = load.scale->coordinate();
  return load.scale->evaluate(q ? state.coordinates[at(q->joint)][at(q->index)] : 0, time);
}

double load_scale_in_motion(const JointModel& model, const Load& load, const State& state, double time,
                            const VecX& twist) {
  const double factor = load_scale(load, state, time).factor;
  if (!load.scale || !load.scale->has_rate()) return factor;
  const CoordinateRef& q = *load.scale->coordinate();
  const double rate = joint_point(model, state, q.joint).gradient(q.index).dot(twist_of_pair(model, q.joint, twist));
  return factor + load.scale->rate_term(time, rate);
}

VecX constraint_rate(const Target& rate, Eigen::Index count) {
  VecX out = VecX::Zero(count);
  for (std::size_t m = 0; m < rate.prescribed.size(); ++m)
    out[static_cast<Eigen::Index>(m)] = -rate.prescribed[m].value;
  return out;
}

VecX load_rate(const JointModel& model, const State& state, const Target& target, const Target& rate) {
  VecX wrench = VecX::Zero(6 * model.moving_count);
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const LoadScale::Value scale = load_scale(load, state, target.time);
    double speed = rate.load_factors[i] * scale.factor;
    if (load.scale)
      speed += load_factor(target, state, i) * load.scale->rate_in_time(target.time, scale.slope) * rate.time;
    if (speed == 0) continue;
    add_load_wrench(model, state, load, speed, wrench);
  }
  return wrench;
}

Vec6 joint_reaction(const JointModel& model, const State& state, int joint) {
  const JointPoint point = joint_point(model, state, joint);
  const std::size_t first = state.multipliers.size() - model.held.size();
  Vec6 wrench = Vec6::Zero();
  for (std::size_t i = 0; i < model.held.size(); ++i)
    if (model.held[i].coordinate.joint == joint)
      wrench += state.multipliers[first + i] * point.gradient(model.held[i].coordinate.index).tail<6>().transpose();
  // Moment about the child's own origin.
  const Vec3 arm = state.poses[at(model.joints[at(joint)].child)].R * own_origin(model, model.joints[at(joint)].child);
  wrench.tail<3>() -= arm.cross(Vec3(wrench.head<3>()));
  const Mat3 to_parent = state.poses[at(model.joints[at(joint)].parent)].R.transpose();
  wrench.head<3>() = (to_parent * wrench.head<3>()).eval();
  wrench.tail<3>() = (to_parent * wrench.tail<3>()).eval();
  return wrench;
}

}  // namespace genu
