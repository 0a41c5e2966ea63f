// Thickness of the two layers of a contact: one number for both, or measured on either mesh.
#pragma once

#include <memory>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

/// Thickness on the mesh of one surface: given at its vertices, linear over each triangle. It is continuous as a
/// contact moves over the mesh, adds no detail between vertices, and has an exact derivative within each triangle; the
/// slope jumps at edges.
class ThicknessField {
 public:
  /// One thickness (m) for each vertex of the mesh. `at_centroids` (one for each triangle, or empty): thickness for
  /// rays that start at centroids; else that of the field. `guessed`: vertices without a measured value; empty: none.
  ThicknessField(const Mesh& mesh, std::vector<double> at_vertices, std::vector<double> at_centroids = {},
                 const std::vector<bool>& guessed = {});

  double at_vertex(int vertex) const { return at_vertices_[static_cast<std::size_t>(vertex)]; }
  double at_centroid(int triangle) const { return at_centroids_[static_cast<std::size_t>(triangle)]; }
  /// At x, on the plane of the triangle, in the mesh's frame.
  double at(int triangle, const Vec3& x) const;
  /// The same for an x that may lie beside the triangle: clamped to the values at its corners.
  double within(int triangle, const Vec3& x) const;
  /// Its derivative to x, within the triangle.
  const Vec3& gradient(int triangle) const { return planes_[static_cast<std::size_t>(triangle)].gradient; }

  /// Whether the thickness at one of the triangle's corners was filled in and not measured.
  bool guessed(int triangle) const { return !guessed_.empty() && guessed_[static_cast<std::size_t>(triangle)]; }

  double least() const { return least_; }  ///< m
  double most() const { return most_; }    ///< m

 private:
  struct Plane {
    Vec3 corner, gradient;
    double h;          ///< at the corner
    double low, high;  ///< at any of them
  };
  std::vector<double> at_vertices_, at_centroids_;
  std::vector<Plane> planes_;  // of each triangle
  std::vector<bool> guessed_;  // the same; empty: none
  double least_ = 0, most_ = 0;
};

/// Thickness (m) of both layers together.
struct LayerThickness {
  double constant = 0;
  std::shared_ptr<const ThicknessField> casting, target;  ///< null: nothing to add to `constant`

  double casting_at(int triangle) const { return constant + (casting ? casting->at_centroid(triangle) : 0); }
  bool guessed(int of_casting, int of_target) const {
    return (casting && casting->guessed(of_casting)) || (target && target->guessed(of_target));
  }
};

}  // namespace genu
