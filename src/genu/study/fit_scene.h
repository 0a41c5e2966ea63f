// Polynomials in place of the meshes of a scene, over the zones where its contacts travel.
//
// Where surfaces of a joint touch is not in their meshes but in the joint: the scene is solved, and each mesh surface
// is fitted round the path of its contacts, with a margin. Contacts that a scene parts by regions (medial, lateral), or
// that stay apart, become pairs of their own. What comes out is the same scene with polynomials for meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/surface_fits.h"
#include "genu/core/diagnostics.h"
#include "genu/study/run_scene.h"

namespace genu {

struct FitSceneRequest {
  std::string file;
  double margin = 0.008;  ///< m: how far patches go beyond the contacts
  std::optional<int> degree;
};

struct SceneFits {
  std::vector<NamedFit> fits;
  std::string scene;  ///< the new scene's text
  Solution solution;  ///< of the scene as it was
};

/// Solves the scene, fits, and writes the new scene for the folder `folder`, from which paths of meshes that stay are
/// told. Empty, with the reasons in `out`, where the scene is refused or has no contact on a mesh, where the folder
/// cannot be written or holds what is read, or where a fit fails.
[[nodiscard]] std::optional<SceneFits> fit_scene(const FitSceneRequest& request, const std::string& folder,
                                                 Diagnostics& out);

/// The largest differences between two runs of the same path, in the joints' coordinates (columns of results.csv).
std::vector<std::pair<std::string, double>> pose_differences(const SceneTables& scene, const ResultTable& a,
                                                             const ResultTable& b);

}  // namespace genu
