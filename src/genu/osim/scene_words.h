// Numbers and names of a scene that is written: mm, deg, N, and names as TOML keys.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include "genu/core/source_location.h"
#include "genu/core/types.h"

namespace genu::osim {

/// To 12 digits, which is less than 1e-9 mm of a joint; no "-0".
std::string number_text(double x);
/// "[1, 2, 3]"
std::string vector_text(const Vec3& v);
/// A point in m as mm.
std::string point_text(const Vec3& p);

/// Text for a comment: one line without control characters.
std::string one_line(const std::string& text);

/// Names of one kind of table: each element of the model gets one (letters, digits, _ and -), no two alike, though
/// their names are alike or missing.
class SceneNames {
 public:
  /// `element`: its place in the file, which tells it apart; {} of the ground.
  std::string of(const SourceLocation& element, const std::string& name);

 private:
  std::map<std::pair<int, int>, std::string> given_;
  std::set<std::string> taken_;
};

/// "flex" of the coordinate knee_flex_r of joint knee_r: what `genu evaluate` and `genu convert --to opensim` call by
/// its long name. A name that does not begin as its joint does stays whole.
std::string short_coordinate(const std::string& coordinate, const std::string& joint);

}  // namespace genu::osim
