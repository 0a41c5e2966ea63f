// Files of landmarks: markups of 3D Slicer (.mrk.json, .fcsv) and tables (.csv).
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/landmarks/landmark.h"

namespace genu {

/// Reads what the name's end says: .mrk.json or .json, .fcsv, .csv. `unit`: metres in one unit of a .csv, whose numbers
/// say none. Points that are not placed yet are left out. Empty, with all errors in `out`, where something is wrong.
[[nodiscard]] std::optional<LandmarkFile> read_landmarks(const std::string& file, double unit, Diagnostics& out);

/// The same of a text that is at hand; `file` names it.
[[nodiscard]] std::optional<LandmarkFile> read_landmark_text(const std::string& file, const std::string& text,
                                                             double unit, Diagnostics& out);

}  // namespace genu
