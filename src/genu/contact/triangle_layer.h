// A layer integrated over triangles: one ray from the centroid of each triangle of the casting mesh along its inward
// normal, to the nearest triangle of the other mesh that the ray leaves through, within `search_depth` (Smith, Brandon
// and Thelen 2019: the articular contact of OpenSim-JAM).
//
// Pressure is continuous as rays move over the other mesh. At its rim a triangle counts by its share over the mesh
// (rim_cover.h), so that the force is continuous there, or as in OpenSim-JAM wholly or not at all. A measured thickness
// (layer_thickness.h) is taken at the ray's start on the casting mesh and at its exit point on the target.
#pragma once

#include <memory>
#include <vector>

#include "genu/contact/layer_quadrature.h"
#include "genu/contact/layer_thickness.h"
#include "genu/contact/rim_cover.h"
#include "genu/mesh/mesh.h"

namespace genu {

class TriangleLayer final : public LayerQuadrature {
 public:
  /// `rim`: of the target, with its thickness; null: a ray counts wholly or not at all.
  TriangleLayer(const Mesh& casting, std::shared_ptr<const TriangleTree> target, double search_depth,
                const LayerLaw& law, LayerThickness thickness, std::shared_ptr<const RimCover> rim = nullptr);

  void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
           const LayerMotion& motion = {}) const override;
  void visit(const Pose& X_TC, Memory& memory, const std::function<void(const LayerPoint&)>& visit, int level = 0,
             const LayerMotion& motion = {}) const override;

  std::vector<Ray> cell_rays() const override { return rays_.rays(); }
  const TriangleTree& target() const override { return rays_.target(); }
  int triangle_count() const { return static_cast<int>(areas_.size()); }

 private:
  /// A place of the other surface that presses on a triangle. Rates are rows (. twist of the casting body).
  struct Touch {
    double depth = 0, thickness = 0;  ///< m
    Vec6 depth_rate = Vec6::Zero();   ///< of the depth that the pressure follows
    double closing = 0;               ///< m/s: that rate, for damping
    double share = 1;                 ///< of the triangle
    Vec6 share_rate = Vec6::Zero();
    int triangle = -1;  ///< of the target
  };
  template <typename Visit>
  void each_over(int part, const Pose& X_TC, Memory& memory, const LayerMotion& motion, Visit visit) const;
  void add_touch(int ray, const Touch& touch, const LayerMotion& motion, LayerSum& out) const;
  Touch touch(int ray, const Pose& X_TC, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction,
              const LayerMotion& motion) const;

  void find_near_rim(const Pose& X_TC, Memory& memory) const;
  RimCover::Disc disc(int ray) const { return {rays_.rays()[at(ray)], radii_[at(ray)], rays_.length()}; }
  /// Calls visit(ray, touch) for every ray that passes beside the target's rim, after the others.
  template <typename Visit>
  void each_beside(const Pose& X_TC, const RimRays& rim, const LayerMotion& motion, Visit visit) const;

  /// m: both layers together where a ray meets the target.
  double thickness(int ray, const TriangleTree::Hit& hit, const Vec3& origin, const Vec3& direction) const;
  Vec3 depth_rate(const TriangleTree::Hit& hit, const Vec3& direction, double thickness) const;

  LayerRays rays_;
  std::vector<double> areas_;  // m^2
  LayerLaw law_;
  LayerThickness thickness_;
  std::shared_ptr<const RimCover> rim_;  // null: none
  std::vector<double> radii_;            // m: of discs as large as the triangles
  double rim_margin_ = 0;                // m
  std::unique_ptr<const LayerRays> rim_rays_;
};

}  // namespace genu
