// The values of a ligament's law as the law takes them.
#pragma once

#include "genu/law/law_kind.h"
#include "genu/scene/scene.h"

namespace genu {

/// `kind` is the law that the ligament names.
inline LawValues law_values(const LawKind& kind, const LigamentDef& ligament) {
  LawValues values{{}, ligament.points};
  for (const NumberRow& number : kind.numbers) values.numbers.push_back(ligament.number(number.key));
  return values;
}

}  // namespace genu
