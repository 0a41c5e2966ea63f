// A joint whose surfaces never press on each other.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// "no contact bears any load at any pose ...", without a full stop, where the scene has contacts and poses are solved;
/// else nothing. `poses`: the table of `records`.
std::vector<std::string> untouched_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                             const ResultTable& poses);

/// Whether that is a reason to doubt the answer: in a knee (a joint with `grood_suntay` of femur and tibia) under
/// loads. Elsewhere ligaments alone may well hold a body.
bool needs_contact(const Prepared& prepared);

}  // namespace genu
