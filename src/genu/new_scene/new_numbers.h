// Numbers as a new scene has them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "genu/core/types.h"
#include "genu/results/result_table.h"

namespace genu {

/// What `text` says becomes "slack_length = ..." of a length in m. Whether it changed by more than kSettledLength.
bool set_slack(std::string& text, double slack);

/// The word between @ in a text of ligaments for the length of a fibre.
std::string length_word(const std::string& fibre);

/// The word for its stiffness, and what stands for that word: N at a strain of 1.
std::string stiffness_word(const std::string& fibre);
std::string stiffness_text(double stiffness);

/// m: the length of a fibre in a row; empty where that row was not solved, or has no such fibre.
std::optional<double> length_in(const ResultTable& poses, std::size_t row, const std::string& fibre);

/// "[1.2, 3, -0.5]": mm to a tenth.
std::string point_text(const Vec3& p);
/// mm to a tenth.
std::string tenths(double metres);

}  // namespace genu
