#include "genu/mesh_files/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "genu/mesh/coordinate_step.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_file_check.h"
#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

std::string lower_extension(const std::string& path) {
  std::string s = std::filesystem::path(path).extension().string();
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// Binary files have no lines to name: the number of the vertex stands for them.
std::string check_coordinates(const Mesh& mesh, bool stl) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    if (is_coordinate(p.x()) && is_coordinate(p.y()) && is_coordinate(p.z())) continue;
    return fmt::format("has a coordinate that is {} ({} {}, [{:.4g}, {:.4g}, {:.4g}]): repair or export the mesh again",
                       p.allFinite() ? "beyond 1e9 of its units" : "not a finite number", stl ? "triangle" : "vertex",
                       (stl ? v / 3 : v) + 1, p.x(), p.y(), p.z());
  }
  return {};
}

/// Empty text where all is well.
std::string import(const std::string& path, Mesh& mesh) {
  const std::string extension = lower_extension(path);
  const bool stl = extension == ".stl";
  const std::string problem = stl                   ? read_stl(path, mesh)
                              : extension == ".off" ? read_off(path, mesh)
                              : extension == ".vtp" ? read_vtp(path, mesh)
                              : extension == ".ply" ? read_ply(path, mesh)
                              : extension == ".obj" ? read_obj(path, mesh)
                                                    : read_by_assimp(path, mesh);
  return problem.empty() ? check_coordinates(mesh, stl) : problem;
}

/// Why no triangle is left of a mesh whose vertices were welded within `tolerance`.
std::string why_nothing_is_left(const Mesh& before, double tolerance) {
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Vec3& v : before.vertices) values.push_back(v[k]);
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    middle[k] = values[values.size() / 2];
  }
  std::size_t farthest = 0;
  for (std::size_t v = 0; v < before.vertices.size(); ++v)
    if ((before.vertices[v] - middle).norm() > (before.vertices[farthest] - middle).norm()) farthest = v;
  const Vec3& p = before.vertices[farthest];
  if (!((p - middle).norm() > tolerance))
    return "has triangles without extent only: all its points are one; check the export's number format";
  return fmt::format(
      "has no triangle larger than {:.3g}, which is nothing beside the distance of its vertex {} at "
      "[{:.4g}, {:.4g}, {:.4g}] or of its origin: is that vertex damaged, or the mesh far from its origin?",
      tolerance, farthest + 1, p.x(), p.y(), p.z());
}

void warn(const std::string& path, const std::string& what, Diagnostics& out) {
  out.add({.severity = Diagnostic::Severity::warning, .file = path, .key = {}, .found = {}, .rule = what});
}

/// A surface far from its origin has no room left for its shape in seven digits.
void warn_rounding(const std::string& path, const Mesh& mesh, double metres_per_unit, const MeshFileFacts& facts,
                   Diagnostics& out) {
  if (!facts.single || !(facts.rounding > kCoarseCoordinateStep)) return;
  double farthest = 0;
  for (const Vec3& v : mesh.vertices) farthest = std::max(farthest, v.norm());
  warn(path,
       fmt::format("has single-precision coordinates {:.3g} mm from its origin: they are rounded to {:.2g} mm, which "
                   "curvature and contact feel; export it again about an origin near the joint",
                   1e3 * metres_per_unit * farthest, 1e3 * facts.rounding),
       out);
}

/// The mesh in the file's unit, with its facts.
std::optional<Mesh> read_in_file_unit(const std::string& path, Diagnostics& out, MeshFileFacts& facts) {
  const MeshFileCheck check = check_mesh_file(path);
  if (!check.problem.empty()) {
    out.error(path, check.problem);
    return std::nullopt;
  }
  Mesh mesh;
  std::string problem = import(path, mesh);
  if (problem.empty() && mesh.empty()) problem = "has no triangles: export the surface as a triangle mesh";
  if (problem.empty()) {
    facts.vertices = mesh.vertices.size();
    facts.triangles = mesh.triangles.size();
    const CoordinateStep written = coordinate_step(mesh);
    const bool decimal = written.decimal > 0 && mesh.vertices.size() >= kMinDecimalVertices;
    facts.rounding = decimal ? written.decimal : written.single;
    facts.single = !decimal && written.single > 0;
    const double tolerance = weld_tolerance(mesh);
    facts.weld = weld(mesh, tolerance);
    if (mesh.empty()) {
      import(path, mesh = {});
      problem = why_nothing_is_left(mesh, tolerance);
    }
  }
  if (!problem.empty()) {
    out.error(path, problem);
    return std::nullopt;
  }
  return mesh;
}

/// What is left to do once the unit is known.
Mesh in_metres(const std::string& path, Mesh mesh, double metres_per_unit, MeshFileFacts& facts, Diagnostics& out) {
  const WeldReport& report = facts.weld;
  if (report.degenerate + report.duplicate > 0)
    warn(path,
         fmt::format("dropped {} triangles without extent and {} repeated ones", report.degenerate, report.duplicate),
         out);
  facts.rounding *= metres_per_unit;
  warn_rounding(path, mesh, metres_per_unit, facts, out);
  for (Vec3& v : mesh.vertices) v *= metres_per_unit;
  return mesh;
}

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, double metres_per_unit, Diagnostics& out, MeshFileFacts* facts) {
  MeshFileFacts unasked;
  MeshFileFacts& found = facts != nullptr ? *facts : unasked;
  auto mesh = read_in_file_unit(path, out, found);
  if (!mesh) return std::nullopt;
  return in_metres(path, std::move(*mesh), metres_per_unit, found, out);
}

std::optional<Mesh> read_mesh_of_some_unit(const std::string& path, double& metres_per_unit, Diagnostics& out,
                                           MeshFileFacts* facts) {
  MeshFileFacts unasked;
  MeshFileFacts& found = facts != nullptr ? *facts : unasked;
  auto mesh = read_in_file_unit(path, out, found);
  if (!mesh) return std::nullopt;
  metres_per_unit = guess_unit(bounding_box(*mesh).diagonal()) == "m" ? 1.0 : 1e-3;
  return in_metres(path, std::move(*mesh), metres_per_unit, found, out);
}

}  // namespace genu
