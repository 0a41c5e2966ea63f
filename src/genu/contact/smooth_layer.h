// A layer integrated over smooth surfaces. The casting surface is divided into triangular cells with six nodes each on
// it, three corners and three on the sides. The pressure at the nodes follows from the depth along the inward normal to
// the other smooth surface. Over a cell it is quadratic, with negative values outside of contact, and cut off at its
// zero line (quadratic_cell.h).
//
// The integral is C1 in the pose, and the tangent is exact: the motion of the zero line contributes nothing, because
// the pressure is zero there. Its error has two parts: of the integrals over the cells, which their extrapolation tells
// (L. F. Richardson 1911), and of the quadratic between the nodes, which is compared with the surfaces in the middle of
// some cells.
//
// At `level` 0 the cells are the triangles of the mesh, and depths are measured to facets bent through points of the
// other surface; at level l > 0 each triangle is divided into 4^l cells, and depths are measured to the surface itself.
// At the edge of the other surface the pressure ends abruptly, also within a cell.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "genu/contact/layer_quadrature.h"
#include "genu/contact/smooth_depths.h"

namespace genu {

class SmoothLayer final : public LayerQuadrature {
 public:
  explicit SmoothLayer(SmoothDepths depths) : depths_(std::move(depths)) {}

  void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
           const LayerMotion& motion = {}) const override;
  /// The nodes, and the deepest points found from nodes deeper than all their neighbours; the latter represent no area.
  void visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit, int level = 0,
             const LayerMotion& motion = {}) const override;
  std::vector<Ray> cell_rays() const override;
  const TriangleTree& target() const override { return depths_.tree(); }

 private:
  using Six = std::array<SmoothNode*, 6>;
  /// N: the load, and what extrapolation took from that of coarser divisions.
  struct Total {
    double load = 0, removed = 0;
  };

  void sum(const Pose& X_TC, Memory& memory, int level) const;
  void sum_anew(const Pose& X_TC, Memory& memory) const;
  bool worth_it(const Pose& X_TC, int cell, Memory& memory) const;
  void add_cell(const Pose& X_TC, int cell, Memory& memory, Total& out) const;
  bool add_part(const Pose& X_TC, const SmoothPart& part, Memory& memory, Total& out) const;
  bool add_torn(const Six& nodes, Memory& memory, Total& out) const;
  Six nodes(const Pose& X_TC, const SmoothPart& part, int shape, Memory& memory) const;
  int shape(const SmoothPart& part, Memory& memory) const;
  static std::array<SmoothCells::Place, 6> places(const SmoothPart& part, int divisions);
  double interpolation_error(const Pose& X_TC, Memory& memory) const;
  double interpolation_error(const Pose& X_TC, const SmoothPart& part, Memory& memory) const;
  LayerPoint deepest_from(const Pose& X_TC, const SmoothNode& node, double spacing) const;

  SmoothDepths depths_;
};

}  // namespace genu
