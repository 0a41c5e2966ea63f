#include "genu/model/correction.h"

#include "genu/model/ligament_pieces.h"

namespace genu {
namespace {

/// Rotates the tangent basis of `to` to the parallel transport of that of `from`. A surface's own choice of basis may
/// switch between neighbouring points, and residuals in two bases cannot be compared.
void carry_basis(const SurfacePoint& from, SurfacePoint& to) {
  if (to.T == from.T) return;
  // The shortest rotation from one normal to the other: parallel transport along a geodesic, with an error of third
  // order in its length.
  Mat32 carried;
  const double both = 1 + from.n.dot(to.n);
  if (!(both > 0)) return;
  carried.col(0) = from.T.col(0) - to.n.dot(from.T.col(0)) / both * (from.n + to.n);
  carried.col(1) = to.n.cross(carried.col(0));
  const Mat2 turn = to.T.transpose() * carried;
  if (!turn.allFinite()) return;  // the normal has reversed: keep the surface's own basis
  to.S = turn.transpose() * to.S * turn;
  to.T = carried;
}

}  // namespace

void Correction::resize(int moving_bodies, int constraints, int contacts) {
  twist.resize(6 * moving_bodies);
  multipliers.resize(constraints);
  surface.resize(at(contacts));
  forces.resize(contacts);
}

bool Correction::matches(const Correction& other) const {
  return twist.size() == other.twist.size() && multipliers.size() == other.multipliers.size() &&
         surface.size() == other.surface.size() && forces.size() == other.forces.size();
}

void Correction::add(double factor, const Correction& other) {
  twist += factor * other.twist;
  multipliers += factor * other.multipliers;
  for (std::size_t c = 0; c < surface.size(); ++c) surface[c] += factor * other.surface[c];
  forces += factor * other.forces;
  parameter += factor * other.parameter;
}

void Correction::scale(double factor) {
  twist *= factor;
  multipliers *= factor;
  for (Vec4& ds : surface) ds *= factor;
  forces *= factor;
  parameter *= factor;
}

void update_coordinates(const JointModel& model, State& state) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const auto& joint = model.joints[j];
    const Pose X_PC = state.poses[at(joint.parent)].inverse() * state.poses[at(joint.child)];
    state.coordinates[j] = joint.coordinates.coordinates(X_PC, state.coordinates[j]);
  }
}

bool retract(const JointModel& model, const State& state, const Correction& correction, double fraction, State& out) {
  out = state;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const int moving = model.bodies[i].moving;
    if (moving >= 0) out.poses[i] = retract(state.poses[i], Vec6(fraction * correction.twist.segment<6>(6 * moving)));
  }
  for (std::size_t m = 0; m < state.multipliers.size(); ++m)
    out.multipliers[m] += fraction * correction.multipliers(static_cast<Eigen::Index>(m));
  auto held = static_cast<Eigen::Index>(state.multipliers.size());
  for (LigamentPiece& piece : out.pieces)
    if (piece.held) piece.force += fraction * correction.multipliers(held++);
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    ActiveContact& contact = out.contacts[c];
    const auto& pair = model.pairs[at(contact.pair)];
    const ContactGeometry& from = state.contacts[c].geometry;
    const Vec4 ds = fraction * correction.surface[c];
    if (!pair.a->retract(from.a, ds.head<2>(), contact.geometry.a)) return false;
    if (!pair.b->retract(from.b, ds.tail<2>(), contact.geometry.b)) return false;
    carry_basis(from.a, contact.geometry.a);
    carry_basis(from.b, contact.geometry.b);
    contact.force += fraction * correction.forces(static_cast<Eigen::Index>(c));
  }
  update_coordinates(model, out);
  return follow_wraps(model, out);
}

}  // namespace genu
