// A layer integrated over smooth surfaces. The casting surface is divided into triangles with corners on it. The
// pressure at the corners follows from the depth along the inward normal to the other smooth surface. It is
// interpolated linearly over each triangle, with negative values outside contact, and cut off exactly at its zero line.
//
// With triangles of edge h the error is c h^2 + O(h^4). Integrals I(h) and I(h / 2) are extrapolated to (4 I(h/2) -
// I(h)) / 3, and their difference gives the error (L. F. Richardson 1911). Each is C1 in the pose, and the tangent is
// exact: the motion of the zero line contributes nothing, because the pressure is zero there.
//
// At `level` l each triangle of the mesh has 2^l and 2^(l + 1) divisions along its edges. At the edge of the other
// surface the pressure ends abruptly, also within a triangle.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "genu/contact/layer_quadrature.h"
#include "genu/contact/layer_thickness.h"
#include "genu/contact/smooth_cells.h"

namespace genu {

class SmoothLayer final : public LayerQuadrature {
 public:
  /// `target`: triangles of the surface `other`, in the same frame. A measured thickness belongs to the meshes of
  /// `casting` and `target`: linear over a cell, and at the point where a line along the normal meets the target's
  /// triangles.
  SmoothLayer(std::shared_ptr<const SmoothCells> casting, std::shared_ptr<const Surface> other,
              std::shared_ptr<const TriangleTree> target, double search_depth, const LayerLaw& law,
              LayerThickness thickness);

  void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
           const LayerMotion& motion = {}) const override;
  /// The nodes, and the deepest points found from nodes deeper than all their neighbours; the latter represent no area.
  void visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit, int level = 0,
             const LayerMotion& motion = {}) const override;
  std::vector<Ray> cell_rays() const override;
  const TriangleTree& target() const override { return *target_; }

 private:
  struct Depth {
    bool met = false;
    double depth = 0;       ///< m, negative outside
    Vec3 w = Vec3::Zero();  ///< its derivative, see add_pressure(); in casting axes
    int triangle = -1;      ///< of the target, -1: unknown
    double thickness = 0;   ///< m: measured on the target
    double flat = 0;        ///< m: depth to the target's triangles, there
    Vec3 u = Vec3::Zero();  ///< derivative of `thickness`, see thickness_rate(); in casting axes
  };

  void sum(const Pose& X_TC, Memory& memory, int level, LayerSum& out) const;
  void add_cell(const Pose& X_TC, int cell, int divisions, Memory& memory, LayerSum& out) const;
  void add_triangle(const std::array<SmoothNode*, 3>& nodes, bool fine, Memory& memory, double& load) const;
  bool worth_it(const Pose& X_TC, int cell, int divisions, Memory& memory) const;
  SmoothNode& node(const Pose& X_TC, const SmoothCells::Place& place, Memory& memory) const;
  bool follow(const Pose& X_TC, const SmoothCells::Node& node, double from, Depth& out) const;
  Depth measure_inside(const Pose& X_TC, const SmoothCells::Place& place, const SmoothCells::Node& node, int hint,
                       Memory& memory) const;
  Depth measure(const Pose& X_TC, const SmoothCells::Node& node, int hint) const;
  void add_thickness(const Pose& X_TC, const SmoothCells::Node& node, Depth& out) const;
  double own_thickness(const SmoothCells::Place& place) const;
  LayerPoint deepest_from(const Pose& X_TC, const SmoothNode& node, double spacing) const;

  std::shared_ptr<const SmoothCells> casting_;
  std::shared_ptr<const Surface> other_;
  std::shared_ptr<const TriangleTree> target_;
  double search_depth_, lead_, trust_;  // m
  LayerLaw law_;
  LayerThickness thickness_;
  LayerRays rays_;
};

}  // namespace genu
