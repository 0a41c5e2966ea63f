#include "genu/judge/joints.h"

#include <cmath>

#include "genu/core/units.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// Right-handed rotation by `angle` about a unit axis: Rodrigues' formula.
Mat3 turn(const Vec3& axis, double angle) {
  const Mat3 k = skew(axis);
  return Mat3::Identity() + std::sin(angle) * k + (1 - std::cos(angle)) * (k * k);
}

Pose pose_in_parent(const JointDef& joint, const std::array<double, 6>& q) {
  Pose X;
  X.R = turn(joint.rotations[0].axis, q[0]) * turn(joint.rotations[1].axis, q[1]) * turn(joint.rotations[2].axis, q[2]);
  X.p = Vec3(q[3], q[4], q[5]);
  return X;
}

}  // namespace

std::string column_of(const Scene& scene, const QuantityRef& q) {
  return quantity_name(scene, q) + (q.is_rotation() ? "_deg" : "_mm");
}

double column_unit(const QuantityRef& q) { return q.is_rotation() ? units::kDegree : units::kMillimetre; }

Coordinates coordinates_in(const Scene& scene, const Row& row) {
  Coordinates q = reference_coordinates(scene);
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
    for (int i = 0; i < 6; ++i)
      if (scene.joints[at(j)].leaves(i)) q[at(j)][at(i)] = row(column_of(scene, {j, i})) * column_unit({j, i});
  return q;
}

Coordinates reference_coordinates(const Scene& scene) {
  Coordinates q;
  for (const JointDef& joint : scene.joints) q.push_back(joint.reference);
  return q;
}

double value_of(const Scene& scene, const Coordinates& q, const QuantityRef& quantity) {
  if (quantity.combination < 0) return q[at(quantity.first.joint)][at(quantity.first.index)];
  double sum = 0;
  for (const auto& term : scene.combinations[at(quantity.combination)].terms)
    sum += term.factor * q[at(term.coordinate.joint)][at(term.coordinate.index)];
  return sum;
}

std::vector<Pose> poses_at(const Scene& scene, const Coordinates& q) {
  std::vector<Pose> poses(scene.bodies.size());
  std::vector<bool> known;
  for (const BodyDef& body : scene.bodies) known.push_back(body.fixed);
  // Joints may be in any order; each round places at least one more body.
  for (std::size_t round = 0; round < scene.joints.size(); ++round)
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      const JointDef& joint = scene.joints[j];
      if (known[at(joint.child)] || !known[at(joint.parent)]) continue;
      poses[at(joint.child)] = poses[at(joint.parent)] * pose_in_parent(joint, q[j]);
      known[at(joint.child)] = true;
    }
  return poses;
}

Motion motion_of(const Scene& scene, const Coordinates& q, const std::vector<Pose>& poses, int joint, int index) {
  const JointDef& def = scene.joints[at(joint)];
  const Mat3& R = poses[at(def.parent)].R;
  Motion motion;
  if (index >= 3) {
    motion.v = R.col(index - 3);
    return motion;
  }
  Mat3 rate = Mat3::Zero();
  for (std::size_t k = 0; k < kDifferenceWeights.size(); ++k) {
    std::array<double, 6> forth = q[at(joint)], back = forth;
    forth[at(index)] += static_cast<double>(k + 1) * kDifferenceTurn;
    back[at(index)] -= static_cast<double>(k + 1) * kDifferenceTurn;
    rate += kDifferenceWeights[k] / kDifferenceTurn * (pose_in_parent(def, forth).R - pose_in_parent(def, back).R);
  }
  const Mat3 spin = rate * pose_in_parent(def, q[at(joint)]).R.transpose();
  motion.w = R * (0.5 * Vec3(spin(2, 1) - spin(1, 2), spin(0, 2) - spin(2, 0), spin(1, 0) - spin(0, 1)));
  return motion;
}

std::vector<bool> carried_by(const Scene& scene, int joint) {
  std::vector<bool> carried(scene.bodies.size(), false);
  carried[at(scene.joints[at(joint)].child)] = true;
  for (std::size_t round = 0; round < scene.joints.size(); ++round)
    for (const JointDef& j : scene.joints)
      if (carried[at(j.parent)]) carried[at(j.child)] = true;
  return carried;
}

}  // namespace genu::judge
