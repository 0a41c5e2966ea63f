#include <string_view>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

using Bone = GroodSuntayDef::Bone;

/// One of the words x, -x, ..., or a vector of any length but 0.
std::optional<Vec3> read_direction(ReadContext& context, const Item& item) {
  if (!item) return {};
  if (item.node->kind == TomlNode::Kind::string) {
    const auto axis = read_choice(context, item, {"x", "y", "z", "-x", "-y", "-z"});
    if (!axis) return {};
    return Vec3((*axis < 3 ? 1 : -1) * Vec3::Unit(*axis % 3));
  }
  const auto v = read_vector(context, item);
  if (v && v->norm() > 0) return v->normalized();
  if (v) refuse(context, item, Code::out_of_range, "must have a direction: not all three numbers may be 0");
  return {};
}

bool read_bone_axes(ReadContext& context, const Item& item, const JointDef& joint, Bone& bone) {
  if (!is_table(context, item)) return false;
  Section section(context, item, "a bone");
  const Item body = section.require("body");
  bone.body = read_reference(context, body, "body", names_of(context.scene.bodies)).value_or(-1);
  const Item front = section.require("anterior");
  const auto proximal = read_direction(context, section.require("proximal"));
  const auto anterior = read_direction(context, front);
  bone.origin = read_vector(context, section.find("origin"), length_rule(context)).value_or(Vec3::Zero());
  section.finish();
  if (bone.body >= 0 && bone.body != joint.parent && bone.body != joint.child) {
    refuse(context, body, Code::unknown_name, "must be the parent or the child of joint." + joint.name);
    bone.body = -1;
  }
  if (!proximal || !anterior || bone.body < 0) return false;
  const Vec3 across = *anterior - anterior->dot(*proximal) * *proximal;
  if (across.norm() < kParallelSine) {
    refuse(context, front, Code::conflict, "is parallel to proximal");
    return false;
  }
  bone.proximal = *proximal;
  bone.anterior = across.normalized();
  return true;
}

}  // namespace

void read_grood_suntay(ReadContext& context, const Item& item, JointDef& joint) {
  if (!is_table(context, item)) return;
  Section section(context, item, "a Grood-Suntay description");
  GroodSuntayDef def;
  const auto side = read_choice(context, section.require("side"), {"right", "left"});
  def.right = side.value_or(0) == 0;
  def.patella = section.has("patella");
  const Item tibia = def.patella ? section.find("patella") : section.require("tibia");
  const bool femur_good = read_bone_axes(context, section.require("femur"), joint, def.femur);
  const bool tibia_good = read_bone_axes(context, tibia, joint, def.tibia);
  section.finish();
  if (!side || !femur_good || !tibia_good) return;
  if (def.femur.body == def.tibia.body) {
    refuse(context, tibia, Code::conflict, "has the same body as the femur");
    return;
  }
  joint.grood_suntay = def;
}

}  // namespace genu
