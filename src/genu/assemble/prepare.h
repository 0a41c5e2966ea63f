// From a scene, in a file or in memory, to a joint ready to be solved, or everything that is wrong with it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh/stair_steps.h"
#include "genu/mesh_care/mesh_flaws.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/model/step_plan.h"
#include "genu/results/summary.h"
#include "genu/surface/blend_surface.h"

namespace genu {

class ContactField;

/// What was read and built for one surface, in words for the user.
struct SurfaceNote {
  std::string name;
  std::string text;
  std::optional<MeshReport> mesh;
  std::shared_ptr<const BlendSurface> blend;  ///< of a mesh: the whole of it, whatever patch is used; else null
  std::optional<StairSteps> steps = {};       ///< of a segmentation that was not smoothed
  std::string space = {};                     ///< the frame that a mesh file names (mesh_space.h); empty: none
};

struct Prepared {
  Scene source;       ///< as read
  PlacedScene scene;  ///< as solved, its bodies with their masses
  std::vector<std::shared_ptr<const Surface>> surfaces;
  std::vector<SurfaceNote> notes;
  Bones bones;                                ///< under surfaces whose thickness is measured
  std::vector<RunSummary::BodyFacts> bodies;  ///< those whose mass follows from a mesh
  JointModel model;
  std::vector<StepPlan> steps;
  std::vector<std::pair<std::string, double>> seconds;  ///< "scene", "meshes", "surfaces"
  std::shared_ptr<MeshLibrary> meshes;                  ///< through which the scene's meshes, and its file, were read
  std::vector<std::string> facing;  ///< sentences on surfaces that do not face each other at the start (facing.h)
  std::shared_ptr<const ContactField> search;  ///< shared with other numbers (with_numbers.h); null: not shared
};

/// Reads the scene (changed_scene.h) and its meshes, checks them, builds the surfaces and the model. Warnings go to
/// `out` as well.
[[nodiscard]] std::optional<Prepared> prepare(const SceneSource& source, Diagnostics& out);

/// The same of a scene in memory, as read_scene() or parse_scene() gives it, changed or not. Its meshes come from
/// `meshes`: files, or meshes in memory under the names that the scene has for files (MeshLibrary::put()).
[[nodiscard]] std::optional<Prepared> prepare(Scene scene, std::shared_ptr<MeshLibrary> meshes, Diagnostics& out);

/// What a summary of anything done with a scene begins with: names, scales, surfaces and the time taken until now.
RunSummary begin_summary(const Prepared& prepared);

/// The surfaces of a scene; those that cannot be built are null and said in `out`.
[[nodiscard]] std::vector<std::shared_ptr<const Surface>> build_surfaces(
    const PlacedScene& scene, MeshLibrary& meshes, std::vector<SurfaceNote>& notes,
    std::vector<std::pair<std::string, double>>& seconds, Diagnostics& out);

}  // namespace genu
