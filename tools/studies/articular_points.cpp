#include "studies/articular_points.h"

#include <fmt/format.h>

#include "genu/mesh/mesh_coarsen.h"
#include "genu/mesh_care/noise_field.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/mesh_writer.h"

namespace genu::studies {
namespace {

struct Cartilage {
  const char* name;
  double longer_edges;  // than those of the measured mesh
  std::uint64_t seed;
};
constexpr Cartilage kCartilages[] = {{"femur", 3.2, 1}, {"tibia", 2.2, 2}};

}  // namespace

Files articular_points(const std::string& data, Diagnostics& out) {
  Files files;
  for (const Cartilage& c : kCartilages) {
    const auto measured = read_mesh(fmt::format("{}/ACLC01-R-{}-cart.stl", data, c.name), 1.0, out);
    if (!measured) return {};
    const Mesh points = perturbed(coarsened(*measured, c.longer_edges), {kPointNoise, 0}, c.seed);
    const std::string title = fmt::format(
        "points of the {}'s cartilage of Lenhart et al. 2015 (opensim-jam, Apache-2.0), {:.1f} mm of noise added",
        c.name, 1e3 * kPointNoise);
    files.emplace_back(fmt::format("points-{}.ply", c.name), ply_bytes(points, 1e-3, title));
  }
  return files;
}

}  // namespace genu::studies
