// The share of a casting triangle that lies over an open mesh: what makes the load of a ray continuous at the mesh's
// rim (its border edges).
//
// Seen along its ray, a triangle of area A is a disc of radius r = sqrt(A / pi) round the ray. The border cuts the
// disc. The share of the disc over the mesh is, by Green's theorem, 1 (or 0 for a ray that misses the mesh) less the
// signed circular segments behind the border's chords,
//
//     share = [ray meets the mesh] - sum (angle - sin angle) / 2 pi,
//
// the angle at which the ray sees a chord positive where the mesh and the ray are on the same side. It is continuous
// for corners, holes and cracks alike, and its rate is the flux of the border through its chords.
//
// A ray that misses the mesh takes the depth of the border beside it: the mean over all border edges within r, each at
// its point nearest to the ray at the distance q, with weight (r^2 / q^2 - 1)^2 (Shepard 1968). At the border that is
// the depth on the mesh.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "genu/contact/layer_rays.h"
#include "genu/contact/layer_thickness.h"

namespace genu {

class RimCover {
 public:
  /// Border of a mesh, which thins by `thickness` (null: not at all).
  RimCover(const Mesh& mesh, std::shared_ptr<const ThicknessField> thickness);

  /// Whether the mesh has no border.
  bool closed() const { return edges_.empty(); }
  /// The triangles with a border edge.
  const std::shared_ptr<const TriangleTree>& facets() const { return facets_; }

  struct Disc {
    Ray ray;            ///< in the casting body's frame
    double radius = 0;  ///< m
    double length = 0;  ///< m: reach of the ray
  };

  /// Rates are rows: rate . (twist of the casting body relative to the mesh, at its own origin, in its own axes).
  struct Cover {
    double share = 0;  ///< of the disc over the mesh
    Vec6 share_rate = Vec6::Zero();
    double depth = 0;  ///< m: for a ray that misses the mesh; 0: no border there
    Vec6 depth_rate = Vec6::Zero();
    double thickness = 0;  ///< m, of the mesh there
    Vec6 thickness_rate = Vec6::Zero();
    int triangle = -1;  ///< with the border edge nearest to the ray
  };
  /// For a ray that meets the mesh at `hit` (m along the ray).
  Cover over(const Pose& X_TC, const Disc& disc, double hit) const;
  /// For a ray that misses it.
  Cover beside(const Pose& X_TC, const Disc& disc) const;

 private:
  /// The mesh lies on the left of the way from a to b, seen from outside.
  struct Edge {
    Vec3 a, b;                ///< m
    Vec3 normal;              ///< unit, of its triangle
    double h_a = 0, h_b = 0;  ///< m: thickness
    int triangle = -1;
  };
  struct Node {
    Vec3 low, high;
    int first = 0, last = 0;  ///< edges
    int children = -1;        ///< index of the first of two, -1: none
  };
  static constexpr int kMostDepth = 64;  // of the tree: halves of at most 2^31 edges

  template <typename Visit>
  void each_near(const Ray& ray, double length, double radius, Visit visit) const;
  template <typename Visit>
  void each_seen(const Pose& X_TC, const Disc& disc, Visit visit) const;
  void split(int node);

  std::vector<Edge> edges_;  // in the tree's order
  std::vector<Node> nodes_;  // the root first
  std::shared_ptr<const TriangleTree> facets_;
};

}  // namespace genu
