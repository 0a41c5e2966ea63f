#include "genu/assemble/column_units.h"

#include <array>
#include <string_view>

#include "genu/assemble/opensim_names.h"
#include "genu/assemble/plain_text.h"
#include "genu/core/units.h"

namespace genu {
namespace {

constexpr ColumnUnit kUnits[] = {{"deg", units::kDegree, true},
                                 {"rad", units::kRadian, true},
                                 {"mm", units::kMillimetre, false},
                                 {"cm", 10 * units::kMillimetre, false},
                                 {"m", units::kMetre, false}};

struct LongName {
  std::string_view word;
  int unit;  // index into kUnits
};
constexpr LongName kLongNames[] = {{"degree", 0},      {"degrees", 0},     {"\xC2\xB0", 0},   {"\xB0", 0},
                                   {"radian", 1},      {"radians", 1},     {"millimetre", 2}, {"millimeter", 2},
                                   {"millimetres", 2}, {"millimeters", 2}, {"centimetre", 3}, {"centimeter", 3},
                                   {"centimetres", 3}, {"centimeters", 3}, {"metre", 4},      {"meter", 4},
                                   {"metres", 4},      {"meters", 4}};

/// Where "(deg)" or "[deg]" begins at the end of a name; npos where there is none.
std::size_t begin_of_brackets(const std::string& name) {
  if (name.empty() || (name.back() != ')' && name.back() != ']')) return std::string::npos;
  const std::size_t open = name.rfind(name.back() == ')' ? '(' : '[');
  return open == 0 ? std::string::npos : open;
}

/// Takes _deg off the end of a name.
const ColumnUnit* take_ending(std::string& name, bool angle) {
  const std::size_t line = name.rfind('_');
  if (line == std::string::npos || line == 0) return nullptr;
  const ColumnUnit* unit = column_unit(name.substr(line + 1));
  if (unit == nullptr || unit->angle != angle) return nullptr;
  name.resize(line);
  return unit;
}

}  // namespace

const ColumnUnit* column_unit(const std::string& word) {
  const std::string small = lower_case(word);
  for (const ColumnUnit& unit : kUnits)
    if (small == unit.name) return &unit;
  for (const LongName& name : kLongNames)
    if (small == name.word) return &kUnits[name.unit];
  return nullptr;
}

std::string bare_unit(const std::string& text) {
  std::string_view word = trimmed(text);
  if (word.size() > 1 && ((word.front() == '(' && word.back() == ')') || (word.front() == '[' && word.back() == ']')))
    word = trimmed(word.substr(1, word.size() - 2));
  return std::string(word);
}

ColumnLabel column_label(const std::string& name, bool angle) {
  ColumnLabel label;
  label.path = name;
  if (const std::size_t open = begin_of_brackets(name); open != std::string::npos) {
    const std::string written = bare_unit(name.substr(open));
    label.unit = column_unit(written);
    if (label.unit != nullptr)
      label.path = std::string(trimmed(name.substr(0, open)));
    else
      label.unknown = written;
  }
  label.word = last_part_of_path(label.path);
  if (label.unit != nullptr) return label;
  const std::size_t before = label.word.size();
  label.unit = take_ending(label.word, angle);
  // The path ends with the word, unless it is that of a value.
  if (label.path.find('/') == std::string::npos && label.word.size() != before) label.path = label.word;
  return label;
}

}  // namespace genu
