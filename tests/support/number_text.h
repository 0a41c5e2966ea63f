// The keys of a table of numbers as text of a scene: a new row is in the tests that use it.
#pragma once

#include <cstring>
#include <string>

#include <fmt/format.h>

#include "genu/scene/number_table.h"

namespace genu::test {

/// SI; lengths fall and angles rise from row to row, as a torus and limits need it.
inline double some_value(Unit unit, int row) {
  switch (unit) {
    case Unit::length:
      return 0.1 - 7e-3 * row;
    case Unit::angle:
      return 0.1 * (row + 1);
    case Unit::number:
      return 0.8;
    default:
      return 0.5 + 0.1 * row;
  }
}

/// "key = value" lines of all numbers of a kind that stand in `table`, in the units `chosen`.
template <class Def>
std::string number_text(const KindOf<Def>& kind, const ChosenUnits& chosen, const char* table = "") {
  std::string out;
  int k = 0;
  for (const NumberOf<Def>& number : kind.numbers) {
    const NumberRow& row = number.row;
    const double value = some_value(row.unit, k++) / si(row.unit, chosen);
    if (std::strcmp(row.table ? row.table : "", table) != 0) continue;
    const std::string one = fmt::format("{:.17g}", value);
    out += row.size > 1 ? fmt::format("{0} = [{1}, {1}, {1}]\n", row.key, one) : fmt::format("{} = {}\n", row.key, one);
  }
  return out;
}

/// How many numbers a kind has, each component of a vector by itself.
template <class Def>
int number_count(const KindOf<Def>& kind) {
  int out = 0;
  for (const NumberOf<Def>& number : kind.numbers) out += number.row.size;
  return out;
}

}  // namespace genu::test
