#include "genu/law/laws.h"

#include <algorithm>

namespace genu {

const LawKind* find_law(const std::string& name) {
  for (const auto& law : kLaws)
    if (law().name == name) return &law();
  return nullptr;
}

std::vector<std::string> law_keys() {
  std::vector<std::string> keys;
  for (const auto& law : kLaws)
    for (const NumberRow& number : law().numbers)
      if (std::find(keys.begin(), keys.end(), number.key) == keys.end()) keys.push_back(number.key);
  return keys;
}

}  // namespace genu
