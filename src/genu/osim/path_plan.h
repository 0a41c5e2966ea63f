// A path of the model as one of the scene: points of rigid bodies, and between them the surfaces that it wraps round.
#pragma once

#include <string>
#include <vector>

#include "genu/osim/skeleton.h"

namespace genu::osim {

struct PathPlan {
  struct Point {
    int rigid = -1;
    Vec3 point = Vec3::Zero();  ///< m, in the rigid body
  };
  struct Wrap {
    const WrapObject* object = nullptr;
    std::size_t after = 0;  ///< it comes between the points after and after + 1
    double along = 0;       ///< where their straight line comes nearest to it: 0 at the first, 1 at the second
    int rigid = -1;         ///< the body that has it
  };
  std::vector<Point> points;
  std::vector<Wrap> wraps;           ///< in order
  std::vector<std::string> remarks;  ///< what is not as in OpenSim
  std::string problem;               ///< why there is no such path; empty: there is one

  /// Whether it runs over more than one rigid body, with what it wraps round.
  bool crosses() const;
};

/// A wrap object that counts between several points goes between the two whose straight line comes nearest to it at the
/// pose of the import. Several between two points are in the order in which that line comes nearest to them.
PathPlan plan_path(const Model& model, const Skeleton& skeleton, const GeometryPath& path);

/// The wrap object in the rigid body that has it.
struct PlacedWrap {
  int rigid = -1;
  Pose X_rigid_wrap;
};
PlacedWrap place_wrap(const Skeleton& skeleton, const WrapObject& object);

}  // namespace genu::osim
