#include "genu/scene/read_parts.h"

namespace genu {

namespace {

NumberRule plain(std::string unit_name) {
  return {.unit = 1, .unit_name = std::move(unit_name), .above = {}, .at_least = {}};
}

void read_sine(ReadContext& context, const Item& item, ScaleDef& scale) {
  scale.kind = ScaleDef::Kind::sine;
  if (!is_table(context, item)) return;
  Section section(context, item, "a sine");
  scale.amplitude = read_number(context, section.require("amplitude"), plain({})).value_or(0);
  scale.frequency = read_number(context, section.require("frequency"), positive(plain("Hz"))).value_or(1);
  scale.start = read_number(context, section.find("start"), plain("s")).value_or(0);
  section.finish();
}

/// What the first numbers of the table are measured in; empty where `over` was not understood.
std::optional<NumberRule> read_over(ReadContext& context, const Item& item, ScaleDef& scale) {
  const auto over = read_string(context, item);
  if (!over) return {};
  if (*over == "time") return plain("s");
  scale.kind = ScaleDef::Kind::over_coordinate;
  const auto coordinate = find_coordinate(context, item.node->where, item.path, *over, literal(*item.node));
  if (!coordinate) return {};
  scale.coordinate = *coordinate;
  return coordinate->index < 3 ? angle_rule(context) : length_rule(context);
}

void read_table(ReadContext& context, const Item& item, const NumberRule& rule, ScaleDef& scale) {
  if (!is_array(context, item, "points [[x, factor], ...]")) return;
  if (item.node->children.size() < 2) refuse(context, item, "needs at least two points [x, factor]");
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const Item point = item.element(k);
    if (!is_array(context, point, "a point [x, factor]", 2)) continue;
    const auto x = read_number(context, point.element(0), rule);
    const auto factor = read_number(context, point.element(1));
    if (!x || !factor) continue;
    if (!scale.table.empty() && *x <= scale.table.back().first) {
      refuse(context, point.element(0), "must increase from point to point");
      continue;
    }
    scale.table.emplace_back(*x, *factor);
  }
}

}  // namespace

std::optional<ScaleDef> read_scale(ReadContext& context, const Item& item) {
  if (!is_table(context, item)) return {};
  Section section(context, item, "the scale of a load");
  ScaleDef scale;
  if (section.has("sine")) {
    section.rename("a scale with a sine");
    read_sine(context, section.find("sine"), scale);
  } else if (!section.has("over") && !section.has("table")) {
    section.find("sine");
    section.find("over");
    section.find("table");
    section.error("", "says nothing: give `over` and `table`, or `sine`");
  } else {
    const auto rule = read_over(context, section.require("over"), scale);
    read_table(context, section.require("table"), rule.value_or(NumberRule{}), scale);
  }
  section.finish();
  return scale;
}

}  // namespace genu
