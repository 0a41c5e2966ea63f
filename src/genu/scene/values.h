// Single values of a scene file: each function checks type and rule, reports what is wrong, and returns the value in
// SI. An item without a node is a key that is absent: it reads as nothing, silently (Section::require has spoken).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "genu/core/types.h"
#include "genu/scene/read_context.h"
#include "genu/scene/tolerances.h"
#include "genu/scene/toml_document.h"

namespace genu {

/// A value and its key path, e.g. "ligament.AAC.from.point". Elements of arrays count from 1: "surface.S.radii[2]".
struct Item {
  const TomlNode* node = nullptr;
  std::string path;

  explicit operator bool() const { return node != nullptr; }
  Item element(std::size_t index) const;  ///< index from 0; the node must be an array that has it
  Item member(const TomlNode& child) const { return {&child, path.empty() ? child.key : path + "." + child.key}; }
};

/// What a number must be. Bounds are in the file's unit, as the messages are.
struct NumberRule {
  double unit = 1;                 ///< SI per unit of the file
  std::string unit_name;           ///< for messages, e.g. "mm"
  std::optional<double> above;     ///< value > above
  std::optional<double> at_least;  ///< value >= at_least
  double largest = kMaxNumber;     ///< SI: larger numbers are refused
  double smallest = 1e-30;         ///< SI: smaller ones are 0, and refused where 0 is not allowed
  bool within_turn = false;        ///< an angle beyond a turn was probably meant in deg: a warning
};

/// Reports `rule` at the item's value, with the value as found.
void refuse(ReadContext& context, const Item& item, Code code, std::string rule);

/// Whether it is an integer or a float.
bool is_number(const TomlNode& node);

/// Finite, within the rule, and finite in SI. Integers are numbers too. The first angle of a scene that is probably in
/// another unit gets a warning.
std::optional<double> read_number(ReadContext& context, const Item& item, const NumberRule& rule = {});
std::optional<std::int64_t> read_integer(ReadContext& context, const Item& item, std::int64_t least, std::int64_t most);
std::optional<std::string> read_string(ReadContext& context, const Item& item);
std::optional<bool> read_bool(ReadContext& context, const Item& item);
/// An array; `size` elements exactly where it is given. `form` says what is expected, e.g. "three numbers".
bool is_array(ReadContext& context, const Item& item, const std::string& form, std::optional<std::size_t> size = {});
/// [x, y, z], each times unit.
std::optional<Vec3> read_vector(ReadContext& context, const Item& item, const NumberRule& rule = {});
/// [from, to], or one number for both.
std::optional<std::pair<double, double>> read_span(ReadContext& context, const Item& item, const NumberRule& rule);

/// The index of a word among `choices`; words of `not_built` are known, but refused for now.
std::optional<int> read_choice(ReadContext& context, const Item& item, const std::vector<std::string>& choices,
                               const std::vector<std::string>& not_built = {});
/// m per unit, of a word of kLengthUnits.
double read_length_unit(ReadContext& context, const Item& item);
/// The index of a name among `known`; `kind` is "body", "surface", ...
std::optional<int> read_reference(ReadContext& context, const Item& item, const std::string& kind,
                                  const std::vector<std::string>& known);
/// The rule for a name that is not known: lists what is, and suggests the nearest.
std::string unknown_name_rule(const std::string& kind, const std::string& name, const std::vector<std::string>& known);

/// Rules in the file's units.
NumberRule length_rule(const ReadContext& context);
NumberRule angle_rule(const ReadContext& context);  ///< in rad within a turn
NumberRule any_turns(NumberRule rule);              ///< of rates, and of tables that reach beyond what is used
/// Any number, in a unit that no scene chooses.
NumberRule plain_rule(std::string unit_name);
NumberRule positive(NumberRule rule);
NumberRule non_negative(NumberRule rule);

}  // namespace genu
