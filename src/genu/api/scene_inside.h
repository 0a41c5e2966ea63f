// A scene's state behind its header. Not installed.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "genu/api/inside.h"
#include "genu/api/scene.h"
#include "genu/api/scene_numbers.h"
#include "genu/assemble/solution.h"
#include "genu/model/ligament_law.h"

namespace genu::api {

struct Scene::Inside {
  /// Reads nothing: prepares `read` at once. Throws SceneError.
  Inside(genu::Scene read, std::shared_ptr<MeshLibrary> library);

  /// The scene as it is now, ready to be solved. What earlier states of it, and its copies, have prepared is shared.
  std::shared_ptr<Ready> assembled();
  /// After a change.
  void forget() { ready.reset(); }

  genu::Scene source;
  std::shared_ptr<MeshLibrary> meshes;
  std::shared_ptr<const SceneNumbers> numbers;
  std::shared_ptr<Ready> base;   ///< the same surfaces, contacts, bodies and joints, with its own numbers
  std::shared_ptr<Ready> ready;  ///< null after a change
  bool other_surfaces = false;   ///< `base` cannot be shared
  bool moved_points = false;     ///< it can, unless bodies get other origins
  std::map<std::string, LigamentLaw> laws;
  struct Change {
    double before = 0, now = 0;  ///< in the number's unit
    std::string unit;
  };
  std::map<std::string, Change> changed;
  std::vector<std::string> other_changes;
  std::vector<Problem> warnings;

 private:
  bool shares_base() const;
  std::shared_ptr<Ready> prepared(Diagnostics& out);
  void put_laws(JointModel& model) const;
};

/// The options that the rooms below know.
genu::RunOptions options_of(const RunOptions& options);

}  // namespace genu::api
