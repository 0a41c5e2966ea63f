#include "genu/results/indexed_png.h"

#include <zlib.h>

#include <gtest/gtest.h>

namespace genu {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t k = 0; k < 4; ++k) out = out << 8 | static_cast<unsigned char>(bytes.at(at + k));
  return out;
}

/// The pixels of the one IDAT chunk, each filter undone as the standard has it; checks every checksum on the way.
std::vector<std::uint8_t> pixels_of(const std::string& png, std::size_t width, std::size_t height) {
  std::string raw((width + 1) * height, '\0');
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = number_at(png, at);
    const std::string type = png.substr(at + 4, 4);
    EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), static_cast<uInt>(size + 4)),
              number_at(png, at + 8 + size))
        << type;
    uLongf length = raw.size();
    if (type == "IDAT") {
      const auto* data = reinterpret_cast<const Bytef*>(png.data() + at + 8);
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(raw.data()), &length, data, static_cast<uLong>(size)), Z_OK);
    }
    at += 12 + size;
  }
  std::vector<std::uint8_t> out;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const char filter = raw[y * (width + 1)];
      int before = 0;
      if (filter == 1 && x > 0) before = out[y * width + x - 1];
      if (filter == 2 && y > 0) before = out[(y - 1) * width + x];
      out.push_back(static_cast<std::uint8_t>(raw[y * (width + 1) + 1 + x] + before));
    }
  return out;
}

TEST(IndexedPng, HoldsItsPixelsWhateverTheFilter) {
  const int width = 40, height = 30;
  for (const int kind : {0, 1, 2}) {
    IndexedPicture picture{width, height, {}, {{255, 255, 255}, {1, 2, 3}}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        picture.pixels.push_back(static_cast<std::uint8_t>(kind == 0   ? (x * 7 + y * 13) % 2
                                                           : kind == 1 ? 2 * x
                                                                       : 5 * y));
    const std::string png = indexed_png(picture);
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(number_at(png, 16), 40u);
    EXPECT_EQ(number_at(png, 20), 30u);
    EXPECT_EQ(pixels_of(png, 40, 30), picture.pixels) << kind;
  }
}

}  // namespace
}  // namespace genu
