// The numbers of a scene that can be changed in memory, by name. Not installed.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "genu/model/parameters.h"

namespace genu::api {

/// A number of the scene: a parameter (model/parameters.h) or one of an elastic layer.
struct SceneNumber {
  std::string name, unit;
  double si = 1;                ///< SI per unit
  std::string object;           ///< "ligament", "surface", "load", "body", "joint", "contact"
  bool moves_surfaces = false;  ///< surfaces and what was prepared of them have to be made again
  bool moves_points = false;    ///< origins of bodies may have to be chosen again (scene/centre_bodies.h)
  std::function<double*(SceneTables&)> place;
  /// What is wrong with the scene's number as it is now; empty if nothing is.
  std::function<std::string(SceneTables&)> fault;
};

class SceneNumbers {
 public:
  explicit SceneNumbers(const SceneTables& scene);

  /// Those that a pattern names, in the scene's order. Throws SceneError if there is none.
  std::vector<const SceneNumber*> matching(const std::string& pattern) const;

 private:
  void add_layers(const SceneTables& scene);

  SceneTables bundles_;  ///< which alone it has: they name the numbers of their fibres
  std::vector<SceneNumber> all_;
  std::map<std::string, std::size_t> by_name_;
};

/// Whether a pattern means an object of a scene, or its bundle: "ACL*", "ligament.ACL*".
bool means_object(const SceneTables& scene, const std::string& pattern, const std::string& kind,
                  const std::string& name);

/// `scene` without the ligaments, contacts and loads that a pattern means. Throws SceneError if there is none. `what`:
/// "12 ligaments"; `contacts`: any contact is left out.
void leave_out(const std::string& pattern, genu::Scene& scene, std::string& what, bool& contacts);

}  // namespace genu::api
