#include "genu/osim/model_draft.h"

namespace genu::osim {
namespace {

std::string offset_name(const SceneTables& scene, const JointDef& joint) {
  return scene.bodies[at(joint.parent)].name + "_offset";
}

void write_coordinate(const std::string& name, double value, XmlWriter& out) {
  out.open("Coordinate", name);
  out.number("default_value", value);
  out.close("Coordinate");
}

/// slope * coordinate about or along an axis; without a coordinate the constant.
void write_axis(const char* place, const std::string& coordinate, const Vec3& axis, double number, XmlWriter& out) {
  out.open("TransformAxis", place);
  if (!coordinate.empty()) out.text("coordinates", coordinate);
  out.vector("axis", axis);
  if (coordinate.empty()) {
    out.open("Constant", "function");
    out.number("value", number);
    out.close("Constant");
  } else {
    out.open("LinearFunction", "function");
    out.text("coefficients", fmt::format("{} 0", number));
    out.close("LinearFunction");
  }
  out.close("TransformAxis");
}

constexpr const char* kTurns[] = {"rotation1", "rotation2", "rotation3"};
constexpr const char* kShifts[] = {"translation1", "translation2", "translation3"};

/// A rotation about -z is one about z by minus the coordinate, as published models have it.
void write_free(const ModelDraft& draft, int j, XmlWriter& out) {
  const JointDef& joint = draft.scene.joints[at(j)];
  for (int i = 0; i < 3; ++i) {
    const Vec3& axis = joint.rotations[at(i)].axis;
    const double sign = axis.sum() < 0 ? -1 : 1;
    write_axis(kTurns[i], draft.coordinate({j, i}), sign * axis, sign, out);
  }
  for (int i = 0; i < 3; ++i) write_axis(kShifts[i], draft.coordinate({j, 3 + i}), Vec3::Unit(i), 1, out);
}

void write_revolute(const ModelDraft& draft, int j, XmlWriter& out) {
  const JointDef& joint = draft.scene.joints[at(j)];
  for (int i = 0; i < 3; ++i)
    write_axis(kTurns[i], i == 0 ? draft.coordinate({j, 0}) : std::string(), joint.rotations[at(i)].axis,
               i == 0 ? 1 : 0, out);
  for (int i = 0; i < 3; ++i) write_axis(kShifts[i], {}, Vec3::Unit(i), joint.reference[at(3 + i)], out);
}

void write_moving(const ModelDraft& draft, int j, XmlWriter& out) {
  const JointDef& joint = draft.scene.joints[at(j)];
  const auto& values = joint.start ? *joint.start : joint.reference;
  out.open("CustomJoint", joint.name);
  out.text("socket_parent_frame", draft.body_path(joint.parent));
  out.text("socket_child_frame", draft.body_path(joint.child));
  out.open("coordinates");
  for (int i = 0; i < 6; ++i)
    if (joint.leaves(i)) write_coordinate(draft.coordinate({j, i}), values[at(i)], out);
  out.close("coordinates");
  out.open("SpatialTransform");
  joint.type == JointDef::Type::free ? write_free(draft, j, out) : write_revolute(draft, j, out);
  out.close("SpatialTransform");
  out.close("CustomJoint");
}

/// Held where the reference has it.
void write_weld(const ModelDraft& draft, const JointDef& joint, XmlWriter& out) {
  const auto& r = joint.reference;
  out.open("WeldJoint", joint.name);
  out.text("socket_parent_frame", offset_name(draft.scene, joint));
  out.text("socket_child_frame", draft.body_path(joint.child));
  out.open("frames");
  out.open("PhysicalOffsetFrame", offset_name(draft.scene, joint));
  out.text("socket_parent", draft.body_path(joint.parent));
  out.vector("translation", {r[3], r[4], r[5]});
  out.vector("orientation", Vec3::Zero());
  out.close("PhysicalOffsetFrame");
  out.close("frames");
  out.close("WeldJoint");
}

std::string remark_on(const JointDef& joint) {
  std::string remark;
  if (joint.limits) remark = "WARNING: its limits are left out";
  if (joint.damping != 0) remark += std::string(remark.empty() ? "" : "; ") + "its damping acts in motion only";
  return remark;
}

}  // namespace

void write_joint_set(ModelDraft& draft, XmlWriter& out) {
  for (int b = 0; at(b) < draft.scene.bodies.size(); ++b) {
    if (!draft.scene.bodies[at(b)].fixed) continue;
    out.open("WeldJoint", "ground_" + draft.body(b));
    out.text("socket_parent_frame", "/ground");
    out.text("socket_child_frame", draft.body_path(b));
    out.close("WeldJoint");
  }
  for (int j = 0; at(j) < draft.scene.joints.size(); ++j) {
    const JointDef& joint = draft.scene.joints[at(j)];
    if (joint.type == JointDef::Type::fixed)
      write_weld(draft, joint, out);
    else
      write_moving(draft, j, out);
    draft.kept("joint", joint.name, "/jointset/" + joint.name, remark_on(joint));
  }
}

}  // namespace genu::osim
