// A ligament's law without a scene.
#pragma once

#include <string>
#include <vector>

#include "genu/law/laws.h"
#include "genu/scene/scene.h"

namespace genu::test {

/// The law with those of the numbers (SI) that it has.
inline LigamentDef law_def(const std::string& law, const std::vector<LigamentDef::Number>& numbers) {
  LigamentDef def;
  def.law = law;
  for (const NumberRow& number : find_law(law)->numbers)
    for (const LigamentDef::Number& given : numbers)
      if (given.key == number.key) def.numbers.push_back(given);
  return def;
}

}  // namespace genu::test
