// From a scene file to a joint ready to be solved, or everything that is wrong with it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/geometry/mesh_check.h"
#include "genu/geometry/mesh_flaws.h"
#include "genu/solver/step_plan.h"

namespace genu {

/// What was read and built for one surface, in words for the user.
struct SurfaceNote {
  std::string name;
  std::string text;
  std::optional<MeshReport> mesh;
};

struct Prepared {
  Scene scene;  ///< its points from the origins that centre_bodies() chose
  std::vector<std::shared_ptr<const Surface>> surfaces;
  std::vector<SurfaceNote> notes;
  JointModel model;
  std::vector<StepPlan> steps;
  std::vector<std::pair<std::string, double>> seconds;  ///< "scene", "meshes", "surfaces"
};

/// Reads the scene and its meshes, checks them, builds the surfaces and the model. Warnings go to `out` as well.
std::optional<Prepared> prepare(const std::string& path, Diagnostics& out);

/// The surfaces of a scene; those that cannot be built are null and said in `out`.
std::vector<std::shared_ptr<const Surface>> build_surfaces(const Scene& scene, std::vector<SurfaceNote>& notes,
                                                           std::vector<std::pair<std::string, double>>& seconds,
                                                           Diagnostics& out);

/// The path of a scene. Loads that a step does not name keep the factor 1; each step begins at the time the one before
/// it ends, the first at 0.
std::vector<StepPlan> plan_steps(const Scene& scene);

}  // namespace genu
