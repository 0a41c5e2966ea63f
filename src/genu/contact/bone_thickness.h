// Thickness of cartilage from a mesh of the bone under it.
//
// At each vertex and at each centroid of the cartilage's mesh a ray along minus the outward normal looks for the bone.
// Where it finds none (the bone's mesh often ends before the cartilage's does, and nothing lies under the back of a
// closed shell) the thickness is that of the nearest rings of vertices that have one.
#pragma once

#include <memory>

#include "genu/contact/layer_thickness.h"
#include "genu/mesh/triangle_tree.h"

namespace genu {

/// The bone under one surface, in the frame of the body that carries both. Which way its triangles are wound does not
/// matter: the side that more rays meet is the outer one.
struct BoneUnder {
  std::shared_ptr<const TriangleTree> triangles;
  double least = 0.5e-3;  ///< m: where cartilage is thinner, or bone stands out of it, it counts as this thick
  double most = 10e-3;    ///< m: bone farther away is not the bone under this cartilage
};

/// How well it went, at the vertices.
struct BoneReport {
  int vertices = 0;
  int without = 0;      ///< have no bone under them, nor standing out over them
  double farthest = 0;  ///< m: the one of these that is farthest from any vertex that has bone, along edges
  Vec3 farthest_place = Vec3::Zero();
  int thin = 0;         ///< thinner than the least, bone standing out included
  double thinnest = 0;  ///< m: of these; negative where bone stands out
  Vec3 thinnest_place = Vec3::Zero();
};

/// Null where no vertex has bone under it.
std::shared_ptr<const ThicknessField> measure_thickness(const Mesh& cartilage, const BoneUnder& bone,
                                                        BoneReport& report);

}  // namespace genu
