// What is changed of the chosen ligaments and menisci of a new knee, so that it passes the standard tests
// (new_laxity.h): least squares of what lies outside of its range, with exact derivatives, within bounds.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "genu/new_scene/new_laxity.h"

namespace genu {

/// One number for all fibres whose names begin so: added to the strain at which they settle, or the logarithm of a
/// factor of their stiffness.
struct NewKneeAim {
  const char* words;  ///< "strain of the ACL"
  std::vector<std::string> fibres;
  bool stiffness = false;
  double least = 0, most = 0;

  double usual() const;  ///< a change that counts as one
};
const std::vector<NewKneeAim>& new_knee_aims();

/// Values of all aims, in their order; 0 where nothing is changed.
using Aims = VecX;

/// For the terminal: what was changed, "strain of the ACL -1.2 %, stiffness of the PCL times 1.44"; empty where nothing
/// was.
std::string text_of(const Aims& aims);

/// The next aims by the derivatives of `found`, which has those to the aims, at `aims`: each changes by at most `reach`
/// usual changes. Where curves end early, what holds a knee is tightened too.
Aims next_aims(const NewKneeLaxity& found, const Aims& aims, double reach);

struct AimedKnee {
  Aims aims;
  NewKneeLaxity laxity;                     ///< with them
  std::string before;                       ///< text of the laxity without them
  std::map<std::string, double> slack;      ///< m, of each fibre
  std::map<std::string, double> stiffness;  ///< N, of each fibre
};

/// Tests `prepared`, and changes what it may until the knee is usual. Without a change where that does not help.
AimedKnee aim_at_ranges(const Prepared& prepared, const Cancelled& cancelled);

}  // namespace genu
