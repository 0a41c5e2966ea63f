// A coordinate of a scene, and a factor over a coordinate or time.
#pragma once

#include <utility>
#include <vector>

namespace genu {

/// One of a joint's six coordinates: 0..2 rotations, 3..5 translations.
struct CoordinateRef {
  int joint = -1;
  int index = 0;
  bool operator==(const CoordinateRef&) const = default;
};

/// What multiplies a load besides its factor in a step; or the course of a coordinate that is driven.
struct ScaleDef {
  enum class Kind { over_coordinate, over_time, sine, step };
  Kind kind = Kind::over_time;
  CoordinateRef coordinate;                      ///< over_coordinate
  std::vector<std::pair<double, double>> table;  ///< (rad, m or s, factor), the first strictly increasing
  double amplitude = 0;                          ///< sine
  double frequency = 0;                          ///< sine: Hz
  double start = 0;                              ///< sine, step: s
  double offset = 0;                             ///< sine: about which it swings, and before its start
  double from = 0, to = 1;                       ///< step
  double rise = 0;                               ///< step: s, from one value to the other
};

}  // namespace genu
