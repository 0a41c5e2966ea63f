#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/osim/scene_draft.h"

namespace genu::osim {
namespace {

/// Six numbers as a scene has them: xx yy zz xy xz yz.
std::string inertia_text(const Mat3& m) {
  std::string text;
  for (const double x : {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)})
    text += (text.empty() ? "[" : ", ") + number_text(x);
  return text + "]";
}

/// Names of the bodies that are part of a rigid one.
std::string parts_of(const SceneDraft& draft, const RigidBody& rigid) {
  std::string names;
  for (const int b : rigid.bodies) names += (names.empty() ? "" : ", ") + draft.skeleton.body_name(b);
  return names;
}

void write_body(SceneDraft& draft, int index) {
  const RigidBody& rigid = draft.skeleton.bodies()[at(index)];
  const std::string name = draft.body_name(index);
  for (const int b : rigid.bodies) {
    if (at(b) == draft.model.bodies.size()) continue;
    const SourceLocation& where = draft.model.bodies[at(b)].where;
    if (b == rigid.named_after)
      draft.outcomes.kept(where, "body." + name, rigid.fixed ? "the body that stands still" : "");
    else
      draft.outcomes.frozen(where, "body." + name, "fixed in another body at the pose of the import");
  }
  if (rigid.bodies.size() > 1) draft.text += fmt::format("# One rigid body of: {}\n", one_line(parts_of(draft, rigid)));
  draft.text += fmt::format("[body.{}]\n", name);
  if (rigid.fixed) draft.text += "fixed = true\n";
  if (!rigid.fixed && rigid.mass > 0 && draft.model.gravity.norm() > 0) {
    draft.text += fmt::format("mass = {}\n", number_text(rigid.mass));
    draft.text += fmt::format("centre_of_mass = {}\n", point_text(rigid.centre));
    draft.text += fmt::format("# with [dynamics]: inertia = {}\n", inertia_text(rigid.inertia));
  }
  draft.text += "\n";
}

const char* kAxes[] = {"x", "y", "z"};

void write_free(SceneDraft& draft, const MovingJoint& moving, const Joint& joint) {
  const auto local = [&](const std::string& c) { return draft.short_name(joint, c); };
  std::string rotations, reference;
  for (const MovingJoint::Rotation& r : moving.rotations) {
    rotations += fmt::format("{}\"{} {}{}\"", rotations.empty() ? "" : ", ", local(r.coordinate), r.negative ? "-" : "",
                             kAxes[r.axis]);
    if (const double angle = draft.skeleton.value(r.coordinate); angle != 0)
      reference += fmt::format("{}{} = {}", reference.empty() ? "" : ", ", local(r.coordinate),
                               number_text(angle * to::kDegree));
  }
  for (const std::string& c : moving.translations)
    if (const double shift = draft.skeleton.value(c); shift != 0)
      reference +=
          fmt::format("{}{} = {}", reference.empty() ? "" : ", ", local(c), number_text(shift * to::kMillimetre));
  draft.text +=
      fmt::format("rotations = [{}]\ntranslations = [\"{}\", \"{}\", \"{}\"]\n", rotations,
                  local(moving.translations[0]), local(moving.translations[1]), local(moving.translations[2]));
  if (!reference.empty()) draft.text += fmt::format("reference = {{ {} }}\n", reference);
}

void write_revolute(SceneDraft& draft, const MovingJoint& moving) {
  draft.text += fmt::format("origin = {}\naxis = {}\n", point_text(moving.origin), vector_text(moving.axis));
  if (const double angle = draft.skeleton.value(moving.angle); angle != 0)
    draft.text += fmt::format("reference = {{ angle = {} }}\n", number_text(angle * to::kDegree));
}

/// "1 m", "0.2 rad"
std::string value_text(const SceneDraft& draft, const Coordinate& c) {
  return fmt::format("{:.6g} {}", draft.skeleton.value(c.name), is_angle(draft.model, c.name) ? "rad" : "m");
}

void tell_frozen(SceneDraft& draft, const Joint& joint) {
  constexpr const char* kHeld = "held at the pose of the import";
  std::string pose;
  for (const Coordinate& c : joint.coordinates) {
    pose += (pose.empty() ? "" : "; ") + c.name + " = " + value_text(draft, c);
    draft.outcomes.frozen(c.where, {}, kHeld, value_text(draft, c));
  }
  draft.outcomes.frozen(joint.where, {}, joint.coordinates.empty() ? "has no coordinate" : kHeld, pose);
}

}  // namespace

std::string SceneDraft::body_name(int rigid) {
  return bodies.of(skeleton.body_name(skeleton.bodies()[at(rigid)].named_after));
}

std::string SceneDraft::short_name(const Joint& joint, const std::string& coordinate) {
  return coordinates[joint.name].of(short_coordinate(coordinate, joint.name));
}

std::string SceneDraft::coordinate_name(const std::string& coordinate) {
  for (const MovingJoint& moving : skeleton.joints()) {
    const Joint& joint = model.joints[at(moving.joint)];
    if (joint.coordinate(coordinate) == nullptr) continue;
    const bool angle = moving.kind == MovingJoint::Kind::revolute;
    return joints.of(joint.name) + "." + (angle ? "angle" : short_name(joint, coordinate));
  }
  return {};
}

std::string source_comment(const std::string& type, const std::string& name, const SourceLocation& where) {
  return fmt::format("# {} {}, line {}", one_line(type), one_line(name), where.line);
}

void write_bodies(SceneDraft& draft) {
  draft.text += "# --- Bodies: one for all that the imported joints do not move in each other ---\n";
  for (int i = 0; at(i) < draft.skeleton.bodies().size(); ++i) write_body(draft, i);
  for (const OffsetFrame& f : draft.model.frames)
    draft.outcomes.frozen(f.where,
                          "body." + draft.body_name(draft.skeleton.rigid_body(draft.skeleton.frame(f.path).body)),
                          "a fixed place in a body: points are given in the body itself");
}

void write_joints(SceneDraft& draft) {
  draft.text +=
      "# --- Joints: signs, order and meaning of the coordinates are those of the model; angles in deg, lengths in mm "
      "---\n";
  for (const MovingJoint& moving : draft.skeleton.joints()) {
    const Joint& joint = draft.model.joints[at(moving.joint)];
    const std::string name = draft.joints.of(joint.name);
    const bool free = moving.kind == MovingJoint::Kind::free;
    draft.text += fmt::format("{}\n[joint.{}]\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n",
                              source_comment(joint.type, joint.name, joint.where), name, free ? "free" : "revolute",
                              draft.body_name(moving.parent), draft.body_name(moving.child));
    free ? write_free(draft, moving, joint) : write_revolute(draft, moving);
    draft.text += "\n";
    draft.outcomes.kept(joint.where, "joint." + name);
    for (const Coordinate& c : joint.coordinates)
      draft.outcomes.kept(c.where, draft.coordinate_name(c.name), "",
                          c.locked ? "locked in the model: prescribed in the step" : "");
  }
  for (const Joint& joint : draft.model.joints)
    if (!draft.skeleton.moves_joint(joint.name)) tell_frozen(draft, joint);
  for (const Coupler& c : draft.model.couplers)
    if (!draft.skeleton.moves(c.dependent))
      draft.outcomes.frozen(c.where, {}, "both coordinates are held at the pose of the import");
}

void write_step(SceneDraft& draft) {
  const auto mass_of = [&](const MovingJoint& m) { return draft.skeleton.bodies()[at(m.child)].mass; };
  const MovingJoint* lead = &draft.skeleton.joints().front();  // the shank before the patella
  for (const MovingJoint& moving : draft.skeleton.joints())
    if (mass_of(moving) > mass_of(*lead)) lead = &moving;
  const std::string leading = lead->kind == MovingJoint::Kind::free ? lead->rotations[0].coordinate : lead->angle;
  std::string prescribed;
  for (const MovingJoint& moving : draft.skeleton.joints())
    for (const Coordinate& c : draft.model.joints[at(moving.joint)].coordinates) {
      if (c.name != leading && !c.locked) continue;
      const double unit = is_angle(draft.model, c.name) ? to::kDegree : to::kMillimetre;
      prescribed += fmt::format("{}\"{}\" = {}", prescribed.empty() ? "" : ", ", draft.coordinate_name(c.name),
                                number_text(draft.skeleton.value(c.name) * unit));
    }
  draft.text += fmt::format(
      "# --- Steps. CHOSEN: a model does not say what to compute. The first rotation (and what is locked) keeps the "
      "pose of\n"
      "# the import; all else finds its balance. `genu evaluate` takes poses from a file instead ---\n"
      "[[step]]\nprescribe = {{ {} }}\nincrements = 1\n",
      prescribed);
}

}  // namespace genu::osim
