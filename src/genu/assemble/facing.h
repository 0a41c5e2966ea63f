// Which way two surfaces face at the start: whether their outward sides can touch at all.
#pragma once

#include <string>
#include <vector>

#include "genu/model/joint_model.h"
#include "genu/scene/centre_bodies.h"

namespace genu {

enum class Facing {
  unknown,   ///< too little of one lies in front of the other
  opposed,   ///< outward sides face each other, or overlap
  same_way,  ///< one of the two is inside out, where they are nearest
  away       ///< both are: backs face each other, over a gap that widens from the middle as that of two bones does
};

/// How mesh `a` faces mesh `b`, both in the frame of b's body. Lines along the normals of a's triangles decide: what
/// of b each meets first, in front or behind.
Facing how_they_face(const Mesh& a, const Mesh& b);

/// A sentence for each contact whose surfaces do not face each other at the start, with the cure. Only of pairs with a
/// mesh that is `open` (one entry a surface of the scene): a closed one tells its outward side, and so do closed forms.
std::vector<std::string> facing_problems(const PlacedScene& scene, const JointModel& model,
                                         const std::vector<bool>& open);

}  // namespace genu
