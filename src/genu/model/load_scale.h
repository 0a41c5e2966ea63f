// A course over time or over a joint coordinate: what multiplies a load besides its factor in a step, or what a
// coordinate that is driven follows. A curve through points, a sine, or a smooth step.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "genu/law/monotone_table.h"
#include "genu/scene/scene.h"

namespace genu {

class LoadScale {
 public:
  struct Value {
    double factor = 1;
    double slope = 0;      ///< d factor / d x, per rad, m or s
    double curvature = 0;  ///< d2 factor / d x2
  };

  /// Empty where the table is none; then `why` says what is wrong with it.
  static std::optional<LoadScale> make(const ScaleDef& def, std::string& why);

  /// The coordinate (rad, m) it depends on; empty: the time (s).
  const std::optional<CoordinateRef>& coordinate() const { return coordinate_; }

  /// A table is the monotone curve through its points (MonotoneTable) and keeps its end values beyond them. The curve
  /// may have a kink at its ends, where the slope is the outer one, 0; so has a sine at its start. A step without a
  /// rise has its second value from its start on.
  Value evaluate(double x) const;

  /// Times (s) where the factor or a derivative may jump; empty for a scale over a coordinate.
  std::vector<double> nonsmooth_points_in_time() const { return coordinate_ ? std::vector<double>() : knots_; }

  /// Where the slope jumps: the ends of a table over a coordinate (rad, m); none for other scales.
  struct NonsmoothPoint {
    double x = 0, below = 0, above = 0;  ///< and its slopes on both sides
  };
  std::vector<NonsmoothPoint> nonsmooth_points_over_coordinate() const;

  /// Of a sine, s; else 0.
  double period() const { return kind_ == ScaleDef::Kind::sine ? 2 * std::numbers::pi / angular_frequency_ : 0; }

  /// The largest |factor|.
  double largest() const { return largest_; }

 private:
  Value table(double x) const;
  Value sine(double x) const;
  Value step(double x) const;

  ScaleDef::Kind kind_ = ScaleDef::Kind::over_time;
  std::optional<CoordinateRef> coordinate_;
  std::optional<MonotoneTable> table_;
  double first_ = 0, last_ = 0;  ///< x of the table's ends
  std::vector<double> knots_;    ///< x of its points, the sine's start, or where the step begins and ends
  double offset_ = 0, amplitude_ = 0, angular_frequency_ = 0, start_ = 0;
  double from_ = 0, to_ = 1, rise_ = 0;
  double largest_ = 0;
};

}  // namespace genu
