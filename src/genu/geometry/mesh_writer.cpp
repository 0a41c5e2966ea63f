#include "genu/geometry/mesh_writer.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/geometry/stl_writer.h"

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "the PLY written here is little-endian: swap bytes first");

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// One line, whatever is in the title.
std::string one_line(std::string title) {
  for (char& c : title)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return title;
}

}  // namespace

std::string write_ply(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      one_line(title), mesh.vertices.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) append(bytes, v[k] / metres_per_unit);
  for (const auto& t : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const int v : t) append(bytes, static_cast<std::int32_t>(v));
  }
  return write_file_atomically(path, bytes);
}

std::string write_obj(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  std::string text = fmt::format("# {}\n", one_line(title));
  for (const Vec3& v : mesh.vertices) {
    const Vec3 p = v / metres_per_unit;
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x(), p.y(), p.z());
  }
  for (const auto& t : mesh.triangles)
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return write_file_atomically(path, text);
}

std::string write_mesh(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  if (path.ends_with(".ply")) return write_ply(mesh, path, metres_per_unit, title);
  if (path.ends_with(".obj")) return write_obj(mesh, path, metres_per_unit, title);
  if (path.ends_with(".stl")) return write_stl(mesh, path, metres_per_unit, title);
  return path + ": the name of a mesh file ends in .stl, .ply or .obj";
}

}  // namespace genu
