#include "genu/mesh/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "genu/core/length_units.h"
#include "genu/mesh/tolerances.h"

namespace genu {
namespace {

std::array<double, 5> edge_quantiles(const Mesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const MeshEdge& e : edges) lengths.push_back((mesh.vertices[at(e.v[1])] - mesh.vertices[at(e.v[0])]).norm());
  std::sort(lengths.begin(), lengths.end());
  std::array<double, 5> quantiles{};
  if (lengths.empty()) return quantiles;
  constexpr std::array<double, 5> kShares{0, 0.05, 0.5, 0.95, 1};
  for (std::size_t k = 0; k < kShares.size(); ++k) {
    quantiles[k] = lengths[static_cast<std::size_t>(std::lround(kShares[k] * static_cast<double>(lengths.size() - 1)))];
  }
  return quantiles;
}

// Degenerate: the height over the longest side is less than float32 tells apart at these coordinates.
void count_shapes(const Mesh& mesh, MeshReport& report) {
  for (const auto& t : mesh.triangles) {
    std::array<double, 3> side{};
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      side[k] = (mesh.vertices[at(t[(k + 2) % 3])] - mesh.vertices[at(t[(k + 1) % 3])]).norm();
      largest = std::max(largest, mesh.vertices[at(t[k])].cwiseAbs().maxCoeff());
    }
    std::sort(side.begin(), side.end());
    const Vec3& p = mesh.vertices[at(t[0])];
    const double twice_area = (mesh.vertices[at(t[1])] - p).cross(mesh.vertices[at(t[2])] - p).norm();
    if (twice_area <= kDegenerateAreaShare * largest * side[2]) {
      ++report.degenerate;
    } else if (twice_area < std::sin(kSliverAngle) * side[1] * side[2]) {  // the smallest angle faces the shortest side
      ++report.slivers;
    }
  }
}

}  // namespace

MeshReport check_mesh(const Mesh& mesh) {
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  MeshReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  report.components = connected_components(mesh).count;
  report.boundary_loops = boundary_loops(mesh, edges).size();
  for (const MeshEdge& e : edges) {
    report.boundary_edges += e.count == 1 ? 1 : 0;
    report.non_manifold_edges += e.count > 2 ? 1 : 0;
  }
  Mesh wound = mesh;
  const WindingReport winding = make_winding_consistent(wound, edges);
  report.flipped = winding.flipped;
  report.orientable = winding.orientable;
  count_shapes(mesh, report);
  report.edge_length = edge_quantiles(mesh, edges);
  report.box = bounding_box(mesh);
  return report;
}

std::string guess_unit(double diagonal) {
  for (const auto& [name, metres] : kLengthUnits)
    if (diagonal * metres >= kLikelyMinDiagonal && diagonal * metres <= kLikelyMaxDiagonal) return name;
  return {};
}

void check_scale(const MeshReport& report, const std::string& file, const std::string& unit, Diagnostics& out) {
  const double size = report.box.diagonal();
  if (size >= kLikelyMinDiagonal && size <= kLikelyMaxDiagonal) return;
  const bool refused = !(size >= kMinDiagonal && size <= kMaxDiagonal);
  std::string rule =
      fmt::format("read in {}, the surface is {:.3g} mm across, but a knee's are between {:.0f} and {:.0f} mm", unit,
                  size * 1e3, kLikelyMinDiagonal * 1e3, kLikelyMaxDiagonal * 1e3);
  const double in_file = size / metres_in(unit).value_or(1);
  if (const std::string meant = guess_unit(in_file); !meant.empty()) {
    rule += fmt::format(": in {} it would be {:.3g} mm; write units = \"{}\"", meant,
                        in_file * metres_in(meant).value_or(1) * 1e3, meant);
  } else if (refused) {
    rule += ": check the file's units";
  }
  refused ? out.error(Code::mesh_unusable, file, std::move(rule))
          : out.warning(Code::mesh_unusable, file, std::move(rule));
}

}  // namespace genu
