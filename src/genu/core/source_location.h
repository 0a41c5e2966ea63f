// A place in a text file.
#pragma once

#include <string>

namespace genu {

/// Where in a file something was said (1-based; 0 where there is no such place), for messages of later stages.
struct SourceLocation {
  int line = 0;
  int column = 0;

  bool operator==(const SourceLocation&) const = default;
};

/// The same with the name of the file, as the user gave it.
struct FilePlace {
  std::string file;
  SourceLocation at = {};
};

}  // namespace genu
