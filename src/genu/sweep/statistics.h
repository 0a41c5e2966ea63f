// Statistics of samples. NaN in a sample means that it has no such number; it is left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace genu {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct Interval {
  double low = kNoNumber, high = kNoNumber;
};

/// Those that are numbers.
std::vector<double> finite_of(const std::vector<double>& values);

struct Moments {
  std::size_t count = 0;
  double mean = kNoNumber, sd = kNoNumber;  ///< sd: with n - 1
  Interval mean_95;                         ///< mean -+ 1.96 sd / sqrt(n)
};
Moments moments(const std::vector<double>& values);

/// The q quantile of sorted numbers, linear between order statistics (type 7 of Hyndman and Fan); NaN of none.
double quantile(const std::vector<double>& sorted, double q);
/// 95 % interval of that quantile by order statistics, with the normal approximation of their ranks; NaN where the
/// sample does not reach so far.
Interval quantile_interval(const std::vector<double>& sorted, double q);

/// Wilson's 95 % interval of a probability of which `count` of `n` were seen.
Interval probability_interval(std::uint64_t count, std::uint64_t n);

/// The places of the numbers among `values`, those of smaller ones first.
std::vector<std::size_t> ascending(const std::vector<double>& values);

/// Samples with the order of their numbers, found once.
struct Ordered {
  explicit Ordered(std::vector<double> samples) : values(std::move(samples)), order(ascending(values)) {}
  std::vector<double> values;
  std::vector<std::size_t> order;
};

/// Spearman's rank correlation of the pairs in which both are numbers, equal numbers with their mean rank. NaN where
/// one of the two does not vary. Linear in the number of pairs.
double rank_correlation(const Ordered& x, const Ordered& y);
/// Its 95 % interval by Fisher's transformation, n pairs; variance of ranks by Bonett and Wright (2000).
Interval rank_correlation_interval(double correlation, std::size_t n);

/// Sobol indices of a factor by Saltelli's scheme.
struct SobolIndex {
  double first = kNoNumber, total = kNoNumber;              ///< shares of the variance
  double first_error = kNoNumber, total_error = kNoNumber;  ///< standard errors
  std::size_t blocks = 0;                                   ///< with all their numbers
};
/// `values`: block after block A, B, then A with the column of each factor from B. First: Saltelli et al. 2010; total:
/// Jansen 1999. A block that lacks a number is left out.
std::vector<SobolIndex> sobol_indices(const std::vector<double>& values, std::size_t factors);

}  // namespace genu
