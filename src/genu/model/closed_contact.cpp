#include "genu/model/closed_contact.h"

#include <limits>

#include "genu/model/tolerances.h"

namespace genu {

bool evaluate_closed(const JointModel& model, const State& state, ActiveContact& contact, ClosedContact& out) {
  const auto& pair = model.pairs[at(contact.pair)];
  const Pose &X_a = state.poses[at(pair.body_a)], &X_b = state.poses[at(pair.body_b)];
  const double length = model.scales.length;
  ContactBlock block;
  EliminatedContact eliminated;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxClosingSteps; ++k) {
    evaluate_contact(X_a, X_b, contact.geometry, 1, block);
    if (!eliminated.factor(block, length)) return false;
    const Vec4 ds = eliminated.surface_offset;
    const double step = ds.norm() / length;
    if (step <= kClosedStep || (step <= kClosingRounding && step >= last)) {
      out.gap = block.residual[2];
      out.gradient = eliminated.gap_gradient;
      out.curvature = eliminated.stiffness;
      return true;
    }
    last = step;
    const ContactGeometry from = contact.geometry;
    if (!pair.a->retract(from.a, ds.head<2>(), contact.geometry.a)) return false;
    if (!pair.b->retract(from.b, ds.tail<2>(), contact.geometry.b)) return false;
  }
  return false;
}

Vec12 twist_at(const JointModel& model, const ActiveContact& contact, const VecX& twist) {
  const auto& pair = model.pairs[at(contact.pair)];
  const int a = model.bodies[at(pair.body_a)].moving, b = model.bodies[at(pair.body_b)].moving;
  Vec12 out = Vec12::Zero();
  if (a >= 0) out.head<6>() = twist.segment<6>(6 * a);
  if (b >= 0) out.tail<6>() = twist.segment<6>(6 * b);
  return out;
}

void set_row(const JointModel& model, const ActiveContact& contact, const Vec12& gradient, Eigen::Index row,
             MatX& out) {
  const auto& pair = model.pairs[at(contact.pair)];
  const int a = model.bodies[at(pair.body_a)].moving, b = model.bodies[at(pair.body_b)].moving;
  out.row(row).setZero();
  if (a >= 0) out.block<1, 6>(row, 6 * a) += gradient.head<6>().transpose();
  if (b >= 0) out.block<1, 6>(row, 6 * b) += gradient.tail<6>().transpose();
}

}  // namespace genu
