// The border of a mesh as the rays of a triangle layer see it: how much of a disc round a ray lies over the mesh, and
// how deep the border lies beside a ray that misses it (docs/scene-reference.md, Cartilage: `rim`).
#pragma once

#include <optional>
#include <vector>

#include "genu/core/types.h"

namespace genu::judge {

class Rim {
 public:
  /// An edge with one triangle, which lies on the left of the way from a to b, seen from outside.
  struct Edge {
    Vec3 a, b, normal;  ///< m; of the triangle
  };
  void add(const Edge& edge) { edges_.push_back(edge); }

  struct Disc {
    Vec3 origin, direction;
    double radius = 0, reach = 0;  ///< m
  };
  struct Part {
    double share = 0;  ///< of the disc
    double depth = 0;  ///< m: at the ray, or beside it
  };
  /// `met`: m along the ray to the mesh; empty for a ray that misses it.
  Part part(const Disc& disc, const std::optional<double>& met) const;

 private:
  std::vector<Edge> edges_;
};

}  // namespace genu::judge
