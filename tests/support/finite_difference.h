// Numerical derivatives to hold analytic ones to: central differences with one Richardson extrapolation, whose error is
// O(h^4) from truncation and O(eps |f| / h), O(eps |f| / h^2) for second derivatives, from rounding.
#pragma once

#include <Eigen/Core>

namespace genu::test {

/// d f / d s at s = 0 of a scalar, vector or matrix f(s); f returns values, not Eigen expressions.
template <class F>
auto derivative(F&& f, double h) {
  using Value = decltype(f(h));  // a value, not one of Eigen's expressions: those would outlive their operands
  const auto central = [&](double step) { return Value((f(step) - f(-step)) / (2 * step)); };
  const Value coarse = central(h), fine = central(h / 2);
  return Value((4 * fine - coarse) / 3);
}

/// d^2 f / d s^2 at s = 0.
template <class F>
auto second_derivative(F&& f, double h) {
  using Value = decltype(f(h));
  const Value middle = f(0.0);
  const auto central = [&](double step) { return Value((f(step) - 2 * middle + f(-step)) / (step * step)); };
  const Value coarse = central(h), fine = central(h / 2);
  return Value((4 * fine - coarse) / 3);
}

/// The matrix d f_i / d x_j of a vector function of a vector.
template <class F>
Eigen::MatrixXd jacobian(F&& f, const Eigen::VectorXd& x, double h) {
  Eigen::MatrixXd J;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd column = derivative(
        [&](double s) {
          Eigen::VectorXd moved = x;
          moved[j] += s;
          return Eigen::VectorXd(f(moved));
        },
        h);
    if (j == 0) J.resize(column.size(), x.size());
    J.col(j) = column;
  }
  return J;
}

}  // namespace genu::test
