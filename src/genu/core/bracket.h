// A root between two places: regula falsi with the Illinois rule, bisection where a value is not known.
#pragma once

#include <algorithm>
#include <cmath>

namespace genu {

/// Whether two values have opposite signs, neither being zero.
inline bool opposite(double a, double b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

class Bracket {
 public:
  /// Values of opposite signs at both ends; one that is not finite is not known.
  Bracket(double low, double low_value, double high, double high_value, double tolerance)
      : low_(low), high_(high), low_value_(low_value), high_value_(high_value), tolerance_(tolerance) {}

  bool open() const { return width() > tolerance_; }

  double low() const { return low_; }
  double high() const { return high_; }
  double width() const { return high_ - low_; }

  /// Where to look next, inside the bracket; every fourth time in its middle.
  double next() {
    const bool known = std::isfinite(low_value_) && std::isfinite(high_value_) && low_value_ * high_value_ < 0;
    if (!known || ++asked_ % 4 == 0) return 0.5 * (low_ + high_);
    // Not nearer to an end than half the tolerance: a root that is approached from one side is passed in the end, and
    // the bracket closes behind it.
    const double inside = std::min(0.5, 0.5 * tolerance_ / width());
    return low_ + width() * std::clamp(low_value_ / (low_value_ - high_value_), inside, 1 - inside);
  }

  /// Puts the end on the side of `low` (`high`) to x. An end that stays while the other one moves twice counts half.
  void move_low(double x, double value) {
    if (moved_ < 0) high_value_ *= 0.5;
    low_ = x;
    low_value_ = value;
    moved_ = -1;
  }
  void move_high(double x, double value) {
    if (moved_ > 0) low_value_ *= 0.5;
    high_ = x;
    high_value_ = value;
    moved_ = 1;
  }

 private:
  double low_, high_, low_value_, high_value_, tolerance_;
  int moved_ = 0, asked_ = 0;
};

}  // namespace genu
