// A region of space in words: "z < 0", "z >= 0 and x < 5".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

inline constexpr const char* kRegionForm =
    "must be conditions such as \"z < 0\" or \"z >= 0 and x < 5\" (x, y, z; <, <=, >, >=)";

/// The conditions of a region, its lengths in units of `length_unit` (m); empty where the text is of another form.
std::optional<std::vector<RegionDef::Condition>> parse_region(const std::string& text, double length_unit);

}  // namespace genu
