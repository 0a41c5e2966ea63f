// A mesh taken as it is: flat triangles, without the smooth surface that rigid contact needs and without its cost.
#pragma once

#include "genu/surface/surface.h"

namespace genu {

class FacetSurface final : public Surface {
 public:
  explicit FacetSurface(Mesh mesh) : mesh_(std::move(mesh)) {}

  /// Facets have no curvature: there is no point of contact to be found on them.
  bool project(const Vec3&, SurfacePoint&) const override { return false; }
  std::optional<double> gap(const Vec3&) const override { return std::nullopt; }
  /// The mesh, whatever the edge.
  Mesh triangles(double, const Vec3&, double) const override { return mesh_; }
  std::span<const DoubtfulPlace> doubtful() const override { return doubtful_; }
  bool is_global() const override { return false; }

  void set_doubtful(std::vector<DoubtfulPlace> places) { doubtful_ = std::move(places); }

 private:
  Mesh mesh_;
  std::vector<DoubtfulPlace> doubtful_;
};

}  // namespace genu
