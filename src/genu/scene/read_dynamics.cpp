// [dynamics]: motion over time, and what it asks of bodies, joints and ligaments.
#include <cmath>

#include <fmt/format.h>

#include "genu/scene/read_parts.h"

#include "genu/core/decompositions.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

/// [xx, yy, zz] or [xx, yy, zz, xy, xz, yz].
std::optional<Mat3> read_matrix(ReadContext& context, const Item& item) {
  const bool all = item && item.node->kind == TomlNode::Kind::array && item.node->children.size() == 6;
  if (!is_array(context, item, "[xx, yy, zz] or [xx, yy, zz, xy, xz, yz] in kg m^2", all ? 6 : 3)) return {};
  double entry[6] = {};
  bool good = true;
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const auto value =
        read_number(context, item.element(k), k < 3 ? non_negative(plain_rule("kg m^2")) : plain_rule("kg m^2"));
    good = good && value;
    entry[k] = value.value_or(0);
  }
  if (!good) return {};
  Mat3 I;
  I << entry[0], entry[3], entry[4], entry[3], entry[1], entry[5], entry[4], entry[5], entry[2];
  return I;
}

/// What a matrix of inertia breaks that no distribution of mass could break; empty if nothing.
std::string broken_rule(const Mat3& I) {
  const Vec3 principal = symmetric_eigenvalues(I);
  const double rounding = kInertiaRounding * principal[2];
  if (principal[0] < -rounding)
    return fmt::format("no body has it: the principal moments of inertia must be >= 0, here {:.4g}, {:.4g}, {:.4g}",
                       principal[0], principal[1], principal[2]);
  if (principal[2] > principal[0] + principal[1] + rounding)
    return fmt::format(
        "no body has it: each principal moment of inertia is at most the sum of the other two, here {:.4g} > {:.4g} + "
        "{:.4g} kg m^2",
        principal[2], principal[0], principal[1]);
  return {};
}

void read_start_rates(ReadContext& context, const Item& item, DynamicsDef& dynamics) {
  if (!is_table(context, item)) return;
  for (const NamedItem& entry : coordinate_items(item)) {
    const auto c = find_coordinate(context, entry.item.node->key_where, entry.item.path, entry.name);
    const NumberRule rule = !c ? NumberRule{} : c->index < 3 ? any_turns(angle_rule(context)) : length_rule(context);
    const auto value = read_number(context, entry.item, rule);
    if (c && value) dynamics.start_rates.push_back({*c, *value});
  }
}

void read_drive(ReadContext& context, const NamedItem& entry, DynamicsDef& dynamics) {
  const auto quantity = find_quantity(context, entry.item.node->key_where, entry.item.path, entry.name);
  const NumberRule rule = !quantity                 ? NumberRule{}
                          : quantity->is_rotation() ? angle_rule(context)
                                                    : length_rule(context);
  const ScaleDef course = read_course(context, entry.item, rule);
  if (!quantity) return;
  for (const DynamicsDef::Drive& other : dynamics.prescribe)
    if (other.quantity == *quantity)
      return context.error(entry.item.node->key_where, Code::duplicate, entry.item.path, {}, "is prescribed twice");
  for (const DynamicsDef::Rate& rate : dynamics.start_rates)
    if (quantity->combination < 0 && rate.coordinate == quantity->first)
      context.error(entry.item.node->key_where, Code::conflict, entry.item.path, {},
                    "is prescribed and has a rate in start_rates: leave one of them out");
  dynamics.prescribe.push_back({*quantity, course, entry.item.node->key_where});
}

void read_drives(ReadContext& context, const Item& item, DynamicsDef& dynamics) {
  if (!is_table(context, item)) return;
  const std::vector<NamedItem> entries = course_items(context, item);
  for (const NamedItem& entry : entries) read_drive(context, entry, dynamics);
  std::vector<QuantityRef> quantities;
  for (const DynamicsDef::Drive& drive : dynamics.prescribe) quantities.push_back(drive.quantity);
  check_independent(context, entries, quantities);
}

void refuse_locked(ReadContext& context, const Item& item) {
  for (const JointDef& joint : context.scene.joints)
    if (joint.type != JointDef::Type::fixed) return;
  if (context.scene.joints.empty() || !context.bodies_understood) return;
  context.error(item.node->key_where, Code::no_effect, item.path, {}, "nothing can move: every joint is fixed");
}

}  // namespace

void read_inertia(ReadContext& context, Section& section, BodyDef& body) {
  if (read_solid(context, section, body)) return;
  const bool needed = !body.fixed;
  read_mass(context, section, {.none_required = !needed}, body);
  const Item inertia = needed ? section.require("inertia") : section.find("inertia");
  if (const auto matrix = inertia ? read_matrix(context, inertia) : std::nullopt) {
    body.inertia = *matrix;
    if (const std::string rule = broken_rule(*matrix); !rule.empty())
      refuse(context, inertia, Code::out_of_range, rule);
  }
  if (inertia && body.fixed) refuse(context, inertia, Code::no_effect, "is of a fixed body, which nothing moves");
}

void read_dynamics(ReadContext& context, Section& root) {
  const Item item = root.find("dynamics");
  if (!is_table(context, item)) return;
  Section section(context, item, "dynamics");
  DynamicsDef dynamics;
  dynamics.where = item.node->key_where;
  const Item interval = section.require("output_interval"), tolerance = section.find("tolerance");
  const auto duration = read_number(context, section.require("duration"), positive(plain_rule("s")));
  const auto every = read_number(context, interval, positive(plain_rule("s")));
  dynamics.duration = duration.value_or(1);
  dynamics.output_interval = every.value_or(1);
  if (duration && every && *every > *duration)
    refuse(context, interval, Code::out_of_range, "must be at most the duration");
  if (duration && every && *duration / *every > kMaxMotionRows)
    refuse(context, interval, Code::too_large, fmt::format("asks for more than {:g} rows", kMaxMotionRows));
  const auto error = read_number(context, tolerance, positive(plain_rule({})));
  dynamics.tolerance = error.value_or(dynamics.tolerance);
  if (error && (*error < kMinMotionTolerance || *error > kMaxMotionTolerance))
    refuse(context, tolerance, Code::out_of_range,
           fmt::format("must be from {:g} to {:g}", kMinMotionTolerance, kMaxMotionTolerance));
  read_start_rates(context, section.find("start_rates"), dynamics);
  read_drives(context, section.find("prescribe"), dynamics);
  dynamics.from_equilibrium = read_choice(context, section.find("start"), {"given", "equilibrium"}) == 1;
  section.finish();
  refuse_locked(context, item);
  context.scene.dynamics = dynamics;
}

}  // namespace genu
