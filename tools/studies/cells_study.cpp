#include "studies/cells_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/assemble/build_surface.h"
#include "genu/core/units.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/scene/reader.h"

namespace genu::studies {
namespace {

constexpr double kEdges[] = {0.5, 1, 2, 4, 8};  // mm
constexpr double kFemurEdge = 1;                // mm
constexpr std::size_t kEveryThird = 3;          // rows, of 10 deg

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return area;
}

/// p A / d of a cell: the confined modulus over the thickness, times its area; N/mm for mm^2.
double spring_of(const LayerDef& layer, double area) {
  const double nu = layer.poisson;
  const double modulus = (1 - nu) * layer.modulus / ((1 + nu) * (1 - 2 * nu));
  return 1e-9 * modulus / layer.thickness * area;
}

std::optional<CellSize> solve_size(Scene scene, const Scene& formulas, double edge, Diagnostics& out) {
  CellSize size;
  size.edge = edge;
  auto meshes = std::make_shared<MeshLibrary>();
  double area = 0;
  for (const SurfaceDef& formula : formulas.surfaces) {
    const auto def = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                  [&](const SurfaceDef& s) { return s.name == formula.name; });
    if (def == scene.surfaces.end()) continue;
    const auto surface = within_patch(make_analytic_surface(formula), formula);
    const bool plateau = formula.name.starts_with("tibia");
    Mesh mesh = surface->triangles(1e-3 * (plateau ? edge : kFemurEdge), formula.placement.p, 0.05);
    if (plateau) size.cells += static_cast<int>(mesh.triangles.size()), area += 1e6 * area_of(mesh);
    for (Vec3& v : mesh.vertices) v *= to::kMillimetre;
    meshes->put(def->file.text(), mesh);
  }
  size.area = area / size.cells;
  size.spring = spring_of(scene.layers.at(0), size.area);
  const auto solved = solve_scene(scene, out, meshes);
  if (!solved) return std::nullopt;
  size.flexion = solved->column("knee.flexion_deg");
  size.medial = solved->column("medial.force_N");
  size.lateral = solved->column("lateral.force_N");
  size.medial_area = solved->column("medial.area_mm2");
  size.lateral_area = solved->column("lateral.area_mm2");
  size.pressure = solved->column("medial.max_pressure_MPa");
  const auto other = solved->column("lateral.max_pressure_MPa");
  for (std::size_t k = 0; k < other.size(); ++k) size.pressure[k] = std::max(size.pressure[k], other[k]);
  size.all_stable = solved->all_stable();
  return size;
}

}  // namespace

std::vector<CellSize> solve_cells(const std::string& folder, Diagnostics& out) {
  std::vector<CellSize> sizes;
  const auto cells = read_scene(folder + "/scene-cells.toml", out), formulas = read_scene(folder + "/scene.toml", out);
  if (!cells || !formulas) return sizes;
  for (const double edge : kEdges)
    if (auto size = solve_size(*cells, *formulas, edge, out)) sizes.push_back(std::move(*size));
  return sizes;
}

Files cells_files(const std::vector<CellSize>& sizes) {
  std::string text =
      "# Cells of cartilage and their size\n\n"
      "Written by `tools/figures`; do not edit. `scene-cells.toml` with the plateaus cut into cells of other sizes, "
      "against a "
      "femur of\n1 mm: 100 N of compression, flexion from 0 to 90 deg. Each cell is a spring k = p A / d; the first "
      "line is nearest to a layer\nwithout cells.\n\n"
      "| cells | mean area mm^2 | its spring N/mm | flexion deg | medial N | lateral N | medial mm^2 | lateral mm^2 | "
      "largest pressure MPa |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const CellSize& s : sizes) {
    if (!s.all_stable) continue;
    for (std::size_t k = 0; k < s.flexion.size(); k += kEveryThird)
      text += fmt::format("| {} | {:.2f} | {:.2f} | {:.0f} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {:.2f} |\n", s.cells,
                          s.area, s.spring, std::round(s.flexion[k]) + 0.0, s.medial[k], s.lateral[k], s.medial_area[k],
                          s.lateral_area[k], s.pressure[k]);
  }
  return {{"CELLS.md", text}};
}

}  // namespace genu::studies
