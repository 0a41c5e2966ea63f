// What two meshes of a knee, in one frame, say of themselves: which way is up, where they meet, how wide they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/atlas/given_end.h"
#include "genu/mesh/mesh.h"

namespace genu {

/// A right-handed frame along the axes of the files: anterior x proximal points to the right of the body.
struct KneeLayout {
  Vec3 anterior, proximal, right;  ///< each along an axis of the files, one way or the other
  Vec3 centre;                     ///< m: amid the tibia's plateau, at its highest
  double width = 0, depth = 0;     ///< m: of the tibia near the joint, sideways and from front to back
  double gap = 0;  ///< m: how far the tibia can go toward the femur until they touch; negative where they overlap
  /// m: how much further than the left half the right half of the femur's end reaches forward (the lateral side of the
  /// groove does), and of the tibia's plateau from front to back (the medial half does); 0 where a half is missing
  double ridge = 0, plateau = 0;
  double facing = 0;              ///< part of the tibia, seen along proximal, with some of the femur above or below it
  std::vector<GivenEnd> given{};  ///< ends of ligaments that the user knows: nothing of meshes, but of this knee
};

/// One of "x", "y", "z", "-x", "-y", "-z" as a vector, and back; empty for any other word.
std::optional<Vec3> axis_named(const std::string& word);
std::string axis_word(const Vec3& axis);

/// Proximal goes from the tibia to the femur, sideways is the wider of the tibia's other two axes, and anterior is
/// where the femur is highest (trochlea and shaft stand in front of the condyles). Each is taken from what is given
/// instead, where it is. Empty where `proximal` and `anterior` are along one axis, or a mesh is flat.
std::optional<KneeLayout> lay_out_knee(const Mesh& femur, const Mesh& tibia, std::optional<Vec3> proximal = {},
                                       std::optional<Vec3> anterior = {});

}  // namespace genu
