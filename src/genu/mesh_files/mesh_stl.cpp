#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian: swap bytes here first");

constexpr std::size_t kBinaryHeader = 84, kTriangle = 50;  // bytes of a binary STL

/// `triangles`: the bytes after the header.
void read_binary(std::string_view triangles, std::size_t count, Mesh& mesh) {
  mesh.vertices.resize(3 * count);
  mesh.triangles.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 9> corners;  // after the normal, which the corners' order repeats
    std::memcpy(corners.data(), triangles.data() + t * kTriangle + 12, sizeof corners);
    for (std::size_t k = 0; k < 3; ++k)
      mesh.vertices[3 * t + k] = Vec3(corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]);
    const int i = static_cast<int>(3 * t);
    mesh.triangles[t] = {i, i + 1, i + 2};
  }
}

bool same(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// Reads an ASCII STL word by word, so that whatever is not one is named with its line.
class AsciiStl {
 public:
  AsciiStl(std::string_view text, Mesh& mesh) : words_(without_mark(text)), mesh_(mesh) {}

  std::string read() {
    if (!expect("solid")) return problem_;
    words_.skip_line();  // the name may be anything
    for (std::string_view word = words_.next(); problem_.empty(); word = words_.next()) {
      if (same(word, "facet")) {
        read_facet();
      } else if (same(word, "endsolid")) {
        words_.skip_line();
        if (words_.peek().empty()) return {};
        if (expect("solid")) words_.skip_line();  // several solids are one surface
      } else {
        found(word, "\"facet\" or \"endsolid\"");
      }
    }
    return problem_;
  }

 private:
  /// Some editors mark UTF-8 by three bytes at the start.
  static std::string_view without_mark(std::string_view text) {
    return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  }

  void found(std::string_view word, const std::string& wanted) {
    if (!problem_.empty()) return;
    problem_ = word.empty() ? "ends where " + wanted + " should stand: it is truncated; copy or export it again"
                            : "has " + in_quotes(word) + " in line " + std::to_string(words_.line()) + " where " +
                                  wanted + " should stand: it is damaged or no STL; export it again";
  }

  bool expect(std::string_view wanted) {
    const std::string_view word = words_.next();
    if (!same(word, wanted)) found(word, "\"" + std::string(wanted) + "\"");
    return problem_.empty();
  }

  bool read_numbers(Vec3& out) {
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words_.next();
      if (!TextWords::number(word, out[k])) found(word, "a number");
    }
    return problem_.empty();
  }

  bool read_corner(Vec3& out) {
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words_.next();
      if (!TextWords::number(word, out[k]))
        found(word, "a number");
      else if (!is_coordinate(out[k]))
        found(word, kCoordinate);
    }
    return problem_.empty();
  }

  void read_facet() {
    Vec3 normal;  // not used: the corners' order says it, and exporters write nonsense, "nan" too
    if (!expect("normal") || !read_numbers(normal) || !expect("outer") || !expect("loop")) return;
    const int first = static_cast<int>(mesh_.vertices.size());
    for (int k = 0; k < 3; ++k) {
      Vec3 p;
      if (!expect("vertex") || !read_corner(p)) return;
      mesh_.vertices.push_back(p);
    }
    mesh_.triangles.push_back({first, first + 1, first + 2});
    if (expect("endloop")) expect("endfacet");
  }

  TextWords words_;
  Mesh& mesh_;
  std::string problem_;
};

}  // namespace

std::string read_stl(std::string_view bytes, Mesh& mesh) {
  if (bytes.size() < kBinaryHeader) return AsciiStl(bytes, mesh).read();
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kBinaryHeader - sizeof count, sizeof count);
  if (bytes.size() != kBinaryHeader + kTriangle * count) return AsciiStl(bytes, mesh).read();
  if (count > kMaxMeshCount) return "has more triangles than can be counted: reduce the mesh";
  read_binary(bytes.substr(kBinaryHeader), count, mesh);
  return {};
}

}  // namespace genu
