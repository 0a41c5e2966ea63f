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
  joint.limits = JointDef::Limits{};
  read_numbers(context, section, kind_of(joint), joint, {.objects = "joints", .table = "limits"});
  if (!section.has("from") && !section.has("to"))
    section.error(Code::missing_key, "", "says nothing: give `from`, `to` or both");
  section.finish();
}

}  // namespace

bool read_held_joint(ReadContext& context, Section& section, JointDef& joint) {
  const bool revolute = joint.type == JointDef::Type::revolute;
  section.rename(kind_of(joint).what);
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
    refuse(context, item, Code::out_of_range, "must have a direction: not all three numbers may be 0");
  read_numbers(context, section, kind_of(joint), joint, {.objects = "joints"});
  read_limits(context, section.find("limits"), joint);
  read_angle(context, section.find("reference"), "reference", joint.reference[0]);
  if (const Item start = section.find("start"))
    read_angle(context, start, "start", joint.start.emplace(joint.reference)[0]);
  return true;
}

}  // namespace genu
