#include "genu/results/packed_numbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

std::string base64(const unsigned char* bytes, std::size_t count) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3) {
    const std::size_t here = std::min<std::size_t>(3, count - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < here ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= here ? kLetters[word >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

template <typename Number>
std::string bytes_of(const std::vector<Number>& values) {
  return base64(reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(Number));
}

}  // namespace

std::string packed_text(const std::string& text) {
  return base64(reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

std::string packed(const std::vector<float>& values) { return bytes_of(values); }
std::string packed(const std::vector<std::uint16_t>& values) { return bytes_of(values); }
std::string packed(const std::vector<std::uint32_t>& values) { return bytes_of(values); }

std::string packed_floats(const std::vector<double>& values) {
  std::vector<float> floats;
  floats.reserve(values.size());
  for (const double v : values)
    floats.push_back(std::isfinite(v) ? static_cast<float>(v) : std::numeric_limits<float>::quiet_NaN());
  return packed(floats);
}

PackedPoints packed_points(const std::vector<Vec3>& points) {
  constexpr double kSteps = 65535;
  PackedPoints out;
  if (points.empty()) return out;
  Vec3 high = out.low = points.front();
  for (const Vec3& p : points) {
    out.low = out.low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  out.step = (high - out.low).maxCoeff() / kSteps;
  std::vector<std::uint16_t> integers;
  integers.reserve(3 * points.size());
  for (const Vec3& p : points)
    for (Eigen::Index i = 0; i < 3; ++i)
      integers.push_back(out.step > 0 ? static_cast<std::uint16_t>(std::lround((p[i] - out.low[i]) / out.step)) : 0);
  out.integers = packed(integers);
  return out;
}

}  // namespace genu
