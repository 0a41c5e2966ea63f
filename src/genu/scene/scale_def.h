// A coordinate of a scene, and a factor over a coordinate or time.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace genu {

/// One of a joint's six coordinates: 0..2 rotations, 3..5 translations.
struct CoordinateRef {
  int joint = -1;
  int index = 0;
  bool operator==(const CoordinateRef&) const = default;
};

/// What multiplies a load besides its factor in a step; or the course of a coordinate that is driven. Feedback is
/// gain (target - q) + rate_gain (target' - q') of a coordinate q whose target is a course over time.
struct ScaleDef {
  enum class Kind { over_coordinate, over_time, sine, step, feedback };
  Kind kind = Kind::over_time;
  CoordinateRef coordinate;                      ///< over_coordinate, feedback
  std::vector<std::pair<double, double>> table;  ///< (rad, m or s, factor), the first strictly increasing
  double amplitude = 0;                          ///< sine
  double frequency = 0;                          ///< sine: Hz
  double start = 0;                              ///< sine, step: s
  double offset = 0;                             ///< sine: about which it swings, and before its start
  double from = 0, to = 1;                       ///< step
  double rise = 0;                               ///< step: s, from one value to the other
  double gain = 0, rate_gain = 0;                ///< feedback: per rad or m, and s times that
  std::shared_ptr<const ScaleDef> target;        ///< feedback: rad or m over time

  /// Whether it changes with time by itself.
  bool in_time() const {
    if (kind == Kind::feedback) return target && !target->constant();
    return kind != Kind::over_coordinate;
  }

 private:
  /// A table of one value.
  bool constant() const {
    if (kind != Kind::over_time) return false;
    for (const auto& point : table)
      if (point.second != table.front().second) return false;
    return true;
  }
};

}  // namespace genu
