// The raw triangles of a mesh in its body's frame: nearest triangle, rays, and bounds on distance and angle of a smooth
// surface through their vertices.
#pragma once

#include <array>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "genu/judge/clearance.h"
#include "genu/judge/rim.h"
#include "genu/mesh/mesh.h"
#include "genu/scene/scene.h"

namespace genu::judge {

class Facets {
 public:
  /// `mesh`: in the frame of its file (m).
  Facets(const Mesh& mesh, const SurfaceDef& def);

  /// Whether x is certainly farther than kOverlapReach edges from all triangles.
  bool clear_of(const Vec3& x) const { return !near_cells_.contains(cell_of(x)); }

  /// Whether x is certainly farther than `reach` (m) from all triangles.
  bool beyond(const Vec3& x, double reach) const { return clearance_.beyond(x, reach); }

  struct Nearest {
    double distance = 0;  ///< m, negative inside
    Vec3 p = Vec3::Zero();
    int triangle = -1;
    bool at_border = false;  ///< beside the sheet: inside and outside are undefined
  };
  /// Within `reach` (m); empty where there is none.
  std::optional<Nearest> nearest(const Vec3& x, double reach) const;

  /// The first triangle that a ray leaves (outward normal along the ray) within `length`: distance (m). Empty also
  /// where the ray enters the surface before: it starts outside and passes through. `entered` receives how far away
  /// that is, `length` or more where it is not known to.
  struct Hit {
    double distance = 0;
    int triangle = -1;
  };
  std::optional<Hit> leaving(const Vec3& origin, const Vec3& direction, double length, double* entered = nullptr) const;

  /// Whether a ray enters the surface (outward normal against the ray) within `length`.
  bool enters(const Vec3& origin, const Vec3& direction, double length) const;
  const Rim& rim() const { return rim_; }

  /// The orientation of a smooth surface near x: mean normal of the triangles there, and its error bounds.
  struct Lean {
    Vec3 normal = Vec3::UnitZ();
    double turn = 0;      ///< rad: the largest angle between that and any triangle's
    double distance = 0;  ///< m: the largest distance of the surface from the triangles
  };
  Lean lean(const Vec3& x, double radius) const;

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const Vec3& area(int triangle) const { return areas_[genu::at(triangle)]; }  ///< m^2, along the outward normal
  Vec3 centroid(int triangle) const;
  double edge() const { return edge_; }  ///< m: mean
  bool in_patch(const Vec3& p) const;
  const Vec3& normal_at(int vertex) const { return vertex_normals_[genu::at(vertex)]; }

 private:
  using Cell = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const;
  };
  Cell cell_of(const Vec3& x) const;
  std::optional<std::size_t> number(const Cell& cell) const;
  template <typename Visit>
  void each_near(const Vec3& low, const Vec3& high, Visit visit) const;
  template <typename Visit, typename Enough>
  void each_crossed(const Vec3& origin, const Vec3& direction, double length, Visit visit, Enough enough) const;
  template <typename Visit>
  void cross(int triangle, const Vec3& origin, const Vec3& direction, double length, Visit visit) const;
  void index();
  void find_normals();

  const SurfaceDef* def_;
  std::vector<Vec3> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Vec3> areas_;
  std::vector<Vec3> vertex_normals_;
  std::vector<std::array<Vec3, 3>> edge_normals_;  // of the edge from corner k to the next
  std::vector<std::array<bool, 3>> border_edge_;
  std::vector<bool> border_vertex_;
  Rim rim_;
  std::vector<std::pair<Vec3, double>> balls_;  // around each triangle
  double edge_ = 0, cell_ = 1;
  std::unordered_map<Cell, std::vector<int>, Hash> cells_;
  Clearance clearance_;
  Cell first_cell_{}, cells_across_{};
  std::vector<bool> occupied_;                 ///< by number: whether the cell has triangles
  std::unordered_set<Cell, Hash> near_cells_;  // all within kOverlapReach edges of a triangle
};

}  // namespace genu::judge
