// What common sense rejects in a laxity test although every equation holds.
#pragma once

#include <string>
#include <vector>

#include "genu/study/laxity_result.h"

namespace genu {

/// The doubts that a run of the same poses would raise (appraise/implausible.h): one sentence a kind, on the worst pose
/// of all angles, "the strain of ACL reaches 41 % at 30 deg, 134 N anterior (limit 30 %)".
std::vector<std::string> laxity_doubts(const LaxityOfScene& tested);

}  // namespace genu
