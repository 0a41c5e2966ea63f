// Which joints of a model a scene can have.
#pragma once

#include <array>
#include <string>

#include "genu/core/types.h"
#include "genu/osim/model.h"

namespace genu::osim {

/// A joint of the model as one of the scene.
struct MovingJoint {
  enum class Kind { free, revolute };
  struct Rotation {
    std::string coordinate;
    int axis = 0;  ///< 0 x, 1 y, 2 z
    bool negative = false;
  };
  int joint = -1;  ///< index into Model::joints
  Kind kind = Kind::free;
  int parent = -1, child = -1;              ///< indices into Skeleton::bodies
  std::array<Rotation, 3> rotations;        ///< free
  std::array<std::string, 3> translations;  ///< free: the coordinates along x, y, z
  std::string angle;                        ///< revolute: its coordinate
  Vec3 axis = Vec3::UnitZ();                ///< revolute: in the parent
  Vec3 origin = Vec3::Zero();               ///< revolute: of the child, in the parent

  /// Whether a coordinate is one of the scene's; a model may have others that move nothing.
  bool has(const std::string& coordinate) const;
};

/// Whether a joint is one of a scene: a free joint (six free axes, each along a coordinate axis, moved by one
/// coordinate with slope 1 or, of a rotation, -1) or a revolute one (one rotation, nothing else moves). Fills in the
/// kind and its coordinates, not the bodies. `why_not` gets the reason where it is neither.
bool read_kind(const Joint& joint, MovingJoint& moving, std::string& why_not);

}  // namespace genu::osim
