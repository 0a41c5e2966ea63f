// The pages of docs/ that `genu explain` knows, and the scenes of meshes/ that `genu new` writes, as they stand there.
#pragma once

#include <string>
#include <vector>

namespace genu::cli {

struct HelpPage {
  std::string name;  ///< of the file, without its ending
  std::string text;  ///< Markdown or TOML
};

/// In the order in which they are searched; made by cmake/help_pages.cmake.
std::vector<HelpPage> help_pages();

/// Scenes of joints from closed forms.
std::vector<HelpPage> ready_scenes();

}  // namespace genu::cli
