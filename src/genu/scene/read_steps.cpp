#include <algorithm>

#include <fmt/format.h>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

void read_prescribed(ReadContext& context, const Item& item, const std::string& name, StepDef& step) {
  const auto coordinate = find_quantity(context, item.node->key_where, item.path, name);
  if (!coordinate) {
    read_span(context, item, {});  // what is wrong with the values is said all the same
    return;
  }
  const NumberRule rule = coordinate->is_rotation() ? angle_rule(context) : length_rule(context);
  const auto span = read_span(context, item, rule);
  for (const StepDef::Prescribed& other : step.prescribe) {
    if (!(other.coordinate == *coordinate)) continue;
    context.error(item.node->key_where, Code::duplicate, item.path, {}, "is prescribed twice in this step");
    return;
  }
  const auto [from, to] = span.value_or(std::pair(0.0, 0.0));
  step.prescribe.push_back({.coordinate = *coordinate, .from = from, .to = to});
}

/// The factors of all coordinates of all joints in a quantity, as a row.
VecX factors_of(const Scene& scene, const QuantityRef& quantity) {
  VecX row = VecX::Zero(static_cast<Eigen::Index>(6 * scene.joints.size()));
  const auto add = [&](const CoordinateRef& c, double factor) { row[6 * c.joint + c.index] += factor; };
  if (quantity.combination < 0)
    add(quantity.first, 1);
  else
    for (const auto& term : scene.combinations[static_cast<std::size_t>(quantity.combination)].terms)
      add(term.coordinate, term.factor);
  return row.normalized();
}

void read_prescribe(ReadContext& context, const Item& item, StepDef& step) {
  if (!is_table(context, item)) return;
  for (const NamedItem& entry : coordinate_items(item)) read_prescribed(context, entry.item, entry.name, step);
  std::vector<QuantityRef> quantities;
  for (const StepDef::Prescribed& p : step.prescribe) quantities.push_back(p.coordinate);
  check_independent(context, coordinate_items(item), quantities);
}

void read_factors(ReadContext& context, const Item& item, StepDef& step) {
  if (!is_table(context, item)) return;
  const std::vector<std::string> names = names_of(context.scene.loads);
  for (const TomlNode& child : item.node->children) {
    const Item entry = item.member(child);
    const auto found = std::find(names.begin(), names.end(), child.key);
    const bool disabled = is_disabled(context.scene, "load", child.key);
    if (found == names.end() && !disabled) {
      context.error(child.key_where, Code::unknown_name, entry.path, literal(child),
                    unknown_name_rule("load", child.key, names));
    }
    const auto [from, to] = read_span(context, entry, {}).value_or(std::pair(1.0, 1.0));
    if (!disabled) step.factors.push_back({.load = static_cast<int>(found - names.begin()), .from = from, .to = to});
  }
}

/// Dortmans: with B moving bodies, M prescribed coordinates and N rigid contacts must leave a freedom, M + N < 6 B;
/// what joints hold counts as prescribed.
void check_count(ReadContext& context, const Section& section, const StepDef& step) {
  int moving = 0;
  for (const BodyDef& body : context.scene.bodies) moving += body.fixed ? 0 : 1;
  const int prescribed = static_cast<int>(step.prescribe.size());
  int held = 0;
  for (const JointDef& joint : context.scene.joints)
    for (int i = 0; i < 6; ++i) held += joint.leaves(i) ? 0 : 1;
  const int most = 6 * moving - 1, constraints = held + prescribed;
  if (moving == 0 || constraints + context.rigid_pairs <= most) return;
  const std::string by_joints = held > 0 ? fmt::format("{} coordinates that joints hold, ", held) : std::string();
  const TomlNode* at = section.item().node->member("prescribe");
  context.error(at ? at->key_where : step.where, Code::conflict, section.path("prescribe"), {},
                fmt::format("too many constraints: {}prescribed coordinates and rigid contact pairs "
                            "M + N = {} + {} = {}, at most {}",
                            by_joints, constraints, context.rigid_pairs, constraints + context.rigid_pairs, most));
}

bool varies(const StepDef& step) {
  const auto changes = [](const auto& x) { return x.from != x.to; };
  return std::any_of(step.prescribe.begin(), step.prescribe.end(), changes) ||
         std::any_of(step.factors.begin(), step.factors.end(), changes);
}

void read_step(ReadContext& context, const Item& item) {
  if (!is_table(context, item)) return;
  Section section(context, item, "a step");
  StepDef step;
  step.where = item.node->where;
  read_prescribe(context, section.find("prescribe"), step);
  read_factors(context, section.find("load"), step);
  read_drive(context, section.find("drive"), step);
  const auto increments = read_integer(context, section.find("increments"), 1, kMaxIncrements);
  step.increments = static_cast<int>(increments.value_or(1));
  const NumberRule seconds = positive({.unit = 1, .unit_name = "s", .above = {}, .at_least = {}});
  step.duration = read_number(context, section.find("duration"), seconds).value_or(1);
  const auto control = read_choice(context, section.find("control"), {"values", "arc_length"});
  step.arc_length = control.value_or(0) == 1;
  if (step.arc_length && !varies(step))
    context.error(section.item().node->member("control")->key_where, Code::no_effect, section.path("control"), {},
                  "nothing changes over this step: let a prescribed coordinate or a load go from one value to another");
  const auto driven = [](const StepDef::Prescribed& p) { return !p.drivers.empty(); };
  if (step.arc_length && std::any_of(step.prescribe.begin(), step.prescribe.end(), driven))
    context.error(
        section.item().node->member("drive")->key_where, Code::conflict, section.path("drive"), {},
        "the factor of a load that drives is an unknown of every pose, so control = \"values\" passes its limits");
  section.finish();
  check_count(context, section, step);
  context.scene.steps.push_back(step);
}

}  // namespace

void check_independent(ReadContext& context, const std::vector<NamedItem>& entries,
                       const std::vector<QuantityRef>& quantities) {
  std::vector<VecX> basis;
  for (const QuantityRef& quantity : quantities) {
    VecX row = factors_of(context.scene, quantity);
    for (int pass = 0; pass < 2; ++pass)
      for (const VecX& known : basis) row -= known.dot(row) * known;
    if (row.norm() > kDependentRowNorm) {
      basis.push_back(row.normalized());
      continue;
    }
    const std::string name = quantity_name(context.scene, quantity);
    for (const NamedItem& entry : entries)
      if (entry.name == name)
        context.error(entry.item.node->key_where, Code::conflict, entry.item.path, {},
                      "follows from what is prescribed before it: leave one of them out");
  }
}

std::vector<NamedItem> coordinate_items(const Item& table) {
  std::vector<NamedItem> items;
  for (const TomlNode& child : table.node->children) {
    const Item entry = table.member(child);
    if (child.kind != TomlNode::Kind::table) {
      items.push_back({child.key, entry});
      continue;
    }
    for (const TomlNode& inner : child.children) items.push_back({child.key + "." + inner.key, entry.member(inner)});
  }
  return items;
}

std::vector<NamedItem> course_items(const ReadContext& context, const Item& table) {
  std::vector<NamedItem> items;
  const std::vector<std::string> combinations = names_of(context.scene.combinations);
  for (const TomlNode& child : table.node->children) {
    const Item entry = table.member(child);
    const bool whole = child.kind != TomlNode::Kind::table || child.key.find('.') != std::string::npos ||
                       std::find(combinations.begin(), combinations.end(), child.key) != combinations.end();
    if (whole) {
      items.push_back({child.key, entry});
      continue;
    }
    for (const TomlNode& inner : child.children) items.push_back({child.key + "." + inner.key, entry.member(inner)});
  }
  return items;
}

void read_steps(ReadContext& context, Section& root) {
  const Item all = root.find("step");
  if (!all) {
    if (!context.in_motion)
      root.error(Code::missing_key, "step", "is missing: a scene needs at least one [[step]], or [dynamics]");
    return;
  }
  if (context.in_motion) {
    context.error(all.node->key_where, Code::conflict, all.path, {},
                  "a scene with [dynamics] has no steps: loads change over time by their `scale`, coordinates by "
                  "`prescribe` in [dynamics]");
    return;
  }
  const bool tables = all.node->kind == TomlNode::Kind::array && !all.node->children.empty();
  if (!tables) {
    refuse(context, all, Code::wrong_form, "steps are written [[step]], in double brackets");
    return;
  }
  for (std::size_t k = 0; k < all.node->children.size(); ++k) read_step(context, all.element(k));
}

}  // namespace genu
