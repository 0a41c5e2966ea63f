#include "genu/results/indexed_png.h"

#include <zlib.h>

namespace genu {
namespace {

constexpr int kLevel = 6;  // of zlib: more takes longer and saves nearly nothing

std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
  return out;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(static_cast<std::uint32_t>(sum));
}

std::string compressed(const std::string& bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
            static_cast<uLong>(bytes.size()), level);
  out.resize(size);
  return out;
}

/// Rows of differences from the pixel to the left (filter 1) or above (2), or of the pixels themselves (0).
std::string filtered(const IndexedPicture& picture, int filter) {
  std::string out;
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(picture.height); ++row) {
    out += static_cast<char>(filter);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = row * width + x;
      int before = 0;
      if (filter == 1 && x > 0) before = picture.pixels[i - 1];
      if (filter == 2 && row > 0) before = picture.pixels[i - width];
      out += static_cast<char>(picture.pixels[i] - before);
    }
  }
  return out;
}

}  // namespace

std::string indexed_png(const IndexedPicture& picture) {
  std::string palette, data;
  for (const auto& colour : picture.colours)
    for (const std::uint8_t part : colour) palette += static_cast<char>(part);
  std::size_t least = 0;
  for (int filter = 0; filter < 3; ++filter) {  // the best of them, by a quick look
    const std::string tried = filtered(picture, filter);
    const std::size_t size = compressed(tried, Z_BEST_SPEED).size();
    if (!data.empty() && size >= least) continue;
    least = size;
    data = tried;
  }
  data = compressed(data, kLevel);
  const std::string header = big_endian(static_cast<std::uint32_t>(picture.width)) +
                             big_endian(static_cast<std::uint32_t>(picture.height)) + std::string("\x08\x03\0\0\0", 5);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("PLTE", palette) + chunk("tRNS", std::string(1, '\0')) +
         chunk("IDAT", data) + chunk("IEND", "");
}

}  // namespace genu
