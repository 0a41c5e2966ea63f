// One reader for each kind of file. Each adds its errors to `out` and leaves out what they are about.
#pragma once

#include <string>

#include "genu/core/diagnostics.h"
#include "genu/landmarks/landmark.h"

namespace genu {

/// Markups of 3D Slicer 4.11 and later: any type, by their control points.
LandmarkFile read_markups(const std::string& file, const std::string& text, Diagnostics& out);

/// Fiducials of 3D Slicer 3 to 5: mm. Files without a CoordinateSystem are RAS.
LandmarkFile read_fcsv(const std::string& file, const std::string& text, Diagnostics& out);

/// Columns name (or label), x, y, z and, if there is one, error, under a line that names them.
LandmarkFile read_landmark_table(const std::string& file, const std::string& text, double unit, Diagnostics& out);

}  // namespace genu
