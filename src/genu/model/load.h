// External loads. Each acts on a body A, and where it is a force or moment between two bodies, with opposite sign on B.
//
//   dead        force at a point of A and moment, both constant in the world
//   follower    the same, turning with A; it has no potential
//   toward      a force of constant size from a point of A toward a point of B: with d from the one to the other,
//               u = d / |d|, the pull on A is t = F u and dt = F / |d| (1 - u u^T) dd; its potential is F |d|
//   coordinate  a generalised moment or force Q on a joint coordinate q of child B in parent A: the wrenches are
//               Q grad q
//   cable       a force of constant size along a path (ligament_path.h) that shortens it; its potential is F L
// Weight is a dead force at the centre of mass. A moment constant in the world has no potential either.
#pragma once

#include <string>

#include "genu/core/pose.h"
#include "genu/model/joint_coordinates.h"
#include "genu/model/ligament_path.h"
#include "genu/model/load_scale.h"

namespace genu {

/// [force, moment about the body's origin] on A and on B in world axes (N, N m), with derivatives to their twists. Zero
/// for B where there is none.
struct LoadWrench {
  Vec12 wrench = Vec12::Zero();
  Mat12 stiffness = Mat12::Zero();  ///< d wrench / d [twist of A; twist of B]; in general unsymmetric
};

struct Load {
  enum class Kind { dead, follower, toward, coordinate, cable };
  std::string name;
  Kind kind = Kind::dead;
  int body_a = -1;
  int body_b = -1;             ///< toward, coordinate; else -1
  Vec3 p_A = Vec3::Zero();     ///< m, in A: where the force acts
  Vec3 p_B = Vec3::Zero();     ///< m, in B: toward
  Vec3 force = Vec3::Zero();   ///< N, dead: in the world, follower: in A
  Vec3 moment = Vec3::Zero();  ///< N m, as the force
  LigamentPath path;           ///< cable
  double value = 0;            ///< toward, cable: N; coordinate: N m for an angle, N for a translation
  CoordinateRef coordinate;    ///< coordinate
  std::optional<LoadScale> scale;

  /// Any load with factor 1 except `coordinate` and `cable`, for the poses of A and B in the world (B is ignored where
  /// there is none). A force toward a point less than 1e-9 m away is 0: its direction is undefined.
  LoadWrench between(const Pose& X_WA, const Pose& X_WB) const;

  /// A load on a coordinate, with factor 1.
  LoadWrench on_coordinate(const JointPoint& joint) const;

  /// N: largest magnitude; moments are divided by `length` (m). Includes scales, not step factors.
  double largest_force(double length) const;
};

/// The load of `def`. Empty where its scale is invalid; `why` then gives the reason.
[[nodiscard]] std::optional<Load> make_load(const PlacedScene& scene, const LoadDef& def, std::string& why);

/// The same without its scale: affine in each single number of `def`.
Load make_unscaled_load(const PlacedScene& scene, const LoadDef& def);

/// Mass times gravity at the centre of mass of `def`, the body of that index of a scene with gravity. Affine as
/// make_unscaled_load().
Load make_weight(const PlacedScene& scene, const BodyDef& def, int body);

}  // namespace genu
