// Words of tables, scenes and options made comparable: in small letters, without the blanks round them.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace genu {

inline std::string lower_case(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

inline std::string_view trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

}  // namespace genu
