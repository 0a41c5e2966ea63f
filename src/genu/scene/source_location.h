// A place in a scene file.
#pragma once

namespace genu {

/// Where in the scene file something was said (1-based), for messages of later stages.
struct SourceLocation {
  int line = 0;
  int column = 0;

  bool operator==(const SourceLocation&) const = default;
};

}  // namespace genu
