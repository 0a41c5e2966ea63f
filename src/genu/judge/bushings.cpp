// Bushings: the displacement of frames from poses, forces by virtual work from differences of it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "genu/core/units.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// Axis and angle of a rotation by less than half a turn, as a vector.
Vec3 turn_of(const Mat3& R) {
  const Vec3 twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = 0.5 * twice_sine.norm(), cosine = 0.5 * (R.trace() - 1);
  return sine < 1e-30 ? 0.5 * twice_sine : Vec3(0.5 * twice_sine * (std::atan2(sine, cosine) / sine));
}

Vec6 displacement(const Pose& a, const Pose& b) {
  Vec6 q;
  q << a.R.transpose() * (b.p - a.p), turn_of(a.R.transpose() * b.R);
  return q;
}

/// Moved by v (m) and turned by w (rad) about the frame's origin.
Pose moved(const Pose& frame, const Vec3& v, const Vec3& w) {
  const double angle = w.norm();
  const Mat3 R = angle > 0 ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix() : Mat3(Mat3::Identity());
  return {R * frame.R, frame.p + v};
}

/// Derivative of at(h) at h = 0.
template <typename F>
Vec6 difference(const F& at_step) {
  Vec6 rate = Vec6::Zero();
  for (std::size_t k = 0; k < kDifferenceWeights.size(); ++k) {
    const double h = static_cast<double>(k + 1) * kDifferenceTurn;
    rate += kDifferenceWeights[k] / kDifferenceTurn * (at_step(h) - at_step(-h));
  }
  return rate;
}

class BushingCase {
 public:
  BushingCase(const PoseCase& pose, const BushingDef& def, const std::vector<Motion>* velocities)
      : pose_(pose), def_(def), velocities_(velocities) {
    a_ = pose.poses[at(def.from.body)] * def.from.placement;
    b_ = pose.poses[at(def.to.body)] * placement_of_second();
    q_ = displacement(a_, b_);
    Vec6 numbers;
    numbers << def.stiffness, def.rotation_stiffness;
    K_ = def.matrix ? *def.matrix : Mat6(numbers.asDiagonal());
  }

  /// Differences across half a turn, where the rotation vector jumps, tell nothing.
  bool near_half_turn() const {
    return q_.tail<3>().norm() > std::numbers::pi - static_cast<double>(kDifferenceWeights.size()) * kDifferenceTurn;
  }

  void check_and_add(PoseForces& out) const {
    Vec6 on_b = on_second(-K_ * q_);
    compare(on_b);
    if (velocities_ != nullptr) on_b += on_second(damper());
    const Vec3 force = a_.R * on_b.head<3>(), moment = a_.R * on_b.tail<3>();
    out.forces.push_back({def_.to.body, b_.p, force, moment});
    out.forces.push_back({def_.from.body, b_.p, -force, -moment});
  }

 private:
  /// A frame given by its body alone lies on the other at the reference pose.
  Pose placement_of_second() const {
    if (!def_.coincide) return def_.to.placement;
    const std::vector<Pose> reference = poses_at(pose_.scene(), reference_coordinates(pose_.scene()));
    return reference[at(def_.to.body)].inverse() * reference[at(def_.from.body)] * def_.from.placement;
  }

  /// Force and moment on the second body at its frame's origin, in the axes of the first: the work of f along motions.
  Vec6 on_second(const Vec6& f) const {
    Vec6 out;
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = a_.R.col(i);
      out[i] = f.dot(difference([&](double h) { return displacement(a_, moved(b_, h * axis, Vec3::Zero())); }));
      out[3 + i] = f.dot(difference([&](double h) { return displacement(a_, moved(b_, Vec3::Zero(), h * axis)); }));
    }
    return out;
  }

  Vec6 damper() const {
    const auto moving = [&](const Pose& frame, int body, double h) {
      const Motion& m = (*velocities_)[at(body)];
      return moved(frame, h * (m.v + m.w.cross(frame.p - pose_.poses[at(body)].p)), h * m.w);
    };
    const Vec6 rate =
        difference([&](double h) { return displacement(moving(a_, def_.from.body, h), moving(b_, def_.to.body, h)); });
    Vec6 damping;
    damping << def_.damping, def_.rotation_damping;
    return -damping.cwiseProduct(rate);
  }

  void compare(const Vec6& on_b) const {
    static constexpr const char* kAxes = "xyz";
    const double sure = pose_.length_tolerance(), turn_sure = sure / pose_.subject->size;
    const double stiff = K_.topRows<3>().cwiseAbs().maxCoeff(), turn_stiff = K_.bottomRows<3>().cwiseAbs().maxCoeff();
    const double unsure = kFormulaRounding * on_b.head<3>().norm() + 4 * stiff * (sure + turn_sure);
    const double moment_unsure = kFormulaRounding * on_b.tail<3>().norm() + 4 * turn_stiff * (sure + turn_sure);
    for (int i = 0; i < 3; ++i) {
      const std::string axis(1, kAxes[i]);
      const auto expect = [&](const char* kind, const char* unit, const std::string& column, double value,
                              double tolerance) {
        pose_.out->expect(kind, unit, std::abs(pose_.row(def_.name + column) - value), tolerance, def_.name + column);
      };
      expect("bushing displacements", "mm", "." + axis + "_mm", to::kMillimetre * q_[i], to::kMillimetre * 4 * sure);
      expect("bushing rotations", "deg", ".turn_" + axis + "_deg", to::kDegree * q_[3 + i],
             to::kDegree * 4 * turn_sure);
      expect("bushing forces", "N", ".force_" + axis + "_N", on_b[i], unsure);
      expect("bushing moments", "N m", ".moment_" + axis + "_Nm", on_b[3 + i], moment_unsure);
    }
  }

  const PoseCase& pose_;
  const BushingDef& def_;
  const std::vector<Motion>* velocities_;
  Pose a_, b_;  ///< of the frames
  Vec6 q_;
  Mat6 K_;
};

}  // namespace

void check_bushings(const PoseCase& pose, const std::vector<Motion>* velocities, PoseForces& forces) {
  for (const BushingDef& def : pose.scene().bushings) {
    const BushingCase bushing(pose, def, velocities);
    if (bushing.near_half_turn()) {
      forces.incomplete = true;
      pose.out->skip("bushing " + def.name + " near half a turn, where its moment jumps, and the balance there");
    } else {
      bushing.check_and_add(forces);
    }
  }
}

}  // namespace genu::judge
