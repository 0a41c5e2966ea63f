// Numbers as short text inside JSON: the bytes of an array, little-endian, in base64.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "genu/core/types.h"

namespace genu {

/// Base64 (RFC 4648, with padding) of what the array holds.
std::string packed(const std::vector<float>& values);
std::string packed(const std::vector<std::uint16_t>& values);
std::string packed(const std::vector<std::uint32_t>& values);

/// Bytes of a text, for a data: address.
std::string packed_text(const std::string& text);

/// Single precision: what is not a number stays none.
std::string packed_floats(const std::vector<double>& values);

/// Points on a grid of 65536 steps a side over their box: low + step * integer, at most half a step off.
struct PackedPoints {
  Vec3 low = Vec3::Zero();
  double step = 0;  ///< of all three axes
  std::string integers;
};
PackedPoints packed_points(const std::vector<Vec3>& points);

}  // namespace genu
