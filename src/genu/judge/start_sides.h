// Whether bodies have passed through each other between the start of a scene and a pose: with both sheets inside out a
// pose beyond the other bone balances as well as any.
#pragma once

#include <string>
#include <vector>

#include "genu/judge/pose.h"
#include "genu/judge/subject.h"

namespace genu::judge {

/// Pairs of meshes that lie back to back in the reference coordinates: where they are nearest, each vertex of one is
/// behind the other, farther behind outward, as bones are whose surfaces both face inward.
class StartSides {
 public:
  explicit StartSides(const Subject& subject);

  /// A pair that began back to back and is front to front in this pose went through itself.
  void check(const PoseCase& pose) const;

 private:
  struct BackToBack {
    std::string name;
    int a = -1, b = -1;
    double apart = 0;  ///< m: mean distance at the start
  };
  std::vector<BackToBack> pairs_;
};

}  // namespace genu::judge
