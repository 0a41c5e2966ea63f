// Numbers as a new scene has them.
#pragma once

#include <string>

#include "genu/core/types.h"

namespace genu {

/// What `text` says becomes "slack_length = ..." of a length in m. Whether it changed by more than kSettledLength.
bool set_slack(std::string& text, double slack);

/// "[1.2, 3, -0.5]": mm to a tenth.
std::string point_text(const Vec3& p);
/// mm to a tenth.
std::string tenths(double metres);

}  // namespace genu
