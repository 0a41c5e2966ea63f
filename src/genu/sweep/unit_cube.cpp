#include "genu/sweep/unit_cube.h"

#include <algorithm>

#include "genu/sweep/philox.h"
#include "genu/sweep/sobol_numbers.h"
#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

constexpr int kFeistelRounds = 8;

/// One of 2^(2 half) values to another, each once.
std::uint64_t feistel(std::uint64_t seed, std::uint64_t value, std::uint32_t dimension, int half) {
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::uint64_t left = value >> half, right = value & mask;
  for (int round = 0; round < kFeistelRounds; ++round) {
    const std::uint64_t word = right << 4 | static_cast<std::uint64_t>(round);
    const std::uint64_t next = left ^ (random_bits(seed, word, dimension, DrawPurpose::stratum) & mask);
    left = right;
    right = next;
  }
  return left << half | right;
}

}  // namespace

double inside_unit(double coordinate) { return std::clamp(coordinate, kSmallestUnit, 1 - kSmallestUnit); }

double monte_carlo_coordinate(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension) {
  return open_unit(random_bits(seed, index, dimension, DrawPurpose::coordinate));
}

std::uint64_t permuted(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension, std::uint64_t count) {
  int half = 1;
  while ((std::uint64_t{1} << (2 * half)) < count) ++half;
  do index = feistel(seed, index, dimension, half);
  while (index >= count);  // cycle walking: the network permutes a few more values than there are
  return index;
}

double latin_hypercube_coordinate(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension,
                                  std::uint64_t count) {
  const auto stratum = static_cast<double>(permuted(seed, index, dimension, count));
  return inside_unit((stratum + monte_carlo_coordinate(seed, index, dimension)) / static_cast<double>(count));
}

SobolSequence::SobolSequence(std::uint64_t seed, std::uint32_t dimensions) : seed_(seed) {
  for (std::uint32_t d = 0; d < dimensions; ++d) directions_.push_back(sobol_directions(d));
}

std::uint32_t SobolSequence::digits(std::uint64_t index, std::uint32_t dimension) const {
  std::uint32_t digits = 0;
  for (int bit = 0; bit < 32; ++bit)
    if ((index >> bit & 1) != 0) digits ^= directions_[dimension][static_cast<std::size_t>(bit)];
  return digits;
}

std::uint32_t SobolSequence::scrambled(std::uint32_t digits, std::uint32_t dimension) const {
  std::uint32_t flips = 0;
  for (std::uint32_t level = 0; level < 32; ++level) {
    const std::uint64_t before = level == 0 ? 0 : digits >> (32 - level);
    const std::uint64_t node = before << 5 | level;
    const auto flip = static_cast<std::uint32_t>(random_bits(seed_, node, dimension, DrawPurpose::scramble) & 1)
                      << (31 - level);
    flips |= flip;
  }
  return digits ^ flips;
}

double SobolSequence::coordinate(std::uint64_t index, std::uint32_t dimension) const {
  const double tail = open_unit(random_bits(seed_, index, dimension, DrawPurpose::tail));
  return inside_unit((scrambled(digits(index, dimension), dimension) + tail) * 0x1p-32);
}

}  // namespace genu
