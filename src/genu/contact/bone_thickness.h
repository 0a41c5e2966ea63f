// Cartilage thickness from a mesh of the bone under it.
//
// From each vertex and each triangle centroid of the cartilage mesh a ray along the inward normal searches for the
// bone. Where it finds none (bone meshes often end before the cartilage, and nothing lies under the back of a closed
// shell) the thickness is that of the nearest rings of vertices that have one.
#pragma once

#include <memory>

#include "genu/contact/layer_thickness.h"
#include "genu/mesh/triangle_tree.h"

namespace genu {

/// The bone under one surface, in the frame of the body that carries both. The winding of its triangles is irrelevant:
/// the side that more rays meet is the outer one.
struct BoneUnder {
  std::shared_ptr<const TriangleTree> triangles;
  double least = 0.5e-3;  ///< m: lower bound, where cartilage is thinner or bone protrudes
  double most = 10e-3;    ///< m: bone farther away does not belong to this cartilage
};

/// Quality of the measurement at the vertices.
struct BoneReport {
  int vertices = 0;
  int without = 0;      ///< vertices without bone, under or protruding
  double farthest = 0;  ///< m: largest distance along edges of such a vertex from one with bone
  Vec3 farthest_place = Vec3::Zero();
  int thin = 0;         ///< vertices below the lower bound, protruding bone included
  double thinnest = 0;  ///< m: the smallest of these; negative where bone protrudes
  Vec3 thinnest_place = Vec3::Zero();
};

/// Null where no vertex has bone under it.
std::shared_ptr<const ThicknessField> measure_thickness(const Mesh& cartilage, const BoneUnder& bone,
                                                        BoneReport& report);

}  // namespace genu
