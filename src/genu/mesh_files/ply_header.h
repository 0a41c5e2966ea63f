// What a PLY file says of itself before its numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace genu {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a number in a binary file.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// The place of a property among the others; -1 where it is none of them.
  int index(std::string_view property) const;
};

struct PlyHeader {
  bool ascii = false, big_endian = false;
  std::vector<PlyElement> elements;
  std::size_t lines = 0;  ///< of the header
  std::size_t size = 0;   ///< bytes, with the end of its last line
};

/// Returns what is wrong, with the line, else an empty text.
[[nodiscard]] std::string read_ply_header(std::string_view text, PlyHeader& header);

}  // namespace genu
