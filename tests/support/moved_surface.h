// A surface moved along its outward normal, which is what the parameter `offset` means, and as a whole.
#pragma once

#include <memory>

#include <Eigen/LU>

#include "genu/surface/surface.h"

namespace genu::test {

/// Points p + d n + shift. With dp = T ds and dn = -T S ds the offset surface has dp' = T (1 - d S) ds, so S' = S (1 -
/// d S)^-1.
class MovedSurface final : public Surface {
 public:
  MovedSurface(std::shared_ptr<const Surface> base, double d, const Vec3& shift)
      : base_(std::move(base)), d_(d), shift_(shift) {}

  bool project(const Vec3& x, SurfacePoint& out) const override { return base_->project(x - shift_, out) && move(out); }
  /// By the base's own step: a foot that is not the closest point (a blend's) would not come back to where it was.
  bool retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const override {
    SurfacePoint base = from;
    base.p -= d_ * from.n + shift_;
    base.S = from.S * (Mat2::Identity() + d_ * from.S).inverse();
    return base_->retract(base, (Mat2::Identity() - d_ * base.S).inverse() * ds, out) && move(out);
  }
  std::optional<double> gap(const Vec3& x) const override {
    const auto g = base_->gap(x - shift_);
    return g ? std::optional(*g - d_) : g;
  }
  double edge_distance(const Vec3& p) const override { return base_->edge_distance(p - shift_); }
  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    return base_->triangles(edge, centre, reach);
  }
  bool is_global() const override { return base_->is_global(); }
  bool knows_distance() const override { return base_->knows_distance(); }
  bool is_unbounded() const override { return base_->is_unbounded(); }

 private:
  bool move(SurfacePoint& point) const {
    point.p += d_ * point.n + shift_;
    point.S = (point.S * (Mat2::Identity() - d_ * point.S).inverse()).eval();
    return true;
  }

  std::shared_ptr<const Surface> base_;
  double d_;
  Vec3 shift_;
};

}  // namespace genu::test
