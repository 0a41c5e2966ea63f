// Where surfaces were fitted, to look at: over the chart of each the piece of mesh there was, the patch that was
// written down, how far the mesh lies off it, and where contacts travelled. Knows nothing of meshes: it gets points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/types.h"

namespace genu {

struct CoverageMap {
  struct Sample {
    Vec2 at;                         ///< in the chart, mm (arc length round an axis)
    std::optional<double> distance;  ///< mm, from the fitted surface; empty off the patch
  };
  std::string title;
  std::string u_title, v_title;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< corners of the patch, mm
  double spacing = 1;                            ///< mm, of the samples
  std::vector<Sample> samples;
  std::vector<Vec2> contacts;  ///< mm
};

/// One panel a map, on one scale of colours: red where the mesh is above the surface, blue where it is below,
/// grey where no patch is. The same maps give the same bytes.
std::string coverage_svg(const std::vector<CoverageMap>& maps);

}  // namespace genu
