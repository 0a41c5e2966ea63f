// The pages of docs/ that `genu explain` knows, as they stand there.
#pragma once

#include <string>
#include <vector>

namespace genu::cli {

struct HelpPage {
  std::string name;  ///< of the file, without .md
  std::string text;  ///< Markdown
};

/// In the order in which they are searched; made by cmake/help_pages.cmake.
std::vector<HelpPage> help_pages();

}  // namespace genu::cli
