// Regular fractions of two-level factorial designs.
//
// A fraction of 2^m samples gives each factor a word of m bits; in sample i the factor has its second level where i and
// the word have an odd number of bits in common. What cannot be told apart in it are products of factors whose words
// add up (exclusive or) to nothing. The least number of factors in such a product is the resolution: with 3 main
// effects are mixed with products of two factors, with 4 with those of three, with 5 two such products are not mixed
// either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace genu {

struct Fraction {
  int bits = 0;                      ///< the design has 2^bits samples
  std::vector<std::uint32_t> words;  ///< of each factor
};

/// The smallest fraction of at least this resolution (3 to 5) for so many factors in which words can be chosen one
/// after another, each the first that fits: Hamming's for resolution 3 and 4. Empty where it has more than
/// 2^kMostFractionBits samples.
[[nodiscard]] std::optional<Fraction> find_fraction(std::size_t factors, int resolution);

/// Whether a factor has its second level in a sample.
bool second_level(std::uint32_t word, std::uint64_t sample);

}  // namespace genu
