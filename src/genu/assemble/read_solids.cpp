#include "genu/assemble/read_solids.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "genu/assemble/mesh_diagnostics.h"
#include "genu/assemble/tolerances.h"
#include "genu/core/length_units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh_care/mesh_flaws.h"

namespace genu {
namespace {

using Solid = BodyDef::Solid;

/// The first places of some kind of flaw, in words.
std::string places(const std::vector<Flaw>& flaws, Flaw::Kind kind, double unit) {
  constexpr int kSolidFlawsListed = 3;
  std::string text;
  int found = 0;
  for (const Flaw& flaw : flaws)
    if (flaw.kind == kind && ++found <= kSolidFlawsListed) text += (found > 1 ? "; " : "") + describe(flaw, unit);
  return found > kSolidFlawsListed ? text + fmt::format("; and {} more", found - kSolidFlawsListed) : text;
}

/// Whether the mesh has an inside. Self-intersections leave it one, but for what lies in two parts at once.
bool bounds_a_volume(const Mesh& mesh, const Solid& solid, Diagnostics& out) {
  Mesh cut = mesh;
  const std::vector<Flaw> flaws = cut_out_flaws(cut);
  const auto error = [&](const std::string& rule) { out.error(Code::mesh_unusable, solid.file.text(), rule); };
  bool good = true;
  for (const Flaw::Kind kind : {Flaw::Kind::non_manifold, Flaw::Kind::unorientable})
    if (const std::string where = places(flaws, kind, solid.file_unit); !where.empty()) {
      error("bounds no volume: it has " + where + " (genu mesh-check lists all)");
      good = false;
    }
  if (const auto loops = free_loops(mesh); good && !loops.empty()) {
    const Vec3 p = mesh.vertices[static_cast<std::size_t>(loops[0].vertices[0])] / solid.file_unit;
    error(
        fmt::format("is open: it ends along {} line{} of free edges, the first through ({:g}, {:g}, {:g}); a solid is "
                    "a closed surface (genu mesh-check --repair fills holes)",
                    loops.size(), loops.size() == 1 ? "" : "s", p.x(), p.y(), p.z()));
    good = false;
  }
  if (const std::string where = places(flaws, Flaw::Kind::crossing, solid.file_unit); good && !where.empty())
    out.warning(Code::mesh_flawed, solid.file.text(),
                "runs through itself, and what lies in two of its parts counts twice: " + where);
  return good;
}

/// All triangles outward, but for those of cavities; `turned` were turned before, for a winding that agrees.
void face_outward(Mesh& mesh, std::size_t turned, const Solid& solid, Diagnostics& out) {
  const auto warn = [&](const std::string& rule) { out.warning(Code::mesh_repaired, solid.file.text(), rule); };
  if (solid_inertia(mesh).volume < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    warn("is inside out: its normals point into the volume it closes; taken the other way round");
  }
  const OutwardReport report = turn_outward(mesh);
  turned += report.turned;
  if (turned > 0) warn(fmt::format("has {} triangles wound against the rest of it: turned round", turned));
  if (report.cavities == 0) return;
  const double volume = 1e6 * solid_inertia(mesh).volume, inner = 1e6 * report.cavity_volume;  // cm3
  warn(
      fmt::format("has {} closed piece{} inside another one that face{} outward as that does: read as cavit{}, so the "
                  "volume is {:.4g} cm3; take {} out of the file if there is no cavity ({:.4g} cm3)",
                  report.cavities, report.cavities == 1 ? "" : "s", report.cavities == 1 ? "s" : "",
                  report.cavities == 1 ? "y" : "ies", volume, report.cavities == 1 ? "it" : "them", volume + inner));
}

std::optional<SolidInertia> read_solid_mesh(const Solid& solid, MeshLibrary& meshes, Diagnostics& out) {
  auto mesh = meshes.read(solid.file, solid.file_unit, out);
  if (!mesh) return std::nullopt;
  check_scale(check_mesh(*mesh), solid.file.text(), length_unit_name(solid.file_unit), out);
  if (out.has_errors()) return std::nullopt;
  const std::size_t turned = make_winding_consistent(*mesh, mesh_edges(*mesh)).flipped;
  if (!bounds_a_volume(*mesh, solid, out)) return std::nullopt;
  face_outward(*mesh, turned, solid, out);
  for (Vec3& v : mesh->vertices) v = solid.placement * v;
  const SolidInertia found = solid_inertia(*mesh);
  if (fullness(*mesh, found.volume) > kMinFullness) return found;
  out.error(Code::mesh_unusable, solid.file.text(), "closes no volume: it is flat");
  return std::nullopt;
}

}  // namespace

std::vector<RunSummary::BodyFacts> read_solids(Scene& scene, MeshLibrary& meshes, Diagnostics& out) {
  std::vector<RunSummary::BodyFacts> facts;
  for (BodyDef& body : scene.bodies) {
    if (!body.solid) continue;
    Diagnostics found;
    const auto solid = read_solid_mesh(*body.solid, meshes, found);
    add_at_key(scene, "body." + body.name + ".solid.file", body.solid->file, found, out);
    if (!solid) continue;
    const double density = body.solid->density;
    body.mass = density * solid->volume;
    body.centre_of_mass = solid->centroid;
    body.inertia = density * solid->about_centroid;
    facts.push_back(
        {body.name, body.solid->file.text(), density, solid->volume, body.mass, solid->centroid, body.inertia});
  }
  return facts;
}

}  // namespace genu
