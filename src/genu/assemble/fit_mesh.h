// Polynomials for the contact surfaces of one mesh file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/surface_fits.h"
#include "genu/core/diagnostics.h"

namespace genu {

struct FitMeshRequest {
  std::string file;
  std::optional<double> file_unit;   ///< m; told from the mesh's size where empty
  std::string name, body;            ///< of the surfaces; the file's name and "body" where empty
  std::vector<std::string> regions;  ///< one surface each: "z < 0"; the whole mesh where empty. Lengths in file units
  std::optional<Vec3> facing;
  std::optional<bool> cylindrical;
  std::optional<int> degree;
  std::optional<KnownPatch> like;  ///< chart, patch and degree as another fit has them
};

/// Reads the mesh, finds its surfaces, fits each. Several get numbered names. Empty with every reason in `out` where
/// one cannot be done. `file_unit` (may be null) gets the unit (m) that was taken for the file's.
[[nodiscard]] std::vector<NamedFit> fit_mesh(const FitMeshRequest& request, Diagnostics& out,
                                             double* file_unit = nullptr);

/// The file of surfaces that `genu mesh` and scenes read: mm and deg.
std::string surface_file(const std::vector<NamedFit>& fits, const std::string& title);

}  // namespace genu
