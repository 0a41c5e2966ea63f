#include "genu/scene/values.h"

#include <fmt/format.h>
#include <cmath>
#include <numbers>
#include <utility>

#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/scene/tolerances.h"
#include "genu/scene/words.h"

namespace genu {

namespace {

std::string with_unit(double value, const std::string& unit_name) {
  return unit_name.empty() ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, unit_name);
}

bool allows_zero(const NumberRule& rule) {
  return !(rule.above && *rule.above >= 0) && !(rule.at_least && *rule.at_least > 0);
}

void warn_turns(ReadContext& context, const Item& item, double radians) {
  constexpr double kTurn = 2 * std::numbers::pi;
  if (std::abs(radians) <= kTurn || std::exchange(context.turns_said, true)) return;
  context.warning(item.node->where, Code::unlikely, item.path, literal(*item.node),
                  fmt::format("is an angle of {:.3g} turns, as units.angle is \"rad\": was \"deg\" meant?",
                              std::abs(radians) / kTurn));
}

}  // namespace

bool is_number(const TomlNode& node) {
  return node.kind == TomlNode::Kind::integer || node.kind == TomlNode::Kind::floating;
}

Item Item::element(std::size_t index) const {
  return {&node->children[index], path + "[" + std::to_string(index + 1) + "]"};
}

void refuse(ReadContext& context, const Item& item, Code code, std::string rule) {
  context.error(item.node->where, code, item.path, literal(*item.node), std::move(rule));
}

std::optional<double> read_number(ReadContext& context, const Item& item, const NumberRule& rule) {
  if (!item) return {};
  const double value = item.node->number;
  const bool is_tiny = std::abs(value * rule.unit) < rule.smallest;  // what programs leave of a zero
  if (is_number(*item.node) && is_tiny && allows_zero(rule)) return 0;
  if (!is_number(*item.node)) {
    refuse(context, item, Code::wrong_form,
           rule.unit_name.empty() ? "must be a number" : "must be a number, in " + rule.unit_name);
  } else if (!std::isfinite(value)) {
    refuse(context, item, Code::out_of_range, "must be a finite number");
  } else if (rule.above && !(value > *rule.above)) {
    refuse(context, item, Code::out_of_range, "must be > " + with_unit(*rule.above, rule.unit_name));
  } else if (rule.at_least && !(value >= *rule.at_least)) {
    refuse(context, item, Code::out_of_range, "must be >= " + with_unit(*rule.at_least, rule.unit_name));
  } else if (!(std::abs(value * rule.unit) <= rule.largest)) {
    refuse(context, item, Code::out_of_range,
           "is out of range: at most " + with_unit(rule.largest / rule.unit, rule.unit_name));
  } else if (is_tiny) {
    refuse(context, item, Code::out_of_range, "is out of range: smaller than anything in a joint");
  } else {
    if (rule.within_turn) warn_turns(context, item, value * rule.unit);
    return value * rule.unit;
  }
  return {};
}

std::optional<std::int64_t> read_integer(ReadContext& context, const Item& item, std::int64_t least,
                                         std::int64_t most) {
  if (!item) return {};
  const TomlNode& node = *item.node;
  if (node.kind == TomlNode::Kind::integer && node.integer >= least && node.integer <= most) return node.integer;
  refuse(context, item, Code::out_of_range, fmt::format("must be an integer from {} to {}", least, most));
  return {};
}

std::optional<std::string> read_string(ReadContext& context, const Item& item) {
  if (!item) return {};
  if (item.node->kind == TomlNode::Kind::string) return item.node->text;
  refuse(context, item, Code::wrong_form, "must be a string in quotes");
  return {};
}

std::optional<bool> read_bool(ReadContext& context, const Item& item) {
  if (!item) return {};
  if (item.node->kind == TomlNode::Kind::boolean) return item.node->boolean;
  refuse(context, item, Code::wrong_form, "must be true or false");
  return {};
}

bool is_array(ReadContext& context, const Item& item, const std::string& form, std::optional<std::size_t> size) {
  if (!item) return false;
  if (item.node->kind == TomlNode::Kind::array && (!size || item.node->children.size() == *size)) return true;
  refuse(context, item, Code::wrong_form, "must be " + form);
  return false;
}

std::optional<Vec3> read_vector(ReadContext& context, const Item& item, const NumberRule& rule) {
  const std::string form = "three numbers [x, y, z]" + (rule.unit_name.empty() ? "" : ", in " + rule.unit_name);
  if (!is_array(context, item, form, 3)) return {};
  Vec3 v;
  bool good = true;
  for (int k = 0; k < 3; ++k) {
    const auto value = read_number(context, item.element(static_cast<std::size_t>(k)), rule);
    v[k] = value.value_or(0);
    good = good && value.has_value();
  }
  return good ? std::optional<Vec3>(v) : std::nullopt;
}

std::optional<std::pair<double, double>> read_span(ReadContext& context, const Item& item, const NumberRule& rule) {
  if (!item) return {};
  if (is_number(*item.node)) {
    const auto value = read_number(context, item, rule);
    return value ? std::make_optional(std::pair(*value, *value)) : std::nullopt;
  }
  const std::string unit = rule.unit_name.empty() ? "" : ", in " + rule.unit_name;
  if (!is_array(context, item, "[from, to] or one number" + unit, 2)) return {};
  const auto from = read_number(context, item.element(0), rule);
  const auto to = read_number(context, item.element(1), rule);
  return from && to ? std::make_optional(std::pair(*from, *to)) : std::nullopt;
}

std::optional<int> read_choice(ReadContext& context, const Item& item, const std::vector<std::string>& choices,
                               const std::vector<std::string>& not_built) {
  if (!item) return {};
  const std::string word = item.node->kind == TomlNode::Kind::string ? item.node->text : std::string();
  for (std::size_t k = 0; k < choices.size(); ++k) {
    if (word == choices[k]) return static_cast<int>(k);
  }
  for (const std::string& later : not_built) {
    if (word != later) continue;
    refuse(context, item, Code::not_built, "not built yet: " + item.node->key + " " + with_quotes(later));
    return {};
  }
  const std::string one_of = choices.size() > 1 ? "must be one of " : "must be ";
  refuse(context, item, Code::unknown_name, one_of + quoted_list(choices) + did_you_mean(word, choices));
  return {};
}

double read_length_unit(ReadContext& context, const Item& item) {
  const auto unit = read_choice(context, item, length_unit_names());
  return kLengthUnits[static_cast<std::size_t>(unit.value_or(0))].metres;
}

std::string unknown_name_rule(const std::string& kind, const std::string& name, const std::vector<std::string>& known) {
  const std::string list = known.empty() ? "the scene has none" : "known: " + quoted_list(known);
  return "unknown " + kind + "; " + list + did_you_mean(name, known);
}

std::optional<int> read_reference(ReadContext& context, const Item& item, const std::string& kind,
                                  const std::vector<std::string>& known) {
  const auto name = read_string(context, item);
  if (!name) return {};
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (*name == known[k]) return static_cast<int>(k);
  }
  refuse(context, item, Code::unknown_name, unknown_name_rule(kind, *name, known));
  return {};
}

NumberRule length_rule(const ReadContext& context) {
  return {.unit = context.scene.length_unit,
          .unit_name = context.length_name,
          .above = {},
          .at_least = {},
          .largest = kMaxLength};
}

NumberRule angle_rule(const ReadContext& context) {
  return {.unit = context.scene.angle_unit,
          .unit_name = context.angle_name,
          .above = {},
          .at_least = {},
          .largest = kMaxAngle,
          .within_turn = context.scene.angle_unit == units::kRadian};
}

NumberRule any_turns(NumberRule rule) {
  rule.within_turn = false;
  return rule;
}

NumberRule plain_rule(std::string unit_name) {
  return {.unit = 1, .unit_name = std::move(unit_name), .above = {}, .at_least = {}};
}

NumberRule positive(NumberRule rule) {
  rule.above = 0;
  return rule;
}

NumberRule non_negative(NumberRule rule) {
  rule.at_least = 0;
  return rule;
}

}  // namespace genu
