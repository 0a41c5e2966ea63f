// Points that a person has placed and named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/source_location.h"
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

}  // namespace genu
