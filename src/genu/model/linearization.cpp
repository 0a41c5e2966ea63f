#include "genu/model/linearization.h"

#include "genu/model/ligament_pieces.h"
#include "genu/model/load.h"

namespace genu {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Adds the wrench and stiffness of something between two bodies to the moving ones among them.
class TwoBodyScatter {
 public:
  TwoBodyScatter(const JointModel& model, int body_a, int body_b)
      : index_{model.bodies[at(body_a)].moving, model.bodies[at(body_b)].moving} {}

  void add_wrench(const Vec12& wrench, VecX& out) const {
    for (int i = 0; i < 2; ++i)
      if (index_[i] >= 0) out.segment<6>(6 * index_[i]) += wrench.segment<6>(6 * i);
  }
  void add_stiffness(const Mat12& stiffness, MatX& out) const {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (index_[i] >= 0 && index_[j] >= 0)
          out.block<6, 6>(6 * index_[i], 6 * index_[j]) += stiffness.block<6, 6>(6 * i, 6 * j);
  }

 private:
  int index_[2];
};

void add_straight(const JointModel& model, const JointModel::LigamentBetween& l, const State& state, int piece,
                  Linearization& out) {
  TwoBodyWrench pull;
  if (!l.ligament.evaluate(state.poses[at(l.body_a)], state.poses[at(l.body_b)], pull, piece)) return;
  const TwoBodyScatter scatter(model, l.body_a, l.body_b);
  Vec12 wrench;
  wrench << pull.on_a, pull.on_b;
  scatter.add_wrench(wrench, out.wrench);
  scatter.add_stiffness(pull.stiffness, out.stiffness);
}

/// Many lines under one tension T(L), g = dL/dX: wrench = -T g, stiffness = -T' g g^T - T dg/dX.
void add_chain(const JointModel& model, const JointModel::LigamentBetween& l, const State& state,
               const LawValue& tension, Linearization& out) {
  TwoBodyWrench pull;
  Vec12 wrench;
  out.length_gradient.setZero(out.wrench.size());
  for_each_line(l, [&](int body_a, int body_b, const TautLine& line) {
    if (model.bodies[at(body_a)].moving == model.bodies[at(body_b)].moving) return;  // its length is constant
    line.evaluate(state.poses[at(body_a)], state.poses[at(body_b)], 1, 0, pull);
    const TwoBodyScatter scatter(model, body_a, body_b);
    wrench << -pull.on_a, -pull.on_b;
    scatter.add_wrench(wrench, out.length_gradient);
    pull.stiffness *= tension.force;
    scatter.add_stiffness(pull.stiffness, out.stiffness);
  });
  out.wrench -= tension.force * out.length_gradient;
  if (tension.stiffness == 0) return;
  for (Eigen::Index j = 0; j < out.stiffness.cols(); ++j)
    if (out.length_gradient[j] != 0)
      out.stiffness.col(j) -= tension.stiffness * out.length_gradient[j] * out.length_gradient;
}

/// The multiplier is the tension: what shortens the ligament gives the constraint's gradient.
void add_held(const JointModel& model, const JointModel::LigamentBetween& l, const State& state,
              const LigamentPiece& piece, Eigen::Index row, Linearization& out) {
  add_chain(model, l, state, {piece.force, 0, 0}, out);
  out.gradient.row(row) = -out.length_gradient.transpose();
  out.constraint[row] = l.ligament.law.breaks()[at(piece.piece)].length - ligament_length(l, state.poses);
}

void add_ligaments(const JointModel& model, const State& state, Eigen::Index first_held, Linearization& out) {
  auto piece = state.pieces.begin();
  for (std::size_t i = 0; i < model.ligaments.size(); ++i) {
    const auto& l = model.ligaments[i];
    const bool has_piece = piece != state.pieces.end() && at(piece->ligament) == i;
    const int k = has_piece && !piece->by_length ? piece->piece : LigamentLaw::kByLength;
    if (has_piece && piece->held)
      add_held(model, l, state, *piece, first_held++, out);
    else if (l.via.empty())
      add_straight(model, l, state, k, out);
    else if (const LawValue tension = l.ligament.law.evaluate(ligament_length(l, state.poses), k);
             tension.force != 0 || tension.stiffness != 0)
      add_chain(model, l, state, tension, out);
    if (has_piece) ++piece;
  }
}

void add_loads(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const int moving = model.bodies[at(model.loads[i].body)].moving;
    if (moving < 0 || target.load_factors[i] == 0) continue;
    const BodyWrench load = evaluate_load(model.loads[i], state.poses[at(model.loads[i].body)], target.load_factors[i]);
    out.wrench.segment<6>(6 * moving) += load.wrench;
    out.stiffness.block<6, 6>(6 * moving, 6 * moving) += load.stiffness;
  }
}

void add_constraints(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  for (std::size_t m = 0; m < target.prescribed.size(); ++m) {
    const auto& prescribed = target.prescribed[m];
    const auto& joint = model.joints[at(prescribed.coordinate.joint)];
    const JointPoint point = joint.coordinates.evaluate(state.poses[at(joint.parent)], state.poses[at(joint.child)],
                                                        state.coordinates[at(prescribed.coordinate.joint)]);
    const int i = prescribed.coordinate.index;
    const auto row = static_cast<Eigen::Index>(m);
    out.constraint(row) = point.values()[at(i)] - prescribed.value;
    const JointPoint::Gradient gradient = point.gradient(i);
    const int parent = model.bodies[at(joint.parent)].moving, child = model.bodies[at(joint.child)].moving;
    if (parent >= 0) out.gradient.block<1, 6>(row, 6 * parent) = gradient.head<6>();
    if (child >= 0) out.gradient.block<1, 6>(row, 6 * child) = gradient.tail<6>();
    const double multiplier = state.multipliers[m];
    const TwoBodyScatter scatter(model, joint.parent, joint.child);
    scatter.add_wrench(multiplier * gradient.transpose(), out.wrench);
    scatter.add_stiffness(multiplier * point.hessian(i), out.stiffness);
  }
}

void add_contacts(const JointModel& model, const State& state, Linearization& out) {
  for (std::size_t c = 0; c < state.contacts.size(); ++c) {
    const ActiveContact& contact = state.contacts[c];
    const auto& pair = model.pairs[at(contact.pair)];
    ContactBlock& block = out.contacts[c];
    out.contact_bodies[c] = {model.bodies[at(pair.body_a)].moving, model.bodies[at(pair.body_b)].moving};
    evaluate_contact(state.poses[at(pair.body_a)], state.poses[at(pair.body_b)], contact.geometry, contact.force,
                     block);
    const TwoBodyScatter scatter(model, pair.body_a, pair.body_b);
    scatter.add_wrench(contact.force * block.direction, out.wrench);
    scatter.add_stiffness(block.wrench_d_twist, out.stiffness);
  }
}

/// Turns the tangent basis of `to` into that of `from` carried along: a surface's own choice of basis may switch
/// between two neighbouring points, and a residual seen in two bases cannot be compared.
void carry_basis(const SurfacePoint& from, SurfacePoint& to) {
  Mat32 carried;
  carried.col(0) = (from.T.col(0) - to.n * to.n.dot(from.T.col(0))).normalized();
  carried.col(1) = to.n.cross(carried.col(0));
  const Mat2 turn = to.T.transpose() * carried;
  if (!turn.allFinite()) return;  // a quarter turn of the normal at once: keep the surface's own
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

void linearize(const JointModel& model, const State& state, const Target& target, Linearization& out) {
  const int n = 6 * model.moving_count;
  const auto prescribed = static_cast<Eigen::Index>(target.prescribed.size());
  const Eigen::Index m = prescribed + held_count(state);
  out.wrench.setZero(n);
  out.stiffness.setZero(n, n);
  out.gradient.setZero(m, n);
  out.constraint.setZero(m);
  out.contacts.resize(state.contacts.size());
  out.contact_bodies.resize(state.contacts.size());
  add_ligaments(model, state, prescribed, out);
  add_loads(model, state, target, out);
  add_constraints(model, state, target, out);
  add_contacts(model, state, out);
}

VecX load_wrench(const JointModel& model, const State& state, const std::vector<double>& factors) {
  VecX wrench = VecX::Zero(6 * model.moving_count);
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const int moving = model.bodies[at(model.loads[i].body)].moving;
    if (moving < 0 || factors[i] == 0) continue;
    wrench.segment<6>(6 * moving) +=
        evaluate_load(model.loads[i], state.poses[at(model.loads[i].body)], factors[i]).wrench;
  }
  return wrench;
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
  return true;
}

}  // namespace genu
