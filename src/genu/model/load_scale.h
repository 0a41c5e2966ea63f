// What multiplies a load besides its factor in a step: a curve over a joint coordinate or over time, or a sine in time.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "genu/model/monotone_table.h"
#include "genu/scene/scene.h"

namespace genu {

class LoadScale {
 public:
  struct Value {
    double factor = 1;
    double slope = 0;  ///< d factor / d x, per rad, m or s
  };

  /// Empty where the table is none; then `why` says what is wrong with it.
  static std::optional<LoadScale> make(const ScaleDef& def, std::string& why);

  /// The coordinate (rad, m) it depends on; empty: the time (s).
  const std::optional<CoordinateRef>& coordinate() const { return coordinate_; }

  /// A table is the monotone curve through its points (MonotoneTable) and keeps its end values beyond them. The curve
  /// may have a kink at its ends, where the slope is the outer one, 0; so has a sine at its start.
  Value evaluate(double x) const;

  /// Times (s) where a derivative may jump; empty for a scale over a coordinate.
  std::vector<double> kinks_in_time() const { return coordinate_ ? std::vector<double>() : knots_; }

  /// Of a sine, s; else 0.
  double period() const { return table_ ? 0 : 2 * std::numbers::pi / angular_frequency_; }

  /// The largest |factor|.
  double largest() const { return largest_; }

 private:
  std::optional<CoordinateRef> coordinate_;
  std::optional<MonotoneTable> table_;  ///< empty: a sine
  double first_ = 0, last_ = 0;         ///< x of the table's ends
  std::vector<double> knots_;           ///< x of its points, or the sine's start
  double amplitude_ = 0, angular_frequency_ = 0, start_ = 0;
  double largest_ = 0;
};

}  // namespace genu
