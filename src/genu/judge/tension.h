// Tension of a ligament from its length, by the formulas of docs/scene-reference.md (Ligaments).
#pragma once

#include <vector>

#include "genu/scene/scene.h"

namespace genu::judge {

/// Smallest and largest tension (N) at a length; they differ only where the law jumps.
struct Tension {
  double low = 0, high = 0;
};

class TensionLaw {
 public:
  /// `reference_length` (m): the length in the reference pose.
  TensionLaw(const LigamentDef& def, double reference_length);

  double slack_length() const { return slack_; }  ///< m
  double strain(double length) const { return (length - slack_) / slack_; }
  /// At a length (m) known to `rounding` (m).
  Tension at(double length, double rounding) const;
  /// N: largest force up to the slack length (a table may pull there).
  double force_when_slack() const { return force(0.5 * slack_, slack_); }
  /// N/m: upper bound of the change of force per change of length, near this length.
  double stiffness(double length) const;

 private:
  double force(double length, double slack) const;
  double slack_for(double force, double length) const;
  const LigamentDef* def_;
  double slack_ = 0;
};

/// The points of a ligament's path, in the world.
std::vector<Vec3> path_of(const LigamentDef& ligament, const std::vector<Pose>& poses);
double length_of(const std::vector<Vec3>& path);
/// The body at each of them.
std::vector<int> bodies_on(const LigamentDef& ligament);

}  // namespace genu::judge
