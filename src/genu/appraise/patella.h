// What happens to a patella, in words: that it leaves its groove, is out of it (groove.h), or lies on
// the wrong side of the femur. Sentences without capital and full stop. Of joints
// whose `grood_suntay` names a patella.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

std::vector<std::string> patella_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                           const std::vector<PathEvent>& events);

}  // namespace genu
