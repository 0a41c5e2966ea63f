// Poses where a joint would not stay, which is a reason to doubt a quasi-static answer.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// "12 of 91 poses are unstable, the first at knee.flexion = 34 deg: ...", without a full stop; nothing where no pose
/// is. Stability is judged with the prescribed coordinates held. Not counted are poses where the scene asks for
/// unstable equilibria: steps controlled by arc length, which follow a path round its limit points, and coordinates
/// that loads of unknown factor hold (`drive`), which are kept constant for the verdict.
std::vector<std::string> unstable_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records);

}  // namespace genu
