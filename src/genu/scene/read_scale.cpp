// Courses: `scale` of a load over a coordinate or time, and what a driven coordinate follows over time.
#include "genu/scene/read_parts.h"

namespace genu {

namespace {

void read_sine(ReadContext& context, const Item& item, const NumberRule& rule, ScaleDef& scale) {
  scale.kind = ScaleDef::Kind::sine;
  if (!is_table(context, item)) return;
  Section section(context, item, "a sine");
  scale.amplitude = read_number(context, section.require("amplitude"), rule).value_or(0);
  scale.frequency = read_number(context, section.require("frequency"), positive(plain_rule("Hz"))).value_or(1);
  scale.start = read_number(context, section.find("start"), plain_rule("s")).value_or(0);
  scale.offset = read_number(context, section.find("offset"), rule).value_or(0);
  section.finish();
}

/// `must_rise`: a jump cannot be followed.
void read_step_in_time(ReadContext& context, const Item& item, const NumberRule& rule, bool must_rise,
                       ScaleDef& scale) {
  scale.kind = ScaleDef::Kind::step;
  if (!is_table(context, item)) return;
  Section section(context, item, "a step in time");
  const NumberRule rise = must_rise ? positive(plain_rule("s")) : non_negative(plain_rule("s"));
  scale.from = read_number(context, section.find("from"), rule).value_or(0);
  scale.to = read_number(context, must_rise ? section.require("to") : section.find("to"), rule).value_or(1);
  scale.start = read_number(context, section.find("start"), plain_rule("s")).value_or(0);
  scale.rise = read_number(context, must_rise ? section.require("rise") : section.find("rise"), rise).value_or(0);
  section.finish();
}

/// What the first numbers of the table are measured in; empty where `over` was not understood.
std::optional<NumberRule> read_over(ReadContext& context, const Item& item, ScaleDef& scale) {
  const auto over = read_string(context, item);
  if (!over) return {};
  if (*over == "time") return plain_rule("s");
  scale.kind = ScaleDef::Kind::over_coordinate;
  const auto coordinate = find_coordinate(context, item.node->where, item.path, *over, literal(*item.node));
  if (!coordinate) return {};
  scale.coordinate = *coordinate;
  return coordinate->index < 3 ? any_turns(angle_rule(context)) : length_rule(context);
}

/// `second`: what the values are called.
void read_table(ReadContext& context, const Item& item, const NumberRule& over, const NumberRule& rule,
                const std::string& second, ScaleDef& scale) {
  if (!is_array(context, item, "points [[x, " + second + "], ...]")) return;
  if (item.node->children.size() < 2)
    refuse(context, item, Code::missing_key, "needs at least two points [x, " + second + "]");
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const Item point = item.element(k);
    if (!is_array(context, point, "a point [x, " + second + "]", 2)) continue;
    const auto x = read_number(context, point.element(0), over);
    const auto value = read_number(context, point.element(1), rule);
    if (!x || !value) continue;
    if (!scale.table.empty() && *x <= scale.table.back().first) {
      refuse(context, point.element(0), Code::out_of_range, "must increase from point to point");
      continue;
    }
    scale.table.emplace_back(*x, *value);
  }
}

/// What stays where it is.
ScaleDef constant(double value) {
  ScaleDef course;
  course.table = {{0, value}, {1, value}};
  return course;
}

/// A controller: pulls a coordinate to its target, more strongly the farther, and against the difference of their
/// rates.
void read_feedback(ReadContext& context, const Item& item, ScaleDef& scale) {
  scale.kind = ScaleDef::Kind::feedback;
  scale.target = std::make_shared<const ScaleDef>(constant(0));
  if (!is_table(context, item)) return;
  Section section(context, item, "feedback");
  const Item of = section.require("of");
  const auto name = read_string(context, of);
  const auto coordinate =
      name ? find_coordinate(context, of.node->where, of.path, *name, literal(*of.node)) : std::nullopt;
  scale.coordinate = coordinate.value_or(CoordinateRef{});
  const bool angle = scale.coordinate.index < 3;
  const NumberRule rule = angle ? any_turns(angle_rule(context)) : length_rule(context);
  const double unit = rule.unit;
  const Item gain = section.require("gain"), rate_gain = section.find("rate_gain");
  const auto stiff = read_number(context, gain, non_negative({})),
             damp = read_number(context, rate_gain, non_negative({}));
  scale.gain = stiff.value_or(0) / unit;
  scale.rate_gain = damp.value_or(0) / unit;
  if (scale.rate_gain != 0 && !context.in_motion)
    refuse(context, rate_gain, Code::no_effect, "needs [dynamics]: without it nothing has a rate");
  if (stiff && scale.gain == 0 && scale.rate_gain == 0)
    refuse(context, gain, Code::no_effect, "is 0, and so is `rate_gain`: the load never acts");
  const Item target = section.require("target");
  if (target.node != nullptr) scale.target = std::make_shared<const ScaleDef>(read_course(context, target, rule));
  section.finish();
}

}  // namespace

std::optional<ScaleDef> read_scale(ReadContext& context, const Item& item) {
  if (!is_table(context, item)) return {};
  Section section(context, item, "the scale of a load");
  ScaleDef scale;
  if (section.has("sine")) {
    section.rename("a scale with a sine");
    read_sine(context, section.find("sine"), plain_rule({}), scale);
  } else if (section.has("step")) {
    section.rename("a scale with a step");
    read_step_in_time(context, section.find("step"), plain_rule({}), !context.in_motion, scale);
  } else if (section.has("feedback")) {
    section.rename("a scale with feedback");
    read_feedback(context, section.find("feedback"), scale);
  } else if (!section.has("over") && !section.has("table")) {
    for (const char* key : {"sine", "step", "feedback", "over", "table"}) section.find(key);
    section.error(Code::missing_key, "", "says nothing: give `over` and `table`, or `sine`, `step` or `feedback`");
  } else {
    const auto rule = read_over(context, section.require("over"), scale);
    read_table(context, section.require("table"), rule.value_or(NumberRule{}), NumberRule{}, "factor", scale);
  }
  section.finish();
  return scale;
}

ScaleDef read_course(ReadContext& context, const Item& item, const NumberRule& rule) {
  ScaleDef course = constant(0);
  if (is_number(*item.node)) return constant(read_number(context, item, rule).value_or(0));
  if (!is_table(context, item)) return course;
  Section section(context, item, "a course over time");
  if (section.has("sine")) {
    read_sine(context, section.find("sine"), rule, course);
  } else if (section.has("step")) {
    read_step_in_time(context, section.find("step"), rule, true, course);
  } else if (section.has("table")) {
    course.table.clear();
    read_table(context, section.find("table"), plain_rule("s"), rule, "value", course);
  } else {
    for (const char* key : {"sine", "step", "table"}) section.find(key);
    section.error(Code::missing_key, "", "says nothing: give `table`, `sine` or `step`, or a number to hold");
  }
  section.finish();
  return course;
}

}  // namespace genu
