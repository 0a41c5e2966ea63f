#include <algorithm>
#include <cmath>
#include <set>

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

std::string leading_coordinate(const SceneDraft& draft) {
  const auto mass_of = [&](const MovingJoint& m) { return draft.skeleton.bodies()[at(m.child)].mass; };
  const MovingJoint* lead = &draft.skeleton.joints().front();  // the shank before the patella
  for (const MovingJoint& moving : draft.skeleton.joints())
    if (mass_of(moving) > mass_of(*lead)) lead = &moving;
  return lead->kind == MovingJoint::Kind::free ? lead->rotations[0].coordinate : lead->angle;
}

/// What the step prescribes: all that is locked or prescribed in the model, and the leading rotation, as long as
/// something is left to find its balance.
std::set<std::string> held_coordinates(const SceneDraft& draft) {
  std::vector<std::string> held;
  std::size_t all = 0;
  const std::string leading = leading_coordinate(draft);
  for (const MovingJoint& moving : draft.skeleton.joints())
    for (const Coordinate& c : draft.model.joints[at(moving.joint)].coordinates) {
      if (!moving.has(c.name)) continue;
      ++all;
      if (c.locked || c.prescribed) held.push_back(c.name);
    }
  if (std::find(held.begin(), held.end(), leading) == held.end()) held.push_back(leading);
  held.resize(std::min(held.size(), all - 1));
  return {held.begin(), held.end()};
}

const char* remark_on(const Coordinate& c, bool held) {
  if (!c.locked && !c.prescribed) return "";
  if (!held) return "WARNING: fixed in the model, free here: something must find its balance";
  return c.locked
             ? "locked in the model: prescribed in the step"
             : "prescribed by a function of time in the model: prescribed in the step, as at the pose of the import";
}

/// What the pose of the import means for a coupler of coordinates.
void tell_coupler(SceneDraft& draft, const Coupler& c) {
  if (!c.enforced) return draft.outcomes.left_out(c.where, "is not enforced in the model");
  if (draft.skeleton.moves(c.dependent)) return;
  if (draft.skeleton.follows_what_moves(c.dependent))
    draft.outcomes.frozen(c.where, {},
                          "WARNING: in the model its dependent coordinate follows one that moves; here it is held at "
                          "the pose of the import",
                          c.dependent);
  else
    draft.outcomes.frozen(c.where, {}, "both coordinates are held at the pose of the import");
}

}  // namespace

std::string SceneDraft::body_name(int rigid) {
  const int body = skeleton.bodies()[at(rigid)].named_after;
  return bodies.of(at(body) < model.bodies.size() ? model.bodies[at(body)].where : SourceLocation(),
                   skeleton.body_name(body));
}

std::string SceneDraft::short_name(const Joint& joint, const std::string& coordinate) {
  const std::string shortened = short_coordinate(coordinate, joint.name);
  const auto same = [&](const Coordinate& c) { return short_coordinate(c.name, joint.name) == shortened; };
  const bool alone = std::count_if(joint.coordinates.begin(), joint.coordinates.end(), same) == 1;
  return coordinates[joint.name].of(joint.coordinate(coordinate)->where, alone ? shortened : coordinate);
}

std::string SceneDraft::coordinate_name(const std::string& coordinate) {
  for (const MovingJoint& moving : skeleton.joints()) {
    const Joint& joint = model.joints[at(moving.joint)];
    if (!moving.has(coordinate)) continue;
    const bool angle = moving.kind == MovingJoint::Kind::revolute;
    return joint_name(joint) + "." + (angle ? "angle" : short_name(joint, coordinate));
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
  const std::set<std::string> held = held_coordinates(draft);
  draft.text +=
      "# --- Joints: signs, order and meaning of the coordinates are those of the model; angles in deg, lengths in mm "
      "---\n";
  for (const MovingJoint& moving : draft.skeleton.joints()) {
    const Joint& joint = draft.model.joints[at(moving.joint)];
    const std::string name = draft.joint_name(joint);
    const bool free = moving.kind == MovingJoint::Kind::free;
    draft.text += fmt::format("{}\n[joint.{}]\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n",
                              source_comment(joint.type, joint.name, joint.where), name, free ? "free" : "revolute",
                              draft.body_name(moving.parent), draft.body_name(moving.child));
    free ? write_free(draft, moving, joint) : write_revolute(draft, moving);
    draft.text += "\n";
    draft.outcomes.kept(joint.where, "joint." + name);
    for (const Coordinate& c : joint.coordinates) {
      if (!moving.has(c.name)) {
        draft.outcomes.left_out(c.where, "moves nothing");
        continue;
      }
      draft.outcomes.kept(c.where, draft.coordinate_name(c.name), "", remark_on(c, held.count(c.name) > 0));
    }
  }
  for (const Joint& joint : draft.model.joints)
    if (!draft.skeleton.moves_joint(joint.name)) tell_frozen(draft, joint);
  for (const Coupler& c : draft.model.couplers) tell_coupler(draft, c);
}

void write_step(SceneDraft& draft) {
  const std::set<std::string> held = held_coordinates(draft);
  std::string prescribed;
  for (const MovingJoint& moving : draft.skeleton.joints())
    for (const Coordinate& c : draft.model.joints[at(moving.joint)].coordinates) {
      if (held.count(c.name) == 0) continue;
      const double unit = is_angle(draft.model, c.name) ? to::kDegree : to::kMillimetre;
      prescribed += fmt::format("{}\"{}\" = {}", prescribed.empty() ? "" : ", ", draft.coordinate_name(c.name),
                                number_text(draft.skeleton.value(c.name) * unit));
    }
  draft.text += fmt::format(
      "# --- Steps. CHOSEN: a model does not say what to compute. {}\n"
      "# `genu evaluate` takes poses from a file instead ---\n"
      "[[step]]\n{}increments = 1\n",
      prescribed.empty() ? "The only coordinate finds its balance."
                         : "What is prescribed keeps the pose of the import; all else finds its balance.",
      prescribed.empty() ? "" : "prescribe = { " + prescribed + " }\n");
}

}  // namespace genu::osim
