#include "genu/equilibrium/sensitivity.h"

#include <cmath>
#include <limits>

#include "genu/model/ligament_rates.h"
#include "genu/model/load_rates.h"

namespace genu {
namespace {

constexpr double kNoRate = std::numeric_limits<double>::quiet_NaN();

}  // namespace

bool Sensitivity::factor(const PosePoint& point) {
  if (!point.solved() || !point.undetermined.none()) return false;
  if (held_count(point.pose.state) > 0) return false;  // a ligament held at a jump of its law
  point_ = &point;
  linearize(*model_, state(), point.target, here_);
  if (!step_.factor(here_, point.target) || !step_.linear().full_rank()) return false;
  joints_.clear();
  for (int j = 0; j < static_cast<int>(model_->joints.size()); ++j) joints_.push_back(joint_point(*model_, state(), j));
  return true;
}

void Sensitivity::differentiate(const Parameter& parameter) {
  parameter_ = parameter;
  residual_rate(*scene_, *model_, state(), point_->target, parameter, rate_);
  step_.solve(rate_, motion_);
}

Vec6 Sensitivity::twist(int body) const {
  const int moving = model_->bodies[at(body)].moving;
  return moving < 0 ? Vec6(Vec6::Zero()) : Vec6(motion_.twist.segment<6>(6 * moving));
}

Vec12 Sensitivity::twists(int body_a, int body_b) const {
  Vec12 out;
  out << twist(body_a), twist(body_b);
  return out;
}

double Sensitivity::coordinate(const CoordinateRef& c) const {
  const auto& joint = model_->joints[at(c.joint)];
  return joints_[at(c.joint)].gradient(c.index).dot(twists(joint.parent, joint.child));
}

double Sensitivity::quantity(const QuantityRef& q) const {
  double sum = 0;
  for_terms(*model_, q, [&](const CoordinateRef& c, double factor) { sum += factor * coordinate(c); });
  return sum;
}

double Sensitivity::reaction(const QuantityRef& q) const {
  const auto& prescribed = point_->target.prescribed;
  for (std::size_t m = 0; m < prescribed.size(); ++m)
    if (prescribed[m].coordinate == q && prescribed[m].drivers.empty())
      return motion_.multipliers[static_cast<Eigen::Index>(m)];
  return kNoRate;
}

double Sensitivity::driving_factor(int load) const {
  const auto& prescribed = point_->target.prescribed;
  for (std::size_t m = 0; m < prescribed.size(); ++m)
    if (std::find(prescribed[m].drivers.begin(), prescribed[m].drivers.end(), load) != prescribed[m].drivers.end())
      return motion_.multipliers[static_cast<Eigen::Index>(m)];
  return kNoRate;
}

/// d(R_P^T w) = R_P^T (dw - w_P x w), for force and moment alike.
Vec6 Sensitivity::held_reaction(int joint) const {
  const auto& j = model_->joints[at(joint)];
  const Vec12 motion = twists(j.parent, j.child);
  const std::size_t first = state().multipliers.size() - model_->held.size();
  Vec6 wrench = Vec6::Zero(), rate = Vec6::Zero();
  for (std::size_t i = 0; i < model_->held.size(); ++i) {
    const CoordinateRef& c = model_->held[i].coordinate;
    if (c.joint != joint) continue;
    const JointPoint& point = joints_[at(joint)];
    const Vec6 direction = point.gradient(c.index).tail<6>().transpose();
    wrench += state().multipliers[first + i] * direction;
    rate += motion_.multipliers[static_cast<Eigen::Index>(first + i)] * direction +
            state().multipliers[first + i] * (point.hessian(c.index).bottomRows<6>() * motion);
  }
  const Vec3 turn = motion.segment<3>(3);
  const Mat3 to_parent = pose(j.parent).R.transpose();
  Vec6 out;
  out << to_parent * (rate.head<3>() - turn.cross(wrench.head<3>())),
      to_parent * (rate.tail<3>() - turn.cross(wrench.tail<3>()));
  return out;
}

std::optional<KneeMotion> Sensitivity::clinical(int joint) const {
  const auto& axes = scene_->joints[at(joint)].grood_suntay;
  if (!axes) return std::nullopt;
  return grood_suntay_rate(*axes, pose(axes->femur.body), pose(axes->tibia.body),
                           twists(axes->femur.body, axes->tibia.body));
}

LigamentMotion Sensitivity::ligament(int index) const {
  const auto& l = model_->ligaments[at(index)];
  const double length = l.path.length(state().poses, state().wraps);
  if (!(length > 0)) return {kNoRate, kNoRate, kNoRate};
  LigamentRate own;
  if (concerns(scene_->ligaments[at(index)], index, parameter_))
    own = ligament_rate({scene_->ligaments[at(index)], l, model_->reference_poses, state().poses,
                         model_->reference_wraps, state().wraps, model_->moving_count},
                        parameter_, scene_->surfaces);
  const double stretch = l.path.length_rate(state().poses, motion_.twist, state().wraps);
  const LigamentLaw& law = l.law;
  return {own.length + stretch, own.strain + stretch / law.slack_length(),
          own.force + law.evaluate(length).stiffness * stretch};
}

ContactMotion Sensitivity::closed(std::size_t index) const {
  const ActiveContact& contact = state().contacts[index];
  const PairChange change = pair_change(*scene_, parameter_, contact.pair, contact.geometry);
  const Vec4& ds = motion_.surface[index];
  return {motion_.forces[static_cast<Eigen::Index>(index)], 0,
          contact.geometry.a.T * ds.head<2>() + change.a.w * contact.geometry.a.n,
          contact.geometry.b.T * ds.tail<2>() + change.b.w * contact.geometry.b.n};
}

/// The nearest points of two separated surfaces satisfy the closure and tangency equations of a contact; the gap is
/// free.
ContactMotion Sensitivity::open(std::size_t index) const {
  const OpenContact& contact = point_->pose.open[index];
  const auto& pair = model_->pairs[at(contact.pair)];
  const Pose &X_a = pose(pair.body_a), &X_b = pose(pair.body_b);
  const PairChange change = pair_change(*scene_, parameter_, contact.pair, contact.geometry);
  ContactBlock block;
  evaluate_contact(X_a, X_b, contact.geometry, 0, block);
  EliminatedContact eliminated;
  if (!eliminated.factor(block, model_->scales.length))
    return {0, kNoRate, Vec3::Constant(kNoRate), Vec3::Constant(kNoRate)};
  eliminated.set_residual(contact_change(X_a, X_b, contact.geometry, 0, change.a, change.b).residual);
  const Vec12 motion = twists(pair.body_a, pair.body_b);
  const Vec4 ds = eliminated.surface_offset + eliminated.surface_gain * motion;
  return {0, eliminated.gap + eliminated.gap_gradient.dot(motion),
          contact.geometry.a.T * ds.head<2>() + change.a.w * contact.geometry.a.n,
          contact.geometry.b.T * ds.tail<2>() + change.b.w * contact.geometry.b.n};
}

double Sensitivity::load_scale(int load) const {
  const Load& l = model_->loads[at(load)];
  if (!l.scale || !l.scale->coordinate()) return 0;
  return genu::load_scale(l, state(), point_->target.time).slope * coordinate(*l.scale->coordinate());
}

double Sensitivity::tension(int load) const {
  const Load& l = model_->loads[at(load)];
  const Target& target = point_->target;
  const double scale = genu::load_scale(l, state(), target.time).factor;
  const double factor = load_factor(target, state(), at(load)), factor_rate = driving_factor(load);
  double rate = l.value * load_scale(load) * factor;
  if (std::isfinite(factor_rate)) rate += l.value * scale * factor_rate;
  if (!parameter_.of_load() || parameter_.object != load) return rate;
  if (parameter_.kind == Parameter::Kind::factor) return rate + l.value * scale;
  return rate + load_change(*scene_, parameter_).value * scale * factor;
}

}  // namespace genu
