// Every tolerance of the room `sweep`, by the unit that uses it. tools/tolerances-page writes docs/tolerances.md
// from these headers: [unit], bound, what fails first if the value is wrong.
#pragma once

#include <cstdint>

namespace genu {

// distribution

/// [1] Smallest number that a design can give, half of 2^-52 and less than 8.3 standard deviations below the mean.
/// Fails first: if too large, a normal stiffness that can become negative is accepted.
inline constexpr double kSmallestUnit = 0x1p-53;

// read_vary

/// [sd] How far from the mean a truncated range may lie; beyond, quantiles have no digits. Fails first: if too large,
/// all draws are one bound.
inline constexpr double kFarthestTruncation = 30;

// read_sweep

/// [1] Most samples of a sweep. Fails first: if too large, memory of the merged table.
inline constexpr std::int64_t kMaxSamples = 100'000'000;

/// [1] Least eigenvalue of a correlation matrix. Fails first: if too small, its Cholesky factor is round-off.
inline constexpr double kLeastCorrelationEigenvalue = 1e-9;

/// [1] Error of a correlation matrix's symmetry and diagonal that is rounding. Fails first: if too small, matrices with
/// printed digits are refused.
inline constexpr double kCorrelationRounding = 1e-9;

// fraction

/// [1] Most bits of the number of samples of a fractional factorial design. Fails first: if too large, the search for
/// its words takes seconds.
inline constexpr int kMostFractionBits = 16;

// kept_numbers

/// [1] Distance of a row from a main-coordinate value, over the coordinate's range, that is rounding. Fails first: if
/// too small, rows that a step prescribes are interpolated.
inline constexpr double kSameRow = 1e-9;

// run_sweep

/// [s] From one write of finished samples to the next. Fails first: if too large, a killed sweep repeats more.
inline constexpr double kKeepSeconds = 1;

// statistics

/// [1] Standard normal quantile of two-sided 95 %. Fails first: coverage of every interval.
inline constexpr double kTwoSided95 = 1.959963984540054;

/// [1] Fewest samples of a row of the convergence table. Fails first: if too small, rows of noise.
inline constexpr std::size_t kLeastConvergence = 16;

}  // namespace genu
