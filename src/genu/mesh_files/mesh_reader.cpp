#include "genu/mesh_files/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "genu/mesh/coordinate_step.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_file_check.h"
#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/mesh_space.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

/// Binary files have no lines to name: the number of the vertex stands for them.
std::optional<Fault> check_coordinates(const Mesh& mesh, bool stl) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    if (is_coordinate(p.x()) && is_coordinate(p.y()) && is_coordinate(p.z())) continue;
    return Fault{
        Code::mesh_coordinates,
        fmt::format("has a coordinate that is {} ({} {}, [{:.4g}, {:.4g}, {:.4g}]): repair or export the mesh again",
                    p.allFinite() ? "beyond 1e9 of its units" : "not a finite number", stl ? "triangle" : "vertex",
                    (stl ? v / 3 : v) + 1, p.x(), p.y(), p.z())};
  }
  return {};
}

std::optional<Fault> unreadable(std::string why) {
  return why.empty() ? std::nullopt : std::optional(Fault{Code::mesh_unreadable, std::move(why)});
}

/// None where all is well.
std::optional<Fault> import(const std::string& path, std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  const std::string extension = mesh_extension(path);
  const bool stl = extension == ".stl";
  const std::string problem = stl                   ? read_stl(bytes, mesh, notes)
                              : extension == ".off" ? read_off(bytes, mesh, notes)
                              : extension == ".vtp" ? read_vtp(bytes, mesh, notes)
                              : extension == ".ply" ? read_ply(bytes, mesh, notes)
                              : extension == ".obj" ? read_obj(bytes, mesh, notes)
                                                    : read_by_assimp(path, bytes, mesh, notes);
  if (!problem.empty()) return unreadable(problem);
  if (auto fault = unreadable(notes.problem())) return fault;
  return check_coordinates(mesh, stl);
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

/// A surface far from its origin has no room left for its shape in seven digits.
void warn_rounding(const std::string& path, const Mesh& mesh, double metres_per_unit, const MeshFileFacts& facts,
                   Diagnostics& out) {
  if (!facts.single || !(facts.rounding > kCoarseCoordinateStep)) return;
  double farthest = 0;
  for (const Vec3& v : mesh.vertices) farthest = std::max(farthest, v.norm());
  out.warning(
      Code::mesh_coordinates, path,
      fmt::format("has single-precision coordinates {:.3g} mm from its origin: they are rounded to {:.2g} mm, which "
                  "curvature and contact feel; export it again about an origin near the joint",
                  1e3 * metres_per_unit * farthest, 1e3 * facts.rounding));
}

/// Welds what was read and notes its facts; says why nothing is left of it. `again` gives what was read once more.
std::optional<Fault> clean(Mesh& mesh, MeshFileFacts& facts, const std::function<Mesh()>& again) {
  if (mesh.empty()) return unreadable("has no triangles: export the surface as a triangle mesh");
  drop_unused_vertices(mesh);  // how far away they are means nothing
  facts.vertices = mesh.vertices.size();
  facts.triangles = mesh.triangles.size();
  const CoordinateStep written = coordinate_step(mesh);
  const bool decimal = written.decimal > 0 && mesh.vertices.size() >= kMinDecimalVertices;
  facts.rounding = decimal ? written.decimal : written.single;
  facts.single = !decimal && written.single > 0;
  const double tolerance = weld_tolerance(mesh);
  facts.weld = weld(mesh, tolerance);
  return mesh.empty() ? unreadable(why_nothing_is_left(again(), tolerance)) : std::nullopt;
}

/// The mesh in the file's unit, with its facts; says why there is none.
std::optional<Fault> read_in_file_unit(const std::string& path, InputFiles& files, Mesh& mesh, MeshFileFacts& facts) {
  if (auto fault = check_mesh_name(path)) return fault;
  const auto bytes = files.bytes(path);
  if (!bytes) return Fault{Code::cannot_read, kCannotOpen};
  if (auto fault = unreadable(check_mesh_bytes(mesh_extension(path), *bytes))) return fault;
  MeshNotes notes;
  if (auto fault = import(path, *bytes, mesh, notes)) return fault;
  facts.notes = notes.texts();
  facts.space = space_said(*bytes);
  return clean(mesh, facts, [&] {
    Mesh again;
    import(path, *bytes, again, notes);
    return again;
  });
}

/// What is left to do once the unit is known.
Mesh in_metres(const std::string& path, Mesh mesh, double metres_per_unit, MeshFileFacts& facts, Diagnostics& out) {
  for (const std::string& note : facts.notes) out.warning(Code::mesh_repaired, path, note);
  const WeldReport& report = facts.weld;
  if (report.degenerate + report.duplicate > 0)
    out.warning(
        Code::mesh_repaired, path,
        fmt::format("dropped {} triangles without extent and {} repeated ones{}", report.degenerate, report.duplicate,
                    report.both_ways == 0
                        ? std::string()
                        : fmt::format("; {} stood there both ways round (a two-sided export): closed "
                                      "pieces of them face outward, open ones as their first triangle",
                                      report.both_ways)));
  facts.rounding *= metres_per_unit;
  warn_rounding(path, mesh, metres_per_unit, facts, out);
  for (Vec3& v : mesh.vertices) v *= metres_per_unit;
  return mesh;
}

/// m
double guessed_unit(const Mesh& mesh) { return guess_unit(bounding_box(mesh).diagonal()) == "m" ? 1.0 : 1e-3; }

/// Pieces in two frames are seldom meant: between RAS and LPS one of them stands back to front.
bool in_one_space(const PieceFiles& files, const std::vector<MeshFileFacts>& pieces, Diagnostics& out) {
  std::size_t named = 0;
  while (named < pieces.size() && pieces[named].space.empty()) ++named;
  for (std::size_t k = named; k < pieces.size(); ++k) {
    if (pieces[k].space.empty() || pieces[k].space == pieces[named].space) continue;
    out.error(Code::layout, files.paths[k],
              fmt::format("says SPACE={} and {} says SPACE={}: export the pieces of a mesh in one frame",
                          pieces[k].space, files.paths[named], pieces[named].space));
    return false;
  }
  return true;
}

MeshFileFacts facts_of(const std::vector<MeshFileFacts>& pieces, const JoinedMesh& joined) {
  MeshFileFacts all;
  for (const MeshFileFacts& piece : pieces) {
    all.vertices += piece.vertices;
    all.triangles += piece.triangles;
    all.weld.joined += piece.weld.joined;
    all.weld.joined_near += piece.weld.joined_near;
    all.weld.degenerate += piece.weld.degenerate;
    all.weld.duplicate += piece.weld.duplicate;
    all.weld.both_ways += piece.weld.both_ways;
    all.single = piece.rounding > all.rounding ? piece.single : all.single;
    all.rounding = std::max(all.rounding, piece.rounding);
    if (all.space.empty()) all.space = piece.space;
    all.notes.insert(all.notes.end(), piece.notes.begin(), piece.notes.end());
  }
  all.ends = joined.ends;
  all.borders = joined.borders;
  return all;
}

}  // namespace

const MeshLibrary::Entry& MeshLibrary::entry(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto [place, is_new] = entries_.try_emplace(path);
  Entry& e = place->second;
  if (is_new) {
    e.fault = read_in_file_unit(path, *files_, e.mesh, e.facts);
    files_->release(path);
  }
  return e;
}

std::string MeshLibrary::content_of(const PieceFiles& files) {
  std::string content;
  for (const std::string& path : files.paths) {
    const std::string extension = mesh_extension(path);
    const bool by_assimp =
        std::any_of(std::begin(kByAssimp), std::end(kByAssimp), [&](const char* other) { return extension == other; });
    if (by_assimp || check_mesh_name(path)) return {};
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = entries_.find(path); known != entries_.end() && known->second.in_memory) return {};
    }
    const auto sum = files_->checksum(path);
    if (!sum) return {};
    content += fmt::format("{} {}\n", sum->xxh128, sum->bytes);
  }
  return content;
}

void MeshLibrary::put(const std::string& name, const Mesh& mesh) {
  Entry e;
  e.in_memory = true;
  e.mesh = mesh;
  e.fault = check_coordinates(e.mesh, false);
  if (!e.fault) e.fault = clean(e.mesh, e.facts, [&] { return mesh; });
  const std::lock_guard lock(mutex_);
  entries_.insert_or_assign(name, std::move(e));
}

void MeshLibrary::drop(const std::string& name) {
  const std::lock_guard lock(mutex_);
  entries_.erase(name);
}

std::optional<Mesh> MeshLibrary::read(const PieceFiles& files, double metres_per_unit, Diagnostics& out,
                                      MeshFileFacts* facts) {
  if (files.several()) return join(files, metres_per_unit, out, facts);
  const std::string path = files.text();
  const Entry& e = entry(path);
  if (e.fault) {
    out.error(e.fault->code, path, e.fault->text);
    return std::nullopt;
  }
  MeshFileFacts found = e.facts;
  Mesh mesh = in_metres(path, e.mesh, metres_per_unit, found, out);
  if (facts != nullptr) *facts = found;
  return mesh;
}

std::optional<Mesh> MeshLibrary::join(const PieceFiles& files, double metres_per_unit, Diagnostics& out,
                                      MeshFileFacts* facts) {
  std::vector<Mesh> pieces;
  std::vector<MeshFileFacts> of_pieces;
  double tolerance = 0;
  for (const std::string& path : files.paths) {
    auto mesh = read(path, metres_per_unit, out, &of_pieces.emplace_back());
    if (!mesh) continue;
    tolerance = std::max(tolerance, metres_per_unit * weld_tolerance(entry(path).mesh));
    pieces.push_back(std::move(*mesh));
  }
  if (pieces.size() < files.paths.size()) return std::nullopt;
  if (!in_one_space(files, of_pieces, out)) return std::nullopt;
  JoinedMesh joined = join_pieces(pieces, tolerance);
  if (joined.repeated > 0)
    out.warning(Code::mesh_repaired, files.text(),
                fmt::format("dropped {} triangles that two of these files share", joined.repeated));
  if (facts != nullptr) *facts = facts_of(of_pieces, joined);
  return std::move(joined.mesh);
}

std::optional<Mesh> MeshLibrary::read_of_some_unit(const PieceFiles& files, double& metres_per_unit, Diagnostics& out,
                                                   MeshFileFacts* facts) {
  Mesh points;  // of all files
  for (const std::string& path : files.paths) {
    const Mesh& mesh = entry(path).mesh;
    points.vertices.insert(points.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
  if (!points.vertices.empty()) metres_per_unit = guessed_unit(points);
  return read(files, metres_per_unit, out, facts);
}

namespace {

/// One file for one use: nothing is kept. Where no unit is given it is guessed.
std::optional<Mesh> read_once(const std::string& path, double& metres_per_unit, bool guess, Diagnostics& out,
                              MeshFileFacts* facts) {
  InputFiles files;
  Mesh mesh;
  MeshFileFacts found;
  if (const auto fault = read_in_file_unit(path, files, mesh, found)) {
    out.error(fault->code, path, fault->text);
    return std::nullopt;
  }
  files.release(path);
  if (guess) metres_per_unit = guessed_unit(mesh);
  mesh = in_metres(path, std::move(mesh), metres_per_unit, found, out);
  if (facts != nullptr) *facts = found;
  return mesh;
}

}  // namespace

std::optional<Mesh> read_mesh(const PieceFiles& files, double metres_per_unit, Diagnostics& out, MeshFileFacts* facts) {
  if (files.several()) return MeshLibrary().read(files, metres_per_unit, out, facts);
  return read_once(files.text(), metres_per_unit, false, out, facts);
}

std::optional<Mesh> read_mesh_of_some_unit(const PieceFiles& files, double& metres_per_unit, Diagnostics& out,
                                           MeshFileFacts* facts) {
  if (files.several()) return MeshLibrary().read_of_some_unit(files, metres_per_unit, out, facts);
  return read_once(files.text(), metres_per_unit, true, out, facts);
}

}  // namespace genu
