// Numbers of an object, read as the table of its kind has them (number_table.h).
#pragma once

#include <cstring>

#include "genu/scene/number_table.h"
#include "genu/scene/section.h"

namespace genu {

/// What a value must be, in the file's units.
NumberRule rule_of(const ReadContext& context, const NumberRow& row);

/// What a caller knows of the objects that it reads.
struct NumbersOf {
  const char* objects = "";    ///< in messages: "joints"
  const char* table = "";      ///< only rows in this table of the object; empty: those beside all other keys
  bool none_required = false;  ///< every number may be left out

  bool requires_row(const NumberRow& row) const {
    return row.presence == NumberRow::Presence::required && !none_required;
  }
};

/// Reads the numbers of one row into `values` (SI), or the value that the row has otherwise; they stay as they are
/// where something is wrong. False where something is wrong or missing.
bool read_number_row(ReadContext& context, Section& section, const NumberRow& row, const NumbersOf& how,
                     double* values);

/// Whether a number is there without the one that it needs. Where that one is required, its absence is reported
/// already.
template <class Def>
bool lacks_other(const Section& section, const KindOf<Def>& kind, const NumberRow& row, const NumbersOf& how) {
  if (row.with == nullptr || !section.has(row.key) || section.has(row.with)) return false;
  for (const NumberOf<Def>& other : kind.numbers)
    if (std::strcmp(other.row.key, row.with) == 0 && how.requires_row(other.row)) return false;
  return true;
}

/// Reads all rows of a table in its order, and refuses what is wrong beside the numbers before it. `def` must have
/// places for them.
template <class Def>
void read_numbers(ReadContext& context, Section& section, const KindOf<Def>& kind, Def& def,
                  const NumbersOf& how = {}) {
  bool good = true;
  for (const NumberOf<Def>& number : kind.numbers) {
    const NumberRow& row = number.row;
    if (std::strcmp(row.table != nullptr ? row.table : "", how.table) != 0) continue;
    good = read_number_row(context, section, row, how, number.values(def)) && good;
    const Item item = section.find(row.key);
    const char* fault = good && item && number.fault != nullptr ? number.fault(def) : nullptr;
    if (lacks_other(section, kind, row, how)) fault = row.reason;
    if (fault != nullptr) refuse(context, item, Code::out_of_range, fault);
  }
}

/// The numbers of a kind that the section gives.
template <class Def>
std::vector<Item> given_numbers(Section& section, const KindOf<Def>& kind) {
  std::vector<Item> out;
  for (const NumberOf<Def>& number : kind.numbers)
    if (const Item item = section.find(number.row.key)) out.push_back(item);
  return out;
}

/// Marks the keys of a kind as known, where the kind is not.
template <class Def>
void know_numbers(Section& section, const KindOf<Def>& kind) {
  for (const NumberOf<Def>& number : kind.numbers) section.find(number.row.table ? number.row.table : number.row.key);
}

}  // namespace genu
