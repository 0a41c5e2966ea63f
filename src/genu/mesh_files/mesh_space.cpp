#include "genu/mesh_files/mesh_space.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

char capital(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

/// One letter of each pair, in any order, and no letter after them.
bool names_three_directions(std::string_view word) {
  for (const std::string_view pair : {"RL", "AP", "SI"})
    if (std::count_if(word.begin(), word.end(), [&](char c) { return pair.find(c) != pair.npos; }) != 1) return false;
  return true;
}

}  // namespace

std::string space_said(std::string_view bytes) {
  std::string head(bytes.substr(0, kSpaceSearched));
  std::transform(head.begin(), head.end(), head.begin(), capital);
  for (std::size_t found = head.find("SPACE"); found != head.npos; found = head.find("SPACE", found + 1)) {
    std::size_t at = head.find_first_not_of(" \t", found + 5);
    if (at == head.npos || (head[at] != '=' && head[at] != ':')) continue;
    at = head.find_first_not_of(" \t", at + 1);
    if (at == head.npos || at + 3 > head.size()) continue;
    const bool ends = at + 3 == head.size() || std::isalnum(static_cast<unsigned char>(head[at + 3])) == 0;
    if (std::string word = head.substr(at, 3); ends && names_three_directions(word)) return word;
  }
  return {};
}

}  // namespace genu
