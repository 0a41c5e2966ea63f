// The chart of a patch, read off its border.
//
// A sheet that was cut from a polynomial along the lines of its chart has a border that no segmentation has. Of
// z = P(x, y): two sides in parallel planes, two in planes across. Of r = P(theta, z): two in parallel planes across
// the axis, two in planes that meet in it. That gives the chart back to rounding, whatever P is. The surface inside
// does not tell an axis so well: moving it sideways adds cos(theta) to r, which terms of a high degree take up, and
// tilting it does nothing at all to a surface as round across as along.
#pragma once

#include <numbers>
#include <optional>

#include "genu/mesh/mesh.h"
#include "genu/surface/surface_chart.h"

namespace genu {

struct BorderChart {
  /// Cartesian: z outward, x along the longer side, its largest component positive. Cylindrical: z along the axis, its
  /// largest component positive, x through the middle of the patch.
  SurfaceChart chart;
  ChartBox patch;  ///< centred on (0, 0); in round numbers where it is so to rounding
};

/// The spacing of single precision (m) at the coordinates of a mesh: what a file may have moved a vertex by.
double file_resolution(const Mesh& mesh);

/// The chart of which the one border of `sheet` is a rectangle, to file_resolution(); the height of a cartesian one's
/// origin is any. Empty where the border is anything else, or so straight that it does not tell.
std::optional<BorderChart> chart_of_border(const Mesh& sheet);

}  // namespace genu
