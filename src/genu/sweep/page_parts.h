// Pieces of the pages of sweeps: one file each, without a network.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "genu/results/result_table.h"

namespace genu {

/// In every page of sweeps.
inline constexpr const char* kSweepPageMark = "<meta name=\"generator\" content=\"genu sweep\">";

/// From the beginning of the file to the title; "</body></html>" ends it.
std::string page_head(const std::string& title);

/// A cell of a table's row; words stand left.
std::string page_cell(const std::string& text, bool words = false);

/// Some columns of a table, its first `most` rows.
std::string page_table(const ResultTable& table, const std::vector<std::string>& columns, std::size_t most);

/// A section of charts, `before` in front of them; nothing where all charts are empty.
std::string page_charts(const std::string& title, const std::string& before, std::vector<std::string> charts);

}  // namespace genu
