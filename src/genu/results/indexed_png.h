// Pictures of few colours as PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace genu {

struct IndexedPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;                  ///< colours by index, row after row from the top
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< red, green, blue; at most 256. The first is transparent
};

/// The bytes of a PNG file (ISO/IEC 15948) with a palette.
std::string indexed_png(const IndexedPicture& picture);

}  // namespace genu
