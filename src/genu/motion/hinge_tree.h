// Bodies connected to each other and to fixed ones by hinges only: motion in the hinge angles q, the smallest state.
//
// Hinge j rotates every body k beyond it about its axis a_j (unit, world): the body's centre of mass c_k moves at a_j x
// (c_k - h_j) per unit of q_j', h_j a point of the axis. Projected on these motions (Kane's method), Newton's and
// Euler's laws have no constraints and no multipliers:
//
//   M_ij = sum_k m v_ki . v_kj + a_i . I a_j,
//   M q'' = sum_k v_k . (f - m c''_0) + a . (t - I w'_0 - w x I w) + moments about the hinges,
//
// with v_kj = a_j x (c_k - h_j), f and t the force and the moment about c_k, and c''_0, w'_0 the accelerations for q''
// = 0.
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "genu/model/state.h"

namespace genu {

class HingeTree {
 public:
  /// Whether each joint of a model with inertias holds all its coordinates, or all but the angle of its hinge.
  static bool describes(const JointModel& model);

  /// The model must be one that describes() accepts.
  explicit HingeTree(const JointModel& model);

  Eigen::Index count() const { return static_cast<Eigen::Index>(hinges_.size()); }  ///< of hinges

  /// The joint of each hinge.
  int joint(Eigen::Index hinge) const { return hinges_[static_cast<std::size_t>(hinge)].joint; }
  /// The hinge of a coordinate; -1 for one that a joint holds.
  int hinge(const CoordinateRef& coordinate) const {
    return coordinate.index == 0 ? hinge_of_joint_[static_cast<std::size_t>(coordinate.joint)] : -1;
  }

  /// Sets the poses and the joints' coordinates of `state`, and all twists (6 for each moving body), for angles (rad)
  /// and their rates (rad/s). Poses of fixed bodies are read.
  void place(const VecX& angles, const VecX& rates, State& state, VecX& twist);

  /// The accelerations (rad/s^2) for wrenches on the moving bodies (6 each: N, N m about their origins, world axes) and
  /// moments about the hinges (N m), in the state that place() has set last. False where the mass matrix is singular.
  bool accelerate(const State& state, const VecX& wrench, const VecX& moments, VecX& accelerations);

 private:
  struct Hinge {
    int joint;
    Vec3 axis = Vec3::Zero();   ///< world
    Vec3 point = Vec3::Zero();  ///< of the axis, m
  };
  struct Link {
    int joint, parent, child;
    int hinge;                ///< -1: fixed joint
    std::vector<int> hinges;  ///< that move the child
    Mat3 held;                ///< rotation after the hinge's
    JointValues values;       ///< of all coordinates; the hinge's angle changes
  };
  /// The part of a body's motion that is linear in the rates.
  struct Rates {
    Vec3 w = Vec3::Zero();                    ///< rad/s
    Vec3 v = Vec3::Zero(), a = Vec3::Zero();  ///< m/s and m/s^2 of the pose's origin
    Vec3 turning = Vec3::Zero();              ///< rad/s^2
  };

  void place(const Link& link, const VecX& angles, const VecX& rates, State& state);
  void add(const Link& link, const Pose& X, const Vec6& wrench);

  const JointModel& model_;
  std::vector<Link> links_;  ///< parents before children
  std::vector<Hinge> hinges_;
  std::vector<int> hinge_of_joint_;
  std::vector<Rates> bodies_;         ///< of every body
  std::vector<Vec3> moved_, turned_;  ///< of one body, for each hinge: v_kj, I a_j
  MatX mass_;
  VecX force_;
  Eigen::LLT<MatX> factor_;
};

}  // namespace genu
