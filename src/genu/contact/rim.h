// The rim of a surface that ends, against another surface: where a body would stand on an edge, which has no normal.
//
// Samples stand apart, on the rim too, and those of the other surface do not see it: between two of them a rim may dip
// below. So the rim itself is looked at.
#pragma once

#include <vector>

#include "genu/contact/local_minimum.h"

namespace genu {

class Rim {
 public:
  /// `spacing` (m) of samples, of which a few go to a segment of a closed form's rim; a mesh's is made of its edges.
  /// `reach` (m) bounds unbounded shapes around `centre`, in the frame of its body.
  Rim(const Surface& own, const Surface& other, double spacing, const Vec3& centre, double reach);

  bool empty() const { return segments_.empty(); }

  /// As if nothing had been looked at yet.
  void forget();

  /// Adds the places where the rim lies lowest and below the other surface, and the gap rises from it inward: what
  /// falls inward has its minimum inside and is found there. X_os: from the frame of its body to the other's. In each
  /// contact a is the other surface's point, b the rim's, each in its own body.
  void scan(const Pose& X_os, std::vector<LocalMinimum>& out);

 private:
  struct Point {
    Vec3 p;
    Vec3 at = Vec3::Zero();  ///< where it was when it was last looked at, in the other's frame
    double clearance = -1;   ///< m: by that much it was clear
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
