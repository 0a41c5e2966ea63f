#include "genu/geometry/stl_writer.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <Eigen/Geometry>

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian: swap bytes here first");

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void append(std::string& bytes, const Vec3& v) {
  for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(v[k]));
}

std::string stl_bytes(const Mesh& mesh, double metres_per_unit, const std::string& title) {
  constexpr std::size_t kTitle = 80;
  // A title that starts with "solid" would pass for ASCII.
  std::string bytes = title.compare(0, 5, "solid") == 0 ? "binary " + title : title;
  bytes.resize(kTitle - 1);
  bytes.push_back('\0');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  bytes.reserve(bytes.size() + 50 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](int k) -> const Vec3& {
      return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
    };
    append(bytes, Vec3((corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized()));
    for (int k = 0; k < 3; ++k) append(bytes, Vec3(corner(k) / metres_per_unit));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace

std::string write_stl(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) return path + ": too many triangles for STL";
  const std::string bytes = stl_bytes(mesh, metres_per_unit, title);
  const std::string unfinished = path + ".part";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  if (!out) return unfinished + ": cannot be opened for writing";
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();  // a full disk may show here only
  std::error_code failure;
  if (!out) {
    std::filesystem::remove(unfinished, failure);
    return unfinished + ": cannot be written to the end (is the disk full?)";
  }
  std::filesystem::rename(unfinished, path, failure);
  if (!failure) return {};
  const std::string reason = failure.message();
  std::filesystem::remove(unfinished, failure);
  return path + ": cannot be replaced (" + reason + ")";
}

}  // namespace genu
