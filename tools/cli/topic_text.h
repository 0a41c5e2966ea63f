// Markdown of docs/ for a terminal: what topics.cpp needs of it.
#pragma once

#include <string>
#include <vector>

namespace genu::cli {

/// The cells of a line "| a | b |"; a bar within `code` parts nothing.
std::vector<std::string> cells_of(const std::string& line);

/// "|---|---|"
bool is_rule_line(const std::string& line);

/// Without the signs of links, code and emphasis.
std::string plain_words(const std::string& markdown);

/// A row as a name and what is said of it, wrapped; the heads of columns from the third on are said.
std::string row_text(const std::vector<std::string>& heads, const std::vector<std::string>& cells);

}  // namespace genu::cli
