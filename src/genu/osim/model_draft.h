// A model under construction from a scene: what its writers share.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "genu/osim/export_request.h"
#include "genu/osim/xml_writer.h"

namespace genu::osim {

/// What became of an object of the scene.
struct ExportOutcome {
  std::string kind, name;  ///< "ligament", "ACL"
  std::string in_model;    ///< "/forceset/ACL"; empty where it is left out
  std::string reason;      ///< why it is left out, or what differs
};

struct ModelDraft {
  const SceneTables& scene;
  const ExportRequest& request;
  std::vector<ExportOutcome> outcomes = {};
  std::map<int, XmlWriter> wrap_objects = {};                     ///< of each body
  std::map<std::pair<int, std::string>, std::string> wraps = {};  ///< names of those: by surface and side
  std::string forces_head = {}, forces_row = {};                  ///< of the .sto

  const std::string& body(int index) const { return scene.bodies[at(index)].name; }
  std::string body_path(int index) const { return "/bodyset/" + body(index); }
  void kept(const char* kind, const std::string& name, const std::string& in_model, const std::string& reason = {}) {
    outcomes.push_back({kind, name, in_model, reason});
  }
  void left_out(const char* kind, const std::string& name, const std::string& reason) {
    outcomes.push_back({kind, name, {}, reason});
  }
  /// What OpenSim calls a coordinate that no joint holds.
  const std::string& coordinate(const CoordinateRef& c) const;
};

/// The joints, and those that weld what stands still to the ground.
void write_joint_set(ModelDraft& draft, XmlWriter& out);
/// Ligaments and cables, and what they wrap round.
void write_path_forces(ModelDraft& draft, XmlWriter& out);
/// Elastic layers, and their meshes.
void write_contact_forces(ModelDraft& draft, XmlWriter& forces, XmlWriter& meshes);
/// Springs of coordinates, and what is left of the loads.
void write_other_loads(ModelDraft& draft, XmlWriter& out);

}  // namespace genu::osim
