// Where on its path a joint is, in words; words as a sentence.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"

namespace genu {

/// The varying quantities of a step (from 1; 0: the approach to one): "knee.flexion = 41.2 deg", "load pull x 0.5"; all
/// that is prescribed where nothing varies.
std::string place(const Prepared& prepared, int step, const Target& target);

/// With a capital and a full stop.
std::string as_sentence(std::string words);

/// "a", "a and b", "a, b and c"
std::string joined_with_and(const std::vector<std::string>& names);

}  // namespace genu
