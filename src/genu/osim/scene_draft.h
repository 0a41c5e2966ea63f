// A scene under construction from a model: what its writers share.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "genu/osim/outcomes.h"
#include "genu/osim/scene_words.h"
#include "genu/osim/skeleton.h"

namespace genu::osim {

/// What a user gives beside the model.
struct SceneRequest {
  std::map<std::string, double> tensions;     ///< N, of muscles by name; negative ones pull with 0
  std::map<std::string, std::string> meshes;  ///< mesh files of the model, as the scene names them
};

struct SceneDraft {
  const Model& model;
  const Skeleton& skeleton;
  const SceneRequest& request;
  Outcomes outcomes = {};
  SceneNames bodies = {}, joints = {}, surfaces = {}, contacts = {}, ligaments = {}, loads = {};
  std::map<std::string, SceneNames> coordinates = {};  ///< of each joint
  std::string text = {};

  std::string body_name(int rigid);
  std::string joint_name(const Joint& joint) { return joints.of(joint.where, joint.name); }
  /// "flex"
  std::string short_name(const Joint& joint, const std::string& coordinate);
  /// "knee_r.flex"
  std::string coordinate_name(const std::string& coordinate);
};

/// "# Blankevoort1991Ligament MCLd1, line 10444"
std::string source_comment(const std::string& type, const std::string& name, const SourceLocation& where);

// Each writes its sections, and what became of its elements.
void write_bodies(SceneDraft& draft);
void write_joints(SceneDraft& draft);
void write_contacts(SceneDraft& draft);
/// Ligaments, muscles, springs of coordinates, and the surfaces that paths wrap round.
void write_paths(SceneDraft& draft);
void write_springs(SceneDraft& draft);
void write_step(SceneDraft& draft);

/// The contact meshes and their bones that contacts between different rigid bodies need: each with its place in the
/// file.
struct NeededMesh {
  std::string file;
  SourceLocation where;
  bool scaled = false;  ///< the model stretches it, which a scene cannot
};
std::vector<NeededMesh> needed_meshes(const Model& model, const Skeleton& skeleton);

}  // namespace genu::osim
