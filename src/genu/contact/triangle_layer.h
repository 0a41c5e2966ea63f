// A layer integrated over triangles: one ray from the centroid of each triangle of the casting mesh along its inward
// normal, to the nearest triangle of the other mesh that the ray leaves through, within `search_depth` (Smith, Brandon
// and Thelen 2019: the articular contact of OpenSim-JAM).
//
// Pressure is continuous as rays move over the other mesh and ends abruptly at its edge. So does a measured thickness
// (layer_thickness.h): taken at the ray's start on the casting mesh and at its exit point on the target.
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

  /// Factor of damping on the pressure at a ray with exit point y; 1 without damping.
  static double damped(const LayerMotion& motion, const Vec3& w, const Vec3& y);

  Vec3 depth_rate(const TriangleTree::Hit& hit, const Vec3& direction, double thickness) const;

  /// m: both layers together where a ray meets the target.
  double thickness(int ray, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction) const;

  LayerRays rays_;
  std::vector<double> areas_;  // m^2
  LayerLaw law_;
  LayerThickness thickness_;
};

}  // namespace genu
