// Paths that wrap round surfaces, by the judge's own method: between the written touching points a chain of points is
// shortened on the surface until it is a geodesic; the legs have to continue it without a corner, along the surface's
// tangents, and lines that do not touch have to clear the surface.
#pragma once

#include <string>
#include <vector>

#include "genu/judge/pose.h"

namespace genu::judge {

/// A path as the table has it, in the world.
struct WrittenPath {
  std::vector<Vec3> points;  ///< ends, via points, and both touching points of each arc
  std::vector<int> bodies;   ///< of each
  std::vector<bool> arc;     ///< whether an arc, not a line, follows the point
  double length = 0;         ///< m: lines and the judge's own arcs
  double unsure = 0;         ///< m: error of the arcs
};

/// The stems of the columns of a path's surfaces: "MCL.tibia", and "MCL.tibia.2" where it is named again.
std::vector<std::string> touch_stems(const Scene& scene, const std::string& name, const std::vector<WrapDef>& wraps);

/// Reads a path of the row and checks how it touches its surfaces.
WrittenPath written_path(const PoseCase& pose, const std::string& name, const std::vector<PathEnd>& points,
                         const std::vector<WrapDef>& wraps);

/// The pulls of a tension (N) along a path.
void add_pulls(const WrittenPath& path, double force, PoseForces& forces);

}  // namespace genu::judge
