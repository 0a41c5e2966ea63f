// Poses where a joint would not stay, which is a reason to doubt a quasi-static answer.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// Why the scene asks for unstable poses there, in words for the first sentence of the verdict; empty where it does
/// not. A step controlled by arc length follows its path round limit points. Loads of unknown factor that hold a
/// coordinate (`drive`) are kept constant for the stability.
std::string why_unstable(const Prepared& prepared, const PosePoint& point);

/// "12 of 91 poses are unstable, the first at knee.flexion = 34 deg: ...", without a full stop; nothing where no pose
/// is. Stability is judged with the prescribed coordinates held. Poses that the scene asks for do not count.
std::vector<std::string> unstable_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records);

}  // namespace genu
