// The layer summed over triangles: one ray from the centroid of each triangle of the casting mesh along minus its
// normal, to the nearest triangle of the other mesh that the ray comes out of, not deeper than `search_depth`
// (Smith, Brandon and Thelen 2019: OpenSim-JAM's articular contact).
//
// Pressure is continuous while rays wander over the other mesh; where a ray runs off its edge it ends at once. So is a
// measured thickness (layer_thickness.h): at the ray's start on the casting mesh, where the ray comes out on the
// target.
#pragma once

#include <memory>
#include <vector>

#include "genu/contact/layer_quadrature.h"
#include "genu/contact/layer_thickness.h"
#include "genu/mesh/mesh.h"

namespace genu {

class TriangleLayer final : public LayerQuadrature {
 public:
  TriangleLayer(const Mesh& casting, std::shared_ptr<const TriangleTree> target, double search_depth,
                const LayerLaw& law, LayerThickness thickness);

  void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
           const LayerMotion& motion = {}) const override;
  void visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit, int level = 0,
             const LayerMotion& motion = {}) const override;

  std::vector<Ray> cell_rays() const override { return rays_.rays(); }
  const TriangleTree& target() const override { return rays_.target(); }
  int triangle_count() const { return static_cast<int>(areas_.size()); }

 private:
  void add_part(int part, const Pose& X_TC, Memory& memory, const LayerMotion& motion, LayerSum& out) const;

  /// 1, or what damping makes of the pressure at a ray that comes out at y.
  static double damped(const LayerMotion& motion, const Vec3& w, const Vec3& y);

  Vec3 depth_rate(const TriangleTree::Hit& hit, const Vec3& direction, double thickness) const;

  /// Both layers together where a ray meets the target, m.
  double thickness(int ray, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction) const;

  LayerRays rays_;
  std::vector<double> areas_;  // m^2
  LayerLaw law_;
  LayerThickness thickness_;
};

}  // namespace genu
