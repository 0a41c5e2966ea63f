// Points that a person has placed and named: markups of 3D Slicer (.mrk.json, .fcsv) and tables (.csv).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/types.h"

namespace genu {

struct Landmark {
  std::string name;
  Vec3 at = Vec3::Zero();         ///< m, in the frame of its file
  std::optional<double> error{};  ///< m: standard deviation, where the file states one
  FilePlace place{};
};

struct LandmarkFile {
  std::vector<Landmark> points;
  std::string space{};  ///< the frame that the file names: "RAS", "LPS"; empty: none
};

/// Reads what the name's end says: .mrk.json or .json, .fcsv, .csv. `unit`: metres in one unit of a .csv, whose numbers
/// say none. Points that are not placed yet are left out. Empty, with all errors in `out`, where something is wrong.
[[nodiscard]] std::optional<LandmarkFile> read_landmarks(const std::string& file, double unit, Diagnostics& out);

/// The same of a text that is at hand; `file` names it.
[[nodiscard]] std::optional<LandmarkFile> read_landmark_text(const std::string& file, const std::string& text,
                                                             double unit, Diagnostics& out);

}  // namespace genu
