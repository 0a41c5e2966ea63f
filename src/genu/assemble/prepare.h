// From a scene file to a joint ready to be solved, or everything that is wrong with it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh_care/mesh_flaws.h"
#include "genu/model/step_plan.h"
#include "genu/results/summary.h"
#include "genu/surface/blend_surface.h"

namespace genu {

/// What was read and built for one surface, in words for the user.
struct SurfaceNote {
  std::string name;
  std::string text;
  std::optional<MeshReport> mesh;
  std::shared_ptr<const BlendSurface> blend;  ///< of a mesh: the whole of it, whatever patch is used; else null
};

struct Prepared {
  Scene scene;  ///< its points from the origins that centre_bodies() chose, its bodies with their masses
  std::vector<std::shared_ptr<const Surface>> surfaces;
  std::vector<SurfaceNote> notes;
  Bones bones;                                ///< under surfaces whose thickness is measured
  std::vector<RunSummary::BodyFacts> bodies;  ///< those whose mass follows from a mesh
  JointModel model;
  std::vector<StepPlan> steps;
  std::vector<std::pair<std::string, double>> seconds;  ///< "scene", "meshes", "surfaces"
};

/// Reads the scene and its meshes, checks them, builds the surfaces and the model. Warnings go to `out` as well.
std::optional<Prepared> prepare(const std::string& path, Diagnostics& out);

/// What a summary of anything done with a scene begins with: names, scales, surfaces and the time taken until now.
RunSummary begin_summary(const Prepared& prepared);

/// The surfaces of a scene; those that cannot be built are null and said in `out`.
std::vector<std::shared_ptr<const Surface>> build_surfaces(const Scene& scene, std::vector<SurfaceNote>& notes,
                                                           std::vector<std::pair<std::string, double>>& seconds,
                                                           Diagnostics& out);

}  // namespace genu
