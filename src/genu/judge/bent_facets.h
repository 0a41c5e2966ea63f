// The triangles of a mesh bent to a smooth surface, independent of the solver's: for layers between smooth surfaces.
//
// A quadric is fitted to the vertices round each vertex. It moves the vertex and gives its normal. Between the corners
// v_i with normals n_i the surface is half-way from the plane of the corners to the planes tangent to them,
//     p + 1/2 sum_i b_i n_i n_i . (v_i - p)     (b_i: barycentric coordinates of p),
// which is exact for quadrics. At creases triangles stay as they are.
#pragma once

#include <array>
#include <vector>

#include "genu/judge/facets.h"

namespace genu::judge {

class BentFacets {
 public:
  /// `fit_radius` (m): within which another surface is fitted to the vertices; 0 where that is not known.
  BentFacets(const Facets& facets, double fit_radius);

  struct Point {
    Vec3 off = Vec3::Zero();  ///< m: from the place on the triangle to the surface
    Vec3 n = Vec3::UnitZ();   ///< outward unit normal there
  };
  /// Over the place p (m) of a triangle.
  Point over(int triangle, const Vec3& p) const;

  /// m: the largest distance from the triangles, but at creases.
  double most() const { return most_; }

  /// m: how far another smooth surface for the same triangles may be from this one within `radius` (m) of x: as far as
  /// wide quadrics are at vertices (root mean square), and a quarter of the bend.
  double doubt(const Vec3& x, double radius) const;

 private:
  /// off = sum b_i along[i] + b_1 b_2 bend[0] + b_2 b_0 bend[1] + b_0 b_1 bend[2], n as sum b_i normals[i].
  struct Triangle {
    std::array<Vec3, 3> along, bend, normals;
    Vec3 scaled = Vec3::Zero();  ///< 1/m^2: its area's vector over twice the square of that
  };
  Triangle bent(int triangle) const;
  struct Fit {
    double moved = 0;  ///< m, along the vertex's normal
    Vec3 n = Vec3::UnitZ();
  };
  Fit fit(int vertex, double reach) const;
  std::vector<int> near_to(int vertex, double reach) const;
  void find_neighbours();
  void find_creases();

  const Facets& facets_;
  double narrow_ = 0, wide_ = 0;  ///< m
  std::vector<std::vector<int>> neighbours_;
  std::vector<bool> sharp_;     ///< vertices
  std::vector<Vec3> vertices_;  ///< moved
  std::vector<Vec3> normals_;   ///< unit
  std::vector<double> moved_;   ///< m
  std::vector<Triangle> triangles_;
  double most_ = 0;
};

}  // namespace genu::judge
