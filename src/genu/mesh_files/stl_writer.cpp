#include "genu/mesh_files/stl_writer.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "genu/core/atomic_output.h"
#include "genu/mesh_files/tolerances.h"
#include "genu/mesh_files/writer_parts.h"

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian: swap bytes here first");

void append_floats(std::string& bytes, const Vec3& v) {
  for (int k = 0; k < 3; ++k) append_bytes(bytes, static_cast<float>(v[k]));
}

std::string stl_bytes(const Mesh& mesh, double metres_per_unit, const std::string& title) {
  constexpr std::size_t kStlTitleBytes = 80;
  // A title that starts with "solid" would pass for ASCII.
  std::string bytes = title.compare(0, 5, "solid") == 0 ? "binary " + title : title;
  bytes.resize(kStlTitleBytes - 1);
  bytes.push_back('\0');
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  bytes.reserve(bytes.size() + 50 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](int k) -> const Vec3& {
      return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
    };
    append_floats(bytes, Vec3((corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized()));
    for (int k = 0; k < 3; ++k) append_floats(bytes, Vec3(corner(k) / metres_per_unit));
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// Every digit that brings back the same doubles.
std::string stl_text(const Mesh& mesh, double metres_per_unit, const std::string& title) {
  std::string text = "solid " + title + "\n";
  for (const auto& t : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : t) {
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(v)] / metres_per_unit;
      fmt::format_to(std::back_inserter(text), "vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid " + title + "\n";
}

double shortest_edge(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[k])],
                 &b = mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
      shortest = std::min(shortest, (b - a).norm());
    }
  return shortest;
}

}  // namespace

double binary_stl_rounding(const Mesh& mesh, double metres_per_unit) {
  double worst = 0;
  for (const Vec3& v : mesh.vertices) {
    const Vec3 p = v / metres_per_unit;
    worst = std::max(worst, (p - p.cast<float>().cast<double>()).norm());
  }
  return metres_per_unit * worst;
}

bool fits_binary_stl(const Mesh& mesh, double metres_per_unit) {
  return binary_stl_rounding(mesh, metres_per_unit) <=
         std::min(kUnseenRounding, kUnseenEdgeShare * shortest_edge(mesh));
}

std::string write_stl(const Mesh& mesh, const std::string& path, double metres_per_unit, const std::string& title) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) return path + ": too many triangles for STL";
  const std::string line = one_line(title);
  return write_file_atomically(path, fits_binary_stl(mesh, metres_per_unit) ? stl_bytes(mesh, metres_per_unit, line)
                                                                            : stl_text(mesh, metres_per_unit, line));
}

}  // namespace genu
