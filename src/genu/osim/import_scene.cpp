#include "genu/osim/import_scene.h"

#include <fmt/format.h>

#include "genu/scene/surface_writer.h"

namespace genu::osim {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Columns that `genu evaluate` would not find: coordinates whose names do not begin as their joint does, or that have
/// another name in the scene.
std::string columns_of(SceneDraft& draft) {
  std::vector<std::string> columns;
  for (const MovingJoint& moving : draft.skeleton.joints()) {
    const Joint& joint = draft.model.joints[at(moving.joint)];
    for (const Coordinate& c : joint.coordinates) {
      const std::string known = short_coordinate(c.name, joint.name);
      const bool revolute = moving.kind == MovingJoint::Kind::revolute;
      if (moving.has(c.name) && (revolute || known == c.name || draft.short_name(joint, c.name) != known))
        columns.push_back(draft.coordinate_name(c.name) + "=" + c.name);
    }
  }
  return joined(columns);
}

std::string gravity_text(const SceneDraft& draft) {
  const Vec3 gravity = draft.skeleton.rigid_in_ground(0).R.transpose() * draft.model.gravity;
  bool weight = false;
  for (const RigidBody& b : draft.skeleton.bodies()) weight |= !b.fixed && b.mass > 0;
  if (!weight || gravity.norm() == 0) return {};
  return fmt::format("gravity = {}   # m/s^2, in the frame of the fixed body at the pose of the import\n",
                     vector_text(gravity));
}

std::string header(const SceneDraft& draft, const ImportedScene& scene) {
  return fmt::format(
      "# {0}: {1} of {2}. Written by `genu import`; every line is yours to change.\n"
      "#   genu evaluate scene.toml --poses states.sto{3} --out out/poses\n"
      "#   genu run scene.toml --out out/run\n"
      "# Lengths are mm (the model has m), angles deg (rad). Names are those of the model; comments name the element "
      "and its\n"
      "# line. import.csv says of every element of the model what became of it.\n"
      "format = 1\ntitle = {4}\nunits = {{ length = \"mm\", angle = \"deg\" }}\n{5}\n",
      one_line(draft.model.name), one_line(joined(scene.joints)), one_line(draft.model.file),
      scene.columns.empty() ? "" : " --columns \"" + one_line(scene.columns) + "\"",
      toml_string(draft.model.name + ": " + joined(scene.joints)), gravity_text(draft));
}

void count(const Model& model, const Outcomes& outcomes, ImportedScene& scene) {
  for (const Item& item : model.items) {
    const Fate fate = outcomes.of(item.where).fate;
    ++(fate == Fate::kept ? scene.kept : fate == Fate::frozen ? scene.frozen : scene.left_out);
  }
}

}  // namespace

ImportedScene import_scene(const Model& model, const Skeleton& skeleton, const SceneRequest& request) {
  SceneDraft draft{model, skeleton, request};
  ImportedScene scene;
  for (int i = 0; at(i) < skeleton.bodies().size(); ++i) scene.bodies.push_back(draft.body_name(i));
  write_bodies(draft);
  write_joints(draft);
  for (const MovingJoint& moving : skeleton.joints())
    scene.joints.push_back(draft.joint_name(model.joints[at(moving.joint)]));
  write_contacts(draft);
  write_paths(draft);
  write_springs(draft);
  write_step(draft);
  settle_the_rest(model.items, draft.outcomes);
  scene.columns = columns_of(draft);
  scene.text = header(draft, scene) + draft.text;
  scene.table = outcome_table(model.items, draft.outcomes);
  scene.summary = outcome_summary(model.items, draft.outcomes);
  count(model, draft.outcomes, scene);
  return scene;
}

}  // namespace genu::osim
