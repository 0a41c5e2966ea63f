// Tension of a ligament from its length, by the formulas of docs/scene-reference.md (Ligaments).
#pragma once

#include <vector>

#include "genu/scene/scene.h"

namespace genu::judge {

/// Smallest and largest tension (N) at a length: two numbers only where the law jumps.
struct Tension {
  double low = 0, high = 0;
};

class TensionLaw {
 public:
  /// `reference_length` (m): that at the reference pose.
  TensionLaw(const LigamentDef& def, double reference_length);

  double slack_length() const { return slack_; }  ///< m
  double strain(double length) const { return (length - slack_) / slack_; }
  /// At a length (m) that is known to `rounding` (m).
  Tension at(double length, double rounding) const;
  /// N: at no more than the slack length and below (a table may pull there too).
  double force_when_slack() const { return force(0.5 * slack_, slack_); }
  /// N/m: how much a wrong length matters, at most, near this one.
  double stiffness(double length) const;

 private:
  double force(double length, double slack) const;
  double slack_for(double force, double length) const;
  const LigamentDef* def_;
  double slack_ = 0;
};

/// The points a ligament runs over, in the world.
std::vector<Vec3> path_of(const LigamentDef& ligament, const std::vector<Pose>& poses);
double length_of(const std::vector<Vec3>& path);
/// The body at each of them.
std::vector<int> bodies_on(const LigamentDef& ligament);

}  // namespace genu::judge
