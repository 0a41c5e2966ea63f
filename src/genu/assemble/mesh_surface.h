// The surface of mesh files: read, cleaned, its flaws set apart, made smooth.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/core/disk_cache.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/stair_steps.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/scene/surface_def.h"
#include "genu/surface/blend_surface.h"
#include "genu/surface/facet_surface.h"

namespace genu {

struct MeshSurface {
  std::string text;                      ///< for the summary
  std::string space;                     ///< the frame that the file names (mesh_space.h); empty: none
  std::optional<MeshReport> report;      ///< empty where nothing was read
  std::optional<StairSteps> steps;       ///< of a segmentation that was not smoothed
  Diagnostics found;                     ///< about the files
  std::shared_ptr<BlendSurface> blend;   ///< one of these two; both are null where `found` has errors
  std::shared_ptr<FacetSurface> facets;  ///< where it is wanted as flat triangles
};

/// `def` has shape mesh. `read_seconds` grows by the time of all but the fits. What the cache (null: none) has
/// of the same bytes of the same files, with the same keys of the surface, is not built again: the same to the last
/// bit. Meshes in memory are not kept.
[[nodiscard]] MeshSurface mesh_surface(const SurfaceDef& def, bool facets, MeshLibrary& meshes, double& read_seconds,
                                       const DiskCache* cache = user_cache());

}  // namespace genu
