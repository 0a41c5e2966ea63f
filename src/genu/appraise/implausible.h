// Answers that common sense rejects although every equation holds: each is a sentence, beyond limits that a scene can
// set.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/pose_table.h"

namespace genu {

/// "the strain of ACL1 reaches 213 % at knee.flexion = 36 deg (limit 30 %)": strains and forces of ligaments, contact
/// forces over the loads, pressures, contacts and joints far from where they began. One sentence a kind, on the worst.
/// `poses`: the pose_table() of `records`, row by row.
std::vector<std::string> implausible(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                     const ResultTable& poses);

/// The same, with the words for a row.
std::vector<std::string> implausible(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                     const ResultTable& poses, const std::function<std::string(std::size_t)>& where);

/// The same of a motion_table(): without contacts' and joints' ways, which have no start to compare with.
std::vector<std::string> implausible(const Prepared& prepared, const ResultTable& motion);

}  // namespace genu
