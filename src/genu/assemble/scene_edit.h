// A scene's text with polynomials in the place of its meshes; everything else as its author wrote it.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/surface_fits.h"
#include "genu/core/diagnostics.h"

namespace genu {

/// A contact pair of the new scene.
struct FittedPair {
  int contact = 0;   ///< of the old scene, in whose place it stands
  std::string name;  ///< of the contact
  std::string surface_a, surface_b;
};

/// The text of `scene`, read from `file`, without the tables of mesh surfaces that no contact needs any more and of the
/// contacts in `pairs`; instead of them the fitted surfaces and the pairs. Paths of meshes that stay lead from
/// `folder`. An error in `out` where the file writes these tables in a way that cannot be cut out (inline or dotted).
[[nodiscard]] std::string with_fitted_surfaces(const std::string& file, const SceneTables& scene,
                                               const std::vector<FittedPair>& pairs, const std::vector<NamedFit>& fits,
                                               const std::string& folder, Diagnostics& out);

}  // namespace genu
