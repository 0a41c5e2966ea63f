// Poses on elastic layers that hardly anything holds: their place is an accident of the numbers.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// "3 of 31 poses are barely held, the first at hip.flexion = 20 deg: ...", without a full stop; nothing where no pose
/// is. `poses`: the table of `records`. A pose is barely held where the stiffness of its softest motion is below 0.0005
/// of the force of the layers between the bodies that move, times the length scale: a moment of 0.01 % of force times
/// length turns it by 0.2 rad (the metric of Stability; a translation by 2 mm). Poses do not count where the scene asks
/// for unstable ones (unstable.h), and neither does one among others, near a limit point.
std::vector<std::string> barely_held_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                               const ResultTable& poses);

}  // namespace genu
