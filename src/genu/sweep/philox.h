// Counter-based random numbers: Philox4x32-10 (Salmon, Moraes, Dror and Shaw 2011, "Parallel random numbers: as easy as
// 1, 2, 3"). A number is a function of its counter and key alone: there is no state and no order.
#pragma once

#include <array>
#include <cstdint>

namespace genu {

using PhiloxBlock = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// Ten rounds. Equal to Random123's philox4x32 on its known answers.
PhiloxBlock philox(PhiloxBlock counter, PhiloxKey key);

/// What a random number is for. Numbers of different purposes have different counters and so are independent.
enum class DrawPurpose : std::uint32_t {
  coordinate,  ///< of a sample, or its place in its stratum
  stratum,     ///< permutation of a Latin hypercube
  scramble,    ///< flips of digits of a Sobol point
  tail,        ///< digits of a Sobol point behind its 32nd
  mesh_error   ///< the random field that moves a mesh
};

/// 64 random bits that depend on these numbers alone.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, std::uint32_t dimension, DrawPurpose purpose);

/// The middle of one of 2^52 equal parts of (0, 1): never 0 or 1.
double open_unit(std::uint64_t bits);

}  // namespace genu
