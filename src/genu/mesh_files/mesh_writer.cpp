#include "genu/mesh_files/mesh_writer.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/mesh_files/writer_parts.h"

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "the PLY written here is little-endian: swap bytes first");

std::string ending_of(const std::string& path) {
  std::string s = std::filesystem::path(path).extension().string();
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

}  // namespace

std::string ply_bytes(const Mesh& mesh, double metres_per_unit, const std::string& title) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      one_line(title), mesh.vertices.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) append_bytes(bytes, v[k] / metres_per_unit);
  for (const auto& t : mesh.triangles) {
    append_bytes(bytes, std::uint8_t{3});
    for (const int v : t) append_bytes(bytes, static_cast<std::int32_t>(v));
  }
  return bytes;
}

std::string write_ply(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  return write_file_atomically(path, ply_bytes(mesh, metres_per_unit, title));
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

std::string why_not_writable(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string ending = ending_of(path);
  if (ending != ".stl" && ending != ".ply" && ending != ".obj")
    return path + ": the name of a mesh file ends in .stl, .ply or .obj";
  std::error_code code;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, code)) return path + ": cannot be written: there is no such folder";
  const fs::file_status status = fs::symlink_status(path, code);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return path + ": is no regular file and will not be replaced: name another";
  return {};
}

bool has_title(const std::string& path, const std::string& start) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;  // a pipe would be waited for
  std::ifstream in(path, std::ios::binary);
  std::string bytes(512, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  for (const char* before : {"", "solid ", "# ", "ply\nformat binary_little_endian 1.0\ncomment "})
    if (bytes.starts_with(before + start)) return true;
  return false;
}

std::string write_mesh(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  if (std::string why = why_not_writable(path); !why.empty()) return why;
  const std::string ending = ending_of(path);
  if (ending == ".ply") return write_ply(mesh, path, metres_per_unit, title);
  if (ending == ".obj") return write_obj(mesh, path, metres_per_unit, title);
  return write_stl(mesh, path, metres_per_unit, title);
}

}  // namespace genu
