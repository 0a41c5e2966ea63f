// OpenSim's functions of one coordinate: of joints, couplers and moving points of paths.
#pragma once

#include <vector>

namespace genu::osim {

/// scale * f(x), with x in rad or m, f in rad or m.
struct Function {
  enum class Kind {
    constant,         ///< coefficients: value
    linear,           ///< coefficients: slope, value at 0
    polynomial,       ///< coefficients: the highest power first
    spline,           ///< SimmSpline: a cubic spline through (x, y), straight beyond its ends
    piecewise_linear  ///< through (x, y), straight beyond its ends
  };
  Kind kind = Kind::constant;
  std::vector<double> coefficients = {0.0};
  std::vector<double> x, y;
  double scale = 1;

  double operator()(double at) const;
  /// A straight line, as a joint of genu has it: slope and value at 0.
  bool is_line() const { return kind == Kind::linear; }
};

}  // namespace genu::osim
