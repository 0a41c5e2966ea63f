#include "genu/scene/read_numbers.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/scene/words.h"

namespace genu {
namespace {

NumberRule unit_rule(const ReadContext& context, Unit unit) {
  if (unit == Unit::length) return length_rule(context);
  if (unit == Unit::angle) return angle_rule(context);
  const ChosenUnits chosen{context.scene.length_unit, context.scene.angle_unit, context.length_name,
                           context.angle_name};
  return {.unit = si(unit, chosen), .unit_name = unit_name(unit, chosen), .above = {}, .at_least = {}};
}

/// The numbers in SI; empty where one is wrong.
std::optional<Vec3> read_values(ReadContext& context, const Item& item, const NumberRow& row) {
  if (row.size == 3) return read_vector(context, item, rule_of(context, row));
  const auto value = read_number(context, item, rule_of(context, row));
  return value ? std::optional<Vec3>(Vec3::Constant(*value)) : std::nullopt;
}

}  // namespace

NumberRule rule_of(const ReadContext& context, const NumberRow& row) {
  const NumberRule rule = unit_rule(context, row.unit);
  switch (row.range) {
    case NumberRow::Range::any:
      return rule;
    case NumberRow::Range::at_least_zero:
      return non_negative(rule);
    case NumberRow::Range::above_zero:
    case NumberRow::Range::above_zero_or_limit:
      break;
  }
  return positive(rule);
}

bool read_number_row(ReadContext& context, Section& section, const NumberRow& row, const NumbersOf& how,
                     double* values) {
  const bool required = how.requires_row(row);
  const Item item = required ? section.require(row.key) : section.find(row.key);
  if (!item) {
    std::fill_n(values, row.size, row.otherwise);
    return !required;
  }
  if (row.in_motion && !context.in_motion) {
    context.error(item.node->key_where, Code::no_effect, item.path, literal(*item.node),
                  fmt::format("{} of {} has an effect only in a scene with [dynamics]", row.key, how.objects));
    return false;
  }
  const auto read = read_values(context, item, row);
  if (read) std::copy_n(read->data(), row.size, values);
  return read.has_value();
}

}  // namespace genu
