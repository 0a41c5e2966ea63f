// Counts in sentences.
#pragma once

#include <cstddef>
#include <string>

namespace genu {

/// "1 contact", "12 ligaments", "2 bodies"
inline std::string counted(std::size_t count, const std::string& what) {
  const std::string number = std::to_string(count) + " ";
  if (count == 1) return number + what;
  return number + (what.ends_with("dy") ? what.substr(0, what.size() - 1) + "ies" : what + "s");
}

}  // namespace genu
