#include <fmt/format.h>

#include "genu/scene/read_parts.h"

namespace genu {

namespace {

/// The joint's axis first, then two directions perpendicular to it and to each other: a set of coordinates in which
/// the joint holds five and leaves the first.
void set_axes(const Vec3& axis, JointDef& joint) {
  joint.rotations[0].axis = axis.normalized();
  joint.rotations[1].axis = joint.rotations[0].axis.unitOrthogonal();
  joint.rotations[2].axis = joint.rotations[0].axis.cross(joint.rotations[1].axis).normalized();
}

/// N m per the file's unit of angle.
NumberRule angular_stiffness_rule(const ReadContext& context) {
  return {.unit = 1 / context.scene.angle_unit, .unit_name = "N m/" + context.angle_name, .above = {}, .at_least = 0};
}

void read_angle(ReadContext& context, const Item& item, const char* what, double& angle) {
  if (!is_table(context, item)) return;
  Section section(context, item, fmt::format("the {} of a revolute joint", what));
  angle = read_number(context, section.find("angle"), angle_rule(context)).value_or(angle);
  section.finish();
}

/// Angles beyond which a spring pushes back.
void read_limits(ReadContext& context, const Item& item, JointDef& joint) {
  if (!is_table(context, item)) return;
  Section section(context, item, "the limits of a revolute joint");
  JointDef::Limits limits;
  const Item from = section.find("from"), to = section.find("to");
  limits.lower = read_number(context, from, angle_rule(context)).value_or(limits.lower);
  limits.upper = read_number(context, to, angle_rule(context)).value_or(limits.upper);
  limits.stiffness =
      read_number(context, section.require("stiffness"), positive(angular_stiffness_rule(context))).value_or(0);
  if (!from && !to) section.error("", "says nothing: give `from`, `to` or both");
  if (from && to && !(limits.lower < limits.upper)) refuse(context, to, "must be more than `from`");
  section.finish();
  joint.limits = limits;
}

}  // namespace

bool read_held_joint(ReadContext& context, Section& section, JointDef& joint) {
  const bool revolute = joint.type == JointDef::Type::revolute;
  section.rename(revolute ? "a revolute joint" : "a fixed joint");
  set_axes(Vec3::UnitX(), joint);
  if (const auto origin = read_vector(context, section.find("origin"), length_rule(context)))
    for (std::size_t k = 0; k < 3; ++k) joint.reference[3 + k] = (*origin)[static_cast<Eigen::Index>(k)];
  if (!revolute) return true;

  joint.rotations[0].name = "angle";
  const Item item = section.require("axis");
  const auto axis = read_vector(context, item);
  if (axis && axis->norm() > 0)
    set_axes(*axis, joint);
  else if (axis)
    refuse(context, item, "must have a direction: not all three numbers may be 0");
  joint.stiffness = read_number(context, section.find("stiffness"), angular_stiffness_rule(context)).value_or(0);
  read_limits(context, section.find("limits"), joint);
  read_angle(context, section.find("reference"), "reference", joint.reference[0]);
  if (const Item start = section.find("start"))
    read_angle(context, start, "start", joint.start.emplace(joint.reference)[0]);
  joint.damping = read_damping(context, section, "joints", 1 / context.scene.angle_unit, "N m s/" + context.angle_name);
  return true;
}

}  // namespace genu
