#include "genu/assemble/mesh_surface.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "genu/assemble/piece_notes.h"
#include "genu/core/binary_archive.h"
#include "genu/core/length_units.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/two_sided.h"
#include "genu/mesh_care/mesh_flaws.h"
#include "genu/mesh_care/mesh_shape.h"
#include "genu/surface/blend_archive.h"

namespace genu {

template <typename Archive>
void serialize(Archive& a, BoundingBox& x) {
  a(x.low, x.high);
}
template <typename Archive>
void serialize(Archive& a, MeshReport& x) {
  a(x.vertices, x.triangles, x.components, x.boundary_loops, x.boundary_edges, x.non_manifold_edges, x.flipped,
    x.orientable, x.degenerate, x.slivers, x.edge_length, x.box);
}
template <typename Archive>
void serialize(Archive& a, StairSteps& x) {
  a(x.direction, x.height, x.share, x.levels, x.rms);
}

namespace {

std::string describe(const MeshReport& r, const BlendFacts& f) {
  return fmt::format("{} triangles, edge {:.2f} mm; degree {}, fit radius {:.2f} mm, {} nodes; {}", r.triangles,
                     to::kMillimetre * r.edge_length[2], f.degree, to::kMillimetre * f.fit_radius, f.node_count, f.why);
}

/// Carries a mesh into its body's frame, its outward side where the scene wants it.
void move_to_body(const SurfaceDef& def, Mesh& mesh) {
  for (Vec3& v : mesh.vertices) v = def.placement * v;
  if (!def.inside) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// Takes the flaws out of a mesh, tells of them with the place of each, and remembers where they were.
std::vector<DoubtfulPlace> set_flaws_apart(Mesh& mesh, const SurfaceDef& def, Diagnostics& out) {
  constexpr std::size_t kFlawsInMessage = 4;
  std::vector<DoubtfulPlace> places;
  std::string told;
  std::size_t count = 0;
  for (const Flaw& flaw : cut_out_flaws(mesh)) {
    const std::string what = describe(flaw, def.file_unit);
    if (++count <= kFlawsInMessage) told += (told.empty() ? "" : "; ") + what;
    // What lies inside another piece is out of reach and leaves nothing missing.
    if (flaw.kind == Flaw::Kind::inner_piece) continue;
    places.push_back({def.file.text() + " has " + what, flaw.points, 0, flaw.kind != Flaw::Kind::stray_piece});
  }
  if (count == 0) return places;
  if (count > kFlawsInMessage)
    told += fmt::format("; and {} more (genu mesh-check lists them)", count - kFlawsInMessage);
  out.warning(Code::mesh_flawed, def.file.text(),
              "has flaws, left out of its surface; a pose whose contact touches one is refused: " + told);
  return places;
}

void warn_steps(const std::optional<StairSteps>& steps, const SurfaceDef& def, Diagnostics& out) {
  if (!steps) return;
  out.warning(Code::mesh_coordinates, def.file.text(),
              fmt::format("is a staircase of {} steps of {:.3g} mm, a segmentation that was not smoothed: it is about "
                          "{:.2g} mm off the surface it stands for",
                          steps->levels, to::kMillimetre * steps->height, to::kMillimetre * steps->rms));
}

void warn_turned(std::size_t turned, const SurfaceDef& def, Diagnostics& out) {
  if (turned == 0) return;
  out.warning(Code::mesh_repaired, def.file.text(),
              fmt::format("has {} triangles wound against the rest of it: turned round", turned));
}

/// A closed mesh tells its outward side by its volume: where that is negative it is turned round. An open sheet is
/// examined at the start (facing.h). Where the scene says `inside`, it has the last word.
void turn_inside_out(Mesh& mesh, const MeshReport& report, const SurfaceDef& def, Diagnostics& out) {
  if (report.boundary_loops > 0 || report.non_manifold_edges > 0 || def.inside) return;
  double volume = 0;
  const auto from_corner = [&](int i) -> Vec3 { return mesh.vertices[static_cast<std::size_t>(i)] - report.box.low; };
  for (const auto& t : mesh.triangles) volume += from_corner(t[0]).dot(from_corner(t[1]).cross(from_corner(t[2]))) / 6;
  if (!(volume < 0)) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  out.warning(
      Code::mesh_repaired, def.file.text(),
      "is inside out: its normals point into the volume it closes; turned round (inside = true keeps a hollow)");
}

/// Reads and cleans the mesh, in its body's frame; empty with errors in `out.found`.
std::optional<Mesh> read_clean(const SurfaceDef& def, MeshLibrary& meshes, std::vector<DoubtfulPlace>& doubtful,
                               MeshSurface& out) {
  Diagnostics& found = out.found;
  MeshFileFacts facts;
  auto mesh = meshes.read(def.file, def.file_unit, found, &facts);
  out.space = facts.space;
  if (!mesh) return std::nullopt;
  out.text = pieces_text(def.file, facts.borders);
  warn_meetings(*mesh, facts.ends, def, found);
  out.report = check_mesh(*mesh);
  check_scale(*out.report, def.file.text(), length_unit_name(def.file_unit), found);
  make_winding_consistent(*mesh, mesh_edges(*mesh));
  turn_inside_out(*mesh, *out.report, def, found);
  doubtful = set_flaws_apart(*mesh, def, found);
  warn_turned(out.report->flipped + turn_odd_pieces(*mesh), def, found);
  move_to_body(def, *mesh);
  for (DoubtfulPlace& d : doubtful)
    for (Vec3& p : d.points) p = def.placement * p;
  out.steps = stair_steps(*mesh);
  warn_steps(out.steps, def, found);
  if (found.has_errors()) return std::nullopt;
  return mesh;
}

void make_facets(Mesh mesh, std::vector<DoubtfulPlace> doubtful, MeshSurface& out) {
  out.text += fmt::format("{} triangles, edge {:.2f} mm; used as they are", out.report->triangles,
                          to::kMillimetre * out.report->edge_length[2]);
  for (DoubtfulPlace& d : doubtful) d.reach = out.report->edge_length[2];
  out.facets = std::make_shared<FacetSurface>(std::move(mesh));
  out.facets->set_doubtful(std::move(doubtful));
}

void make_smooth(const SurfaceDef& def, Mesh mesh, std::vector<DoubtfulPlace> doubtful, MeshSurface& out) {
  out.blend = BlendSurface::build(std::move(mesh), {def.fit_radius, def.degree}, def.file.text(), out.found);
  if (!out.blend) return;
  out.text += describe(*out.report, out.blend->facts());
  out.blend->set_doubtful(std::move(doubtful));
}

MeshSurface built(const SurfaceDef& def, bool facets, MeshLibrary& meshes, double& read_seconds) {
  MeshSurface out;
  std::vector<DoubtfulPlace> doubtful;
  std::optional<Mesh> mesh;
  {
    const ScopedTimer timing(read_seconds);
    mesh = read_clean(def, meshes, doubtful, out);
  }
  if (!mesh) return out;
  if (facets)
    make_facets(std::move(*mesh), std::move(doubtful), out);
  else
    make_smooth(def, std::move(*mesh), std::move(doubtful), out);
  return out;
}

/// All that the surface depends on; empty where that cannot be told.
std::string key_of(const SurfaceDef& def, bool facets, MeshLibrary& meshes) {
  const std::string content = meshes.content_of(def.file);
  if (content.empty()) return {};
  BinaryWriter archive;
  archive(std::string("surface of a mesh"), content, def.file.text(), def.file_unit, def.placement.R, def.placement.p,
          def.inside, def.fit_radius, def.degree, facets);
  return archive.take();
}

/// A warning, as it is kept.
struct Said {
  int severity = 0, code = 0, line = 0, column = 0;
  std::string file, key, found, rule;

  template <typename Archive>
  void serialize(Archive& a) {
    a(severity, code, line, column, file, key, found, rule);
  }
};

std::string kept(const MeshSurface& surface) {
  std::vector<Said> said;
  for (const Diagnostic& d : surface.found.items())
    said.push_back(
        {static_cast<int>(d.severity), static_cast<int>(d.code), d.line, d.column, d.file, d.key, d.found, d.rule});
  BinaryWriter archive;
  archive(surface.text, surface.space, surface.report, surface.steps, said, surface.blend != nullptr);
  if (surface.blend)
    archive(*surface.blend);
  else
    archive(surface.facets->triangles(0, Vec3::Zero(), 0),
            std::vector<DoubtfulPlace>(surface.facets->doubtful().begin(), surface.facets->doubtful().end()));
  return archive.take();
}

/// Empty where the bytes are no surface.
std::optional<MeshSurface> restored(const std::string& bytes) {
  MeshSurface out;
  try {
    BinaryReader archive(bytes);
    std::vector<Said> said;
    bool smooth = false;
    archive(out.text, out.space, out.report, out.steps, said, smooth);
    for (const Said& s : said)
      out.found.add({static_cast<Diagnostic::Severity>(s.severity),
                     static_cast<Code>(s.code),
                     {s.file, {s.line, s.column}},
                     s.key,
                     s.found,
                     s.rule});
    if (smooth) {
      out.blend = BlendSurface::restored(archive);
      return out;
    }
    Mesh mesh;
    std::vector<DoubtfulPlace> doubtful;
    archive(mesh, doubtful);
    out.facets = std::make_shared<FacetSurface>(std::move(mesh));
    out.facets->set_doubtful(std::move(doubtful));
  } catch (const BrokenArchive&) {
    return std::nullopt;
  }
  return out;
}

}  // namespace

MeshSurface mesh_surface(const SurfaceDef& def, bool facets, MeshLibrary& meshes, double& read_seconds,
                         const DiskCache* cache) {
  std::string key;
  if (cache != nullptr) {
    const ScopedTimer timing(read_seconds);
    key = key_of(def, facets, meshes);
    auto bytes = key.empty() ? std::nullopt : cache->find(key);
    if (auto known = bytes ? restored(*bytes) : std::nullopt) {
      for (const std::string& path : def.file.paths) meshes.files().set_aside(path);
      return std::move(*known);
    }
  }
  MeshSurface out = built(def, facets, meshes, read_seconds);
  if (!key.empty() && (out.blend || out.facets)) cache->keep(key, kept(out));
  return out;
}

}  // namespace genu
