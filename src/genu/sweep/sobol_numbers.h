// Direction numbers of Sobol's sequence by Joe and Kuo (2008, "Constructing Sobol sequences with better two-dimensional
// projections", their file new-joe-kuo-6).
#pragma once

#include <array>
#include <cstdint>

namespace genu {

inline constexpr std::uint32_t kMaxSobolDimensions = 256;

/// Of a dimension < kMaxSobolDimensions: 32 direction numbers with their first digit in the highest bit. The first
/// dimension is van der Corput's sequence.
std::array<std::uint32_t, 32> sobol_directions(std::uint32_t dimension);

}  // namespace genu
