// A curve through measured points that never overshoots them: a cubic Hermite interpolant, once continuously
// differentiable, rising where the points rise and flat where they are flat.
// Slopes: F. N. Fritsch and J. Butland, "A method for constructing local monotone piecewise cubic interpolants",
// SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, with the three-point end slopes usual with it (PCHIP).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace genu {

/// Outside its points the curve goes on straight with its end slopes. A table without a negative value never becomes
/// negative: there the straight line ends at 0 and the curve stays 0 beyond.
class MonotoneTable {
 public:
  struct Value {
    double y = 0;
    double slope = 0;      ///< dy/dx
    double integral = 0;   ///< of y from the first point to x
    double curvature = 0;  ///< d2y/dx2
  };

  /// At least two finite points (x, y) with strictly increasing x; otherwise empty, and `why` says what is wrong.
  [[nodiscard]] static std::optional<MonotoneTable> make(const std::vector<std::pair<double, double>>& points,
                                                         std::string& why);

  Value evaluate(double x) const;

  double first_x() const { return knots_.front().x; }
  double last_x() const { return knots_.back().x; }

  /// The x from which the curve exceeds y for the first time: the end of a plateau at y, not its beginning. Where y is
  /// the largest value reached, its last point. Empty if the curve never rises to y.
  std::optional<double> first_rise_through(double y) const;

  /// The largest x such that the curve is 0 from -infinity to x; empty if there is none.
  std::optional<double> zero_until() const;

  /// The smallest x such that the curve is 0 from x to +infinity; empty if there is none.
  std::optional<double> zero_from() const;

 private:
  struct Knot {
    double x = 0, y = 0, slope = 0, integral = 0;
  };

  Value straight_from(const Knot& knot, double x) const;
  static Value cubic(const Knot& left, const Knot& right, double x);
  static double solve(const Knot& left, const Knot& right, double y);

  std::vector<Knot> knots_;
  bool nonnegative_ = true;
};

}  // namespace genu
