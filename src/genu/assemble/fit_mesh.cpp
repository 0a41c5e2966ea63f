#include "genu/assemble/fit_mesh.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/mesh_part.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/scene/region_text.h"
#include "genu/scene/surface_writer.h"
#include "genu/shape_fit/fit_zone.h"

namespace genu {
namespace {

/// A name that a scene allows, from the name of a file.
std::string name_from(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0 || name.front() == '-')
    name = "surface_" + name;
  return name;
}

/// The mesh in metres, and the file's unit: where it is not given, the one of mm and m that makes it the size of a
/// joint.
std::optional<Mesh> read(const FitMeshRequest& request, double& unit, Diagnostics& out) {
  unit = request.file_unit.value_or(unit);
  auto mesh = request.file_unit ? read_mesh(request.file, unit, out) : read_mesh_of_some_unit(request.file, unit, out);
  if (!mesh) return std::nullopt;
  check_scale(check_mesh(*mesh), request.file, length_unit_name(unit), out);
  if (out.has_errors()) return std::nullopt;
  make_winding_consistent(*mesh, mesh_edges(*mesh));
  return mesh;
}

std::function<bool(const Vec3&)> within(const std::vector<RegionDef::Condition>& conditions) {
  return [region = RegionDef{{}, conditions}](const Vec3& p) { return region.contains(p); };
}

/// A region is one surface: its largest sheet.
void keep_largest(std::vector<Zone>& zones) {
  const auto largest = std::max_element(zones.begin(), zones.end(),
                                        [](const Zone& a, const Zone& b) { return area_of(a.mesh) < area_of(b.mesh); });
  if (largest != zones.end()) zones = {*largest};
}

}  // namespace

std::vector<NamedFit> fit_mesh(const FitMeshRequest& request, Diagnostics& out, double* file_unit) {
  double unit = 1;
  const auto mesh = read(request, unit, out);
  if (file_unit != nullptr) *file_unit = unit;
  std::vector<ZoneOptions> wanted;
  for (const std::string& text : request.regions) {
    const auto conditions = parse_region(text, unit);
    if (!conditions)
      out.error(Code::wrong_form, "region \"" + text + "\"", kRegionForm);
    else
      wanted.push_back({request.facing, within(*conditions), false});
  }
  if (wanted.empty()) wanted.push_back({request.facing, {}, !request.like && request.cylindrical.value_or(true)});
  if (!mesh || out.has_errors()) return {};

  std::vector<NamedFit> fits;
  for (const ZoneOptions& options : wanted) {
    std::vector<Zone> zones = find_zones(*mesh, options, request.file, out);
    if (options.within) keep_largest(zones);
    for (const Zone& zone : zones) {
      SurfaceFitOptions how;
      how.cylindrical = request.cylindrical;
      how.degree = request.degree;
      how.axis = zone.axis;
      how.one_face = zone.one_face;
      how.like = request.like;
      auto fit = fit_surface(zone.mesh, how, request.file, out);
      if (fit) fits.push_back({{}, request.body.empty() ? "body" : request.body, request.file, std::move(*fit), {}});
    }
  }
  if (out.has_errors()) return {};
  const std::string name = request.name.empty() ? name_from(request.file) : request.name;
  for (std::size_t k = 0; k < fits.size(); ++k)
    fits[k].name = fits.size() == 1 ? name : fmt::format("{}_{}", name, k + 1);
  return fits;
}

std::string surface_file(const std::vector<NamedFit>& fits, const std::string& title) {
  return fmt::format(
             "# Polynomial surfaces, written by genu fit: tables to copy into a scene of these units.\n"
             "format = 1\ntitle = {}\nunits = {{ length = \"mm\", angle = \"deg\" }}\n\n",
             toml_string(title)) +
         surface_tables(fits, units::kMillimetre, units::kDegree);
}

}  // namespace genu
