// Poses that nothing holds but the error of elastic layers: with exact integrals the motion would be free.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// "3 of 31 poses are barely held, the first at hip.flexion = 20 deg: ...", without a full stop; nothing where no pose
/// is. `poses`: the table of `records`. A ripple of the forces of layers by their tolerance makes stiffness of either
/// sign; where the smallest eigenvalue of the stiffness does not exceed that, stability says nothing. Poses do not
/// count where the scene asks for unstable ones (unstable.h), and neither does one alone, near a limit point.
std::vector<std::string> barely_held_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                               const ResultTable& poses);

}  // namespace genu
