// The axis of a patch, read off its border.
//
// A sheet that was cut from r = P(theta, z) along the lines of its chart has a border that no segmentation has: two
// sides in parallel planes, across the axis, and two in planes that meet in the axis. That gives the chart back to
// rounding, whatever P is. The surface inside hardly does: moving the axis sideways adds cos(theta) to r, which terms
// of a high degree take up, and tilting it does nothing at all to a surface as round across as along.
#pragma once

#include <optional>

#include "genu/geometry/mesh.h"
#include "genu/geometry/surface_chart.h"

namespace genu {

struct BorderChart {
  SurfaceChart chart;  ///< cylindrical; z with its largest component positive, x through the middle of the patch
  ChartBox patch;      ///< centred on (0, 0)
};

/// The spacing of single precision (m) at the coordinates of a mesh: what a file may have moved a vertex by.
double file_resolution(const Mesh& mesh);

/// The chart of which the one border of `sheet` is a rectangle, to file_resolution(). Empty where the border is
/// anything else, or where the sides along the axis keep their distance from it, so that their planes are not told.
std::optional<BorderChart> chart_of_border(const Mesh& sheet);

}  // namespace genu
