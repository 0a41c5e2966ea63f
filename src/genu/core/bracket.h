// A root between two places: regula falsi with the Illinois rule. Bisection where a value is not known, and for more
// and more steps where regula falsi helps little, as where the value jumps.
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

  /// Where to look next, inside the bracket.
  double next() {
    const bool known = std::isfinite(low_value_) && std::isfinite(high_value_) && low_value_ * high_value_ <= 0 &&
                       low_value_ != high_value_;
    asked_ = !known || bisections_ > 0 ? Asked::middle : Asked::root;
    if (asked_ == Asked::middle) {
      bisections_ = std::max(0, bisections_ - 1);
      return 0.5 * (low_ + high_);
    }
    // Not nearer to an end than half the tolerance: a root that is approached from one side is passed in the end, and
    // the bracket closes behind it.
    const double inside = std::min(0.5, 0.5 * tolerance_ / width());
    return low_ + width() * std::clamp(low_value_ / (low_value_ - high_value_), inside, 1 - inside);
  }

  /// Puts the end on the side of `low` (`high`) to x. An end that stays while the other one moves twice counts half.
  void move_low(double x, double value) {
    learn(high_ - x, std::abs(value) < 0.5 * std::abs(low_value_));
    if (moved_ < 0) high_value_ *= 0.5;
    low_ = x;
    low_value_ = value;
    moved_ = -1;
  }
  void move_high(double x, double value) {
    learn(x - low_, std::abs(value) < 0.5 * std::abs(high_value_));
    if (moved_ > 0) low_value_ *= 0.5;
    high_ = x;
    high_value_ = value;
    moved_ = 1;
  }

 private:
  enum class Asked { nothing, middle, root };

  /// Whether the last look at a root halved the bracket or the value at the end that moves.
  void learn(double width_left, bool value_halved) {
    if (asked_ != Asked::root) return;
    asked_ = Asked::nothing;
    failures_ = value_halved || width_left <= 0.5 * width() ? 0 : std::min(failures_ + 1, 5);
    bisections_ = failures_ == 0 ? 0 : 1 << (failures_ - 1);
  }

  double low_, high_, low_value_, high_value_, tolerance_;
  Asked asked_ = Asked::nothing;
  int moved_ = 0, failures_ = 0, bisections_ = 0;
};

}  // namespace genu
