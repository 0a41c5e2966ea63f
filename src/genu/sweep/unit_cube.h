// Points of the unit cube whose coordinates depend on (seed, index, dimension) alone: the same whatever else is
// computed, in any order, on any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace genu {

/// A coordinate as every design gives it: from 2^-53 to 1 - 2^-53. Sums that round to 0 or 1 have no quantile.
double inside_unit(double coordinate);

/// Independent and uniform.
double monte_carlo_coordinate(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension);

/// Of `count` points each of the `count` strata of every dimension holds one. The strata of a dimension are permuted by
/// a keyed Feistel network, whose values are computed one by one. Depends on `count` too.
double latin_hypercube_coordinate(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension,
                                  std::uint64_t count);

/// A permutation of 0 .. count - 1 for each (seed, dimension): where `index` goes.
std::uint64_t permuted(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension, std::uint64_t count);

/// Sobol's sequence with the direction numbers of Joe and Kuo (2008), scrambled as by Owen (1995): each digit is
/// flipped by a random bit that depends on the digits before it, and digits behind the 32nd are random.
class SobolSequence {
 public:
  /// `dimensions` <= kMaxSobolDimensions.
  SobolSequence(std::uint64_t seed, std::uint32_t dimensions);
  /// index < 2^32.
  double coordinate(std::uint64_t index, std::uint32_t dimension) const;
  /// The first 32 binary digits without scrambling.
  std::uint32_t digits(std::uint64_t index, std::uint32_t dimension) const;

 private:
  std::uint32_t scrambled(std::uint32_t digits, std::uint32_t dimension) const;

  std::uint64_t seed_;
  std::vector<std::array<std::uint32_t, 32>> directions_;  ///< of each dimension, the first for the lowest bit
};

}  // namespace genu
