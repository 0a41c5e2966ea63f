// Other surfaces that the meshes of a scene might as well have given: fitted otherwise, measured another time, or with
// fewer points. What the results owe to such choices is their error bar (results/error_bars.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "genu/assemble/prepare.h"
#include "genu/results/error_bars.h"
#include "genu/surface/mesh_noise.h"

namespace genu {

/// The meshes of a scene, all of them changed alike.
struct SurfaceVariant {
  ErrorCause cause = ErrorCause::fit;
  std::string name;          ///< "degree 4, radius x 1.1"
  int degree = 0;            ///< 0: as chosen
  double radius_factor = 1;  ///< of the fit radius that was chosen
  std::uint64_t seed = 0;    ///< > 0: a mesh perturbed by its own noise
  double edge_factor = 1;    ///< > 1: a coarser mesh, fitted as its own edges ask for
};

/// The variants of a run with error bars, the same for every scene.
const std::vector<SurfaceVariant>& surface_variants();

/// Whether any surface of the scene is a mesh.
bool has_meshes(const Prepared& prepared);

/// The noise of each surface's mesh; none for closed forms.
std::vector<MeshNoise> mesh_noises(const Prepared& prepared);

/// The scene with its meshes changed; closed forms are shared. Empty where a changed mesh cannot be used.
std::optional<Prepared> vary(const Prepared& prepared, const std::vector<MeshNoise>& noises,
                             const SurfaceVariant& variant);

}  // namespace genu
