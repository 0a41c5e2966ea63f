// Detects a surface entirely inside another one. Then no sample of the outer surface overlaps, and only points of the
// inner one show it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "genu/contact/far_distance.h"
#include "genu/surface/samples.h"

namespace genu {

class Swallowed {
 public:
  /// Searches for points of `inner` inside `outer`. `outer_samples`: samples of `outer`, `spacing` (m) apart. An
  /// unbounded surface is never inner. `edge`, `centre` and `reach` as for FarDistance.
  Swallowed(const Surface& inner, const Surface& outer, const SampleSet& outer_samples, double spacing,
            const Vec3& inner_centre, const Vec3& outer_centre, double reach);

  struct Depth {
    double gap = 0;             ///< m, < 0 where a point is inside, else 0
    Vec3 point = Vec3::Zero();  ///< of the inner surface, in its frame
  };
  /// The deepest of a few points that represent the inner surface. X_oi: its frame in the outer's.
  Depth deepest(const Pose& X_oi);

  /// m, of a point x in the outer surface's frame: negative inside.
  double distance_to_outer(const Vec3& x) { return far().nearest(x).distance; }

  /// Discards all memory.
  void forget() {
    for (Point& point : points_) point.clearance = -1;
  }

 private:
  struct Point {
    Vec3 p;                 ///< m
    double clearance = -1;  ///< m, distance of `at` to the outer surface
    Vec3 at = Vec3::Zero();
  };
  double gap(const Vec3& x, double& clearance);
  const FarDistance& far();

  const Surface* outer_;
  double spacing_, reach_;
  Vec3 outer_centre_;
  std::vector<Point> points_;
  std::vector<Vec3> near_points_, near_normals_;  // a coarse subset of the outer surface's samples
  double cover_ = 0;                // m: largest distance of a point of the outer surface from one of them
  std::optional<FarDistance> far_;  // made on first suspicion: most joints never need it
};

}  // namespace genu
