#include "genu/geometry/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "genu/geometry/mesh_file_check.h"
#include "genu/geometry/mesh_formats.h"

namespace genu {
namespace {

std::string lower_extension(const std::string& path) {
  std::string s = std::filesystem::path(path).extension().string();
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// Empty text where all is well.
std::string import(const std::string& path, Mesh& mesh) {
  const std::string extension = lower_extension(path);
  std::string problem;
  if (extension == ".stl")
    problem = read_stl(path, mesh);
  else if (extension == ".off")
    problem = read_off(path, mesh);
  else if (extension == ".vtp")
    problem = read_vtp(path, mesh);
  else if (problem = check_numbers(path); problem.empty())
    problem = read_by_assimp(path, mesh);
  for (std::size_t v = 0; problem.empty() && v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite())
      problem = fmt::format("has a coordinate that is not a finite number (vertex {}): repair or export the mesh again",
                            v + 1);
  return problem;
}

/// What single precision leaves of the coordinates (file units): vertices lie on a grid that wide.
double rounding_of(const Mesh& mesh) {
  double largest = 0;
  for (const Vec3& v : mesh.vertices) {
    largest = std::max(largest, v.cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k)
      if (v[k] != static_cast<double>(static_cast<float>(v[k]))) return 0;
  }
  const auto most = static_cast<float>(largest);
  return static_cast<double>(std::nextafter(most, std::numeric_limits<float>::infinity())) - static_cast<double>(most);
}

void warn(const std::string& path, const std::string& what, Diagnostics& out) {
  out.add({.severity = Diagnostic::Severity::warning, .file = path, .key = {}, .found = {}, .rule = what});
}

/// A surface far from its origin has no room left for its shape in seven digits.
void warn_rounding(const std::string& path, const Mesh& mesh, double metres_per_unit, double rounding,
                   Diagnostics& out) {
  constexpr double kCoarse = 2e-6;  // m: coarser steps show in curvature
  if (!(rounding * metres_per_unit > kCoarse)) return;
  warn(path,
       fmt::format("has single-precision coordinates {:.3g} mm from its origin: they are rounded to {:.2g} mm, which "
                   "curvature and contact feel; export it again about an origin near the joint",
                   1e3 * metres_per_unit * mesh.vertices.front().norm(), 1e3 * metres_per_unit * rounding),
       out);
}

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, double metres_per_unit, Diagnostics& out, MeshFileFacts* facts) {
  const MeshFileCheck check = check_mesh_file(path);
  if (!check.problem.empty()) {
    out.error(path, check.problem);
    return std::nullopt;
  }
  Mesh mesh;
  std::string problem = import(path, mesh);
  if (problem.empty() && mesh.triangles.size() < check.least_triangles) {
    problem = "promises " + std::to_string(check.least_triangles) + " faces but holds " +
              std::to_string(mesh.triangles.size()) + " triangles: it is truncated; copy or export it again";
  }
  if (problem.empty() && mesh.empty()) problem = "has no triangles: export the surface as a triangle mesh";
  MeshFileFacts found{mesh.vertices.size(), mesh.triangles.size(), {}, metres_per_unit * rounding_of(mesh)};
  const WeldReport report = found.weld = problem.empty() ? weld(mesh, weld_tolerance(mesh)) : WeldReport{};
  if (problem.empty() && mesh.empty()) {
    problem = "has triangles without extent only: all its points are one; check the export's number format";
  }
  if (!problem.empty()) {
    out.error(path, problem);
    return std::nullopt;
  }
  if (report.degenerate + report.duplicate > 0)
    warn(path,
         fmt::format("dropped {} triangles without extent and {} repeated ones", report.degenerate, report.duplicate),
         out);
  warn_rounding(path, mesh, metres_per_unit, found.rounding / metres_per_unit, out);
  if (facts != nullptr) *facts = found;
  for (Vec3& v : mesh.vertices) v *= metres_per_unit;
  return mesh;
}

}  // namespace genu
