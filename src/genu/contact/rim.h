// The rim of an open surface against another surface. A body may rest on such an edge, which has no normal.
//
// Samples have a spacing, on the rim too, and samples of the other surface do not detect a rim: between two of them it
// may dip into the other surface. So the rim itself is searched.
#pragma once

#include <vector>

#include "genu/contact/local_minimum.h"

namespace genu {

class Rim {
 public:
  /// `spacing` (m) of samples; a segment of a closed form's rim spans a few of them, a mesh's rim consists of its
  /// edges. `reach` (m) bounds unbounded shapes around `centre`, in the frame of its body.
  Rim(const Surface& own, const Surface& other, double spacing, const Vec3& centre, double reach);

  bool empty() const { return segments_.empty(); }

  /// Discards all memory.
  void forget();

  /// Adds the places where the rim has its lowest points below the other surface and the gap rises inward. (If it
  /// decreases inward, its minimum is inside and is found there.) X_os: pose of this body in the other's frame. In each
  /// contact a is the other surface's point, b the rim's, each in its own body.
  void scan(const Pose& X_os, std::vector<LocalMinimum>& out);

 private:
  struct Point {
    Vec3 p;
    Vec3 at = Vec3::Zero();  ///< position when last tested, in the other's frame
    double clearance = -1;   ///< m: clearance then
    double gap = 0;          ///< m, now
  };
  struct Segment {
    int from, to;
    Vec3 inside;  ///< a point of the surface inward of it
  };

  double look_at(Point& point, const Pose& X_os) const;
  double gap_at(const Pose& X_os, const Vec3& p, LocalMinimum* found) const;
  Vec3 lowest_on(const Segment& segment, const Pose& X_os) const;

  const Surface* own_ = nullptr;
  const Surface* other_ = nullptr;
  double spacing_ = 0;  // m: of the rim's points
  std::vector<Point> points_;
  std::vector<Segment> segments_;
};

}  // namespace genu
