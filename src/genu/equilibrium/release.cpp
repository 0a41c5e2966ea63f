#include "genu/equilibrium/release.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "genu/contact/elastic_layer.h"
#include "genu/equilibrium/moving_blocks.h"
#include "genu/equilibrium/pose_accuracy.h"
#include "genu/equilibrium/stability.h"
#include "genu/model/ligament_pieces.h"
#include "genu/model/nonsmooth_points.h"

namespace genu {
namespace {

using Kind = ReleasedPlane::Kind;

/// N: distance of the force of a ligament held at a jump from the nearer end of the jump; infinite for others.
double to_end(const JointModel& model, const LigamentPiece& p) {
  if (!p.held) return std::numeric_limits<double>::infinity();
  const LawBreak& b = model.ligaments[at(p.ligament)].law.sharp_breaks()[at(p.piece)];
  return std::min(std::abs(p.force - b.below.force), std::abs(p.force - b.above.force));
}

void add_rows(const MatX& rows, MatX& out) {
  out.conservativeResize(out.rows() + rows.rows(), rows.cols());
  out.bottomRows(rows.rows()) = rows;
}

/// Releases the contact whose equations are block `c` of `at_pose`.
void release_contact(const JointModel& model, const Linearization& at_pose, std::size_t c, Released& out) {
  const std::array<int, 2>& bodies = at_pose.contact_bodies[c];
  VecX closing = VecX::Zero(at_pose.wrench.size());
  for_moving(bodies,
             [&](int from, int to) { closing.segment<6>(to) -= at_pose.contacts[c].direction.segment<6>(from); });
  out.planes.push_back({.gradient = std::move(closing), .kind = Kind::closed});
  EliminatedContact contact;
  if (contact.factor(at_pose.contacts[c], model.scales.length, which_move(bodies))) return;
  contact.factor_minimum_norm(at_pose.contacts[c], model.scales.length, which_move(bodies));
  MatX rows = MatX::Zero(contact.closure.rows(), at_pose.wrench.size());
  for_moving(bodies, [&](int from, int to) { rows.middleCols<6>(to) = contact.closure.middleCols<6>(from); });
  if (rows.rows() > 0) add_rows(rows, out.conforming);
}

/// Removes contacts without force from `state`.
bool release_contacts(const JointModel& model, const std::vector<ActiveContact>& touching, const Target& target,
                      const PoseAccuracy& accuracy, State& state, Released& out) {
  State closed = state;
  closed.contacts.insert(closed.contacts.end(), touching.begin(), touching.end());
  if (closed.contacts.empty()) return false;
  Linearization at_pose;
  at_pose.layers = out.at.layers;  // they know this pose
  linearize(model, closed, target, at_pose);
  std::vector<ActiveContact> kept;
  for (std::size_t c = 0; c < closed.contacts.size(); ++c)
    if (c < state.contacts.size() && std::abs(state.contacts[c].force) > accuracy.of_contact(c))
      kept.push_back(state.contacts[c]);
    else
      release_contact(model, at_pose, c, out);
  state.contacts = std::move(kept);
  return state.contacts.size() < closed.contacts.size();
}

/// Releases ligaments held at a jump whose force has reached one of its ends.
bool release_held(const JointModel& model, const Target& target, const PoseAccuracy& accuracy, State& state,
                  Released& out) {
  auto row = static_cast<Eigen::Index>(constraint_count(model, target));
  bool any = false;
  for (LigamentPiece& p : state.pieces) {
    if (!p.held || to_end(model, p) > accuracy.of_multiplier(row++)) continue;
    const auto& l = model.ligaments[at(p.ligament)];
    const LawBreak& b = l.law.sharp_breaks()[at(p.piece)];
    const bool above = std::abs(p.force - b.above.force) < std::abs(p.force - b.below.force);
    const VecX longer = l.path.length_gradient(state.poses, model.moving_count, state.wraps);
    out.planes.push_back({.gradient = above ? VecX(-longer) : longer, .kind = Kind::closed});
    p.held = false;
    p.piece += above;
    any = true;
  }
  return any;
}

/// Layers begin to press quadratically, as a toe begins to pull. Conforming ones are examined once a motion is known.
bool release_layers(const JointModel& model, const State& state, double force, Released& out) {
  bool any = false;
  LayerWrench pressed;
  for (std::size_t k = 0; k < model.layers.size(); ++k) {
    if (out.at.layer_loads[k] > force) continue;
    out.idle_layers.push_back(static_cast<int>(k));
    if (out.at.layer_loads[k] <= 0) continue;
    any = true;
    const auto& layer = model.layers[k];
    layer.layer->evaluate(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], out.at.layers->each[k], pressed,
                          state.layer_level(k), nullptr);
    const std::array<int, 2> bodies = {model.bodies[at(layer.body_a)].moving, model.bodies[at(layer.body_b)].moving};
    for_moving(bodies, [&](int from, int to) {
      for_moving(bodies, [&](int from2, int to2) {
        out.at.stiffness.block<6, 6>(to, to2) -= pressed.stiffness.block<6, 6>(from, from2);
      });
    });
  }
  return any;
}

/// Removes from the stiffness the laws at nonsmooth points that the pose cannot be told from.
bool release_nonsmooth_points(const JointModel& model, const State& state, const Target& target,
                              const PoseAccuracy& accuracy, Released& out) {
  const VecX unit = stability_metric(out.at.wrench.size());
  bool any = false;
  for (NonsmoothPoint& k : nonsmooth_points_near(model, state, target, accuracy.reach())) {
    if (k.jump != 0) {
      any = true;
      out.planes.push_back({.gradient = k.beyond ? VecX(-k.gradient) : std::move(k.gradient),
                            .kind = k.jump > 0 ? Kind::closed : Kind::drop});
      continue;
    }
    any = any || k.here != 0 || k.below != k.above;
    out.cancelled += std::max({std::abs(k.here), std::abs(k.below), std::abs(k.above)}) *
                     k.gradient.cwiseProduct(unit).norm() * k.wrench.cwiseProduct(unit).norm();
    const double base = k.below == k.above ? k.below : 0;
    out.at.stiffness += (base - k.here) * k.wrench * k.gradient.transpose();
    if (k.below != k.above) out.planes.push_back({std::move(k.gradient), std::move(k.wrench), k.below, k.above});
  }
  return any;
}

}  // namespace

bool may_release(const JointModel& model, const State& state, const Target& target,
                 const std::vector<double>& layer_loads, double residual) {
  const double hardly = PoseAccuracy::least_told(model, residual);
  const auto idle = [hardly](double load) { return std::abs(load) <= hardly; };
  return std::any_of(layer_loads.begin(), layer_loads.end(), idle) ||
         std::any_of(state.contacts.begin(), state.contacts.end(),
                     [&](const ActiveContact& c) { return idle(c.force); }) ||
         std::any_of(state.pieces.begin(), state.pieces.end(),
                     [&](const LigamentPiece& p) { return idle(to_end(model, p)); }) ||
         any_nonsmooth_point_near(model, state, target, PoseAccuracy::widest_reach(model, residual));
}

void release(const JointModel& model, const State& state, const std::vector<ActiveContact>& touching,
             const Target& target, Released& out) {
  linearize(model, state, target, out.at);
  const PoseAccuracy accuracy(model, target, out.at);
  out.conforming.resize(0, out.at.wrench.size());
  State loose = state;
  out.any = release_contacts(model, touching, target, accuracy, loose, out);
  out.any = release_held(model, target, accuracy, loose, out) || out.any;
  if (out.any) linearize(model, loose, target, out.at);
  out.any = release_layers(model, state, accuracy.force(), out) || out.any;
  out.any = release_nonsmooth_points(model, state, target, accuracy, out) || out.any;
}

}  // namespace genu
