#include "genu/new_scene/new_pieces.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/length_units.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh/nearest_point.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh_files/mesh_file_check.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/new_scene/tolerances.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

Vec3 area_vector(const Mesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
  return 0.5 * (b - a).cross(c - a);
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) area += area_vector(mesh, k).norm();
  return area;
}

/// Closed pieces face outward; of an open sheet the file says which side is.
void face_out(Mesh& mesh) {
  make_winding_consistent(mesh, mesh_edges(mesh));
  if (check_mesh(mesh).boundary_loops == 0 && solid_inertia(mesh).volume < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// The pieces of one bone, read in the unit of them all; fewer where some cannot be read.
std::vector<Mesh> read_pieces(const PieceFiles& files, const std::string& unit) {
  Diagnostics ignored;
  double metres = metres_in(unit).value_or(1e-3);
  if (unit.empty() && !read_mesh_of_some_unit(files, metres, ignored)) return {};
  std::vector<Mesh> pieces;
  for (const std::string& path : files.paths)
    if (auto mesh = read_mesh(path, metres, ignored)) {
      face_out(*mesh);
      pieces.push_back(std::move(*mesh));
    }
  return pieces;
}

/// Two files were always a bone and its cartilage: they are where nothing contradicts it.
std::vector<bool> told_apart(const std::vector<Mesh>& pieces) {
  std::vector<bool> cartilage = seem_cartilage(pieces);
  const bool any = std::find(cartilage.begin(), cartilage.end(), true) != cartilage.end();
  if (pieces.size() == 2 && !any && lying_on(pieces[1], pieces[0]).near > kMostlyNear) cartilage[1] = true;
  return cartilage;
}

/// Sorts `files` and says how; empty where all are of one kind.
std::string sort_files(const PieceFiles& files, const std::string& unit, PieceFiles& touches, PieceFiles& bone) {
  const std::vector<Mesh> pieces = files.several() ? read_pieces(files, unit) : std::vector<Mesh>{};
  touches = files;
  if (pieces.empty() || pieces.size() < files.paths.size()) return "";
  const std::vector<bool> cartilage = told_apart(pieces);
  PieceFiles on, under;
  for (std::size_t k = 0; k < files.paths.size(); ++k) (cartilage[k] ? on : under).paths.push_back(files.paths[k]);
  if (on.empty() || under.empty()) return fmt::format("{} together", files.text());
  touches = on;
  bone = under;
  return fmt::format("bone {}, cartilage {}", under.text(), on.text());
}

}  // namespace

LyingOn lying_on(const Mesh& mesh, const Mesh& other) {
  LyingOn out;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kPieceSamples);
  std::size_t count = 0, near = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step, ++count) {
    const Vec3& x = mesh.vertices[v];
    std::size_t triangle = 0;
    const Vec3 foot = nearest_on_mesh(other, x, &triangle);
    const double distance = (x - foot).norm();
    if (distance > kCartilageReach) continue;
    ++near;
    out.height += (x - foot).dot(area_vector(other, triangle)) < 0 ? -distance : distance;
  }
  out.near = count > 0 ? static_cast<double>(near) / static_cast<double>(count) : 0;
  out.height = near > 0 ? out.height / static_cast<double>(near) : 0;
  return out;
}

double sheet_thickness(const Mesh& mesh) {
  if (check_mesh(mesh).boundary_loops > 0) return 0;
  const double area = area_of(mesh);
  return area > 0 ? 2 * std::abs(solid_inertia(mesh).volume) / area : 0;
}

std::vector<bool> seem_cartilage(const std::vector<Mesh>& meshes) {
  std::vector<bool> out(meshes.size(), false);
  std::vector<std::vector<LyingOn>> on(meshes.size(), std::vector<LyingOn>(meshes.size()));
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t j = 0; j < meshes.size(); ++j)
      if (i != j) on[i][j] = lying_on(meshes[i], meshes[j]);
  const auto covers = [&](std::size_t i, std::size_t j) {
    return on[i][j].near >= kAllNear && on[i][j].height > kCartilageHeight;
  };
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (sheet_thickness(meshes[i]) > kThickestCartilage) continue;
    for (std::size_t j = 0; j < meshes.size(); ++j)
      if (i != j && covers(i, j) && !(covers(j, i) && on[j][i].height >= on[i][j].height)) out[i] = true;
  }
  return out;
}

std::optional<NewScene> sort_pieces(const NewScene& asked, std::vector<std::string>& choices, Diagnostics& out) {
  NewScene sorted = asked;
  for (const auto& [option, files] : {std::pair("--femur", &asked.femur_any), std::pair("--tibia", &asked.tibia_any),
                                      std::pair("--patella", &asked.patella_any), std::pair("--fibula", &asked.fibula)})
    for (auto path = files->paths.begin(); path != files->paths.end(); ++path) {
      if (std::find(files->paths.begin(), path, *path) != path)
        out.add(error_at({}, Code::duplicate, option, with_quotes(printable(*path)), "is named twice"));
      else if (const auto fault = check_mesh_name(*path))
        out.add(error_at({}, fault->code, option, with_quotes(printable(*path)), fault->text));
    }
  for (const std::string& path : asked.fibula.paths)
    for (const PieceFiles* files : {&asked.femur, &asked.tibia, &asked.patella, &asked.femur_any, &asked.tibia_any,
                                    &asked.patella_any, &asked.femur_bone, &asked.tibia_bone, &asked.patella_bone})
      if (std::find(files->paths.begin(), files->paths.end(), path) != files->paths.end())
        out.add(
            error_at({}, Code::duplicate, "--fibula", with_quotes(printable(path)), "is given for another bone too"));
  if (out.has_errors()) return std::nullopt;
  std::string told;
  const auto sort_one = [&](const char* bone_name, const PieceFiles& any, PieceFiles& touches, PieceFiles& bone) {
    if (any.empty()) return;
    const std::string how = sort_files(any, asked.unit, touches, bone);
    if (!how.empty()) told += fmt::format("{}{}: {}", told.empty() ? "" : "; ", bone_name, printable(how));
  };
  sort_one("femur", asked.femur_any, sorted.femur, sorted.femur_bone);
  sort_one("tibia", asked.tibia_any, sorted.tibia, sorted.tibia_bone);
  sort_one("patella", asked.patella_any, sorted.patella, sorted.patella_bone);
  if (!told.empty())
    choices.push_back("meshes      " + told +
                      " (by their shape; --femur-cartilage, --tibia-cartilage and --patella-cartilage say otherwise)");
  if (sorted.femur_bone.empty() != sorted.tibia_bone.empty())
    out.error(Code::meshes_needed, {},
              fmt::format("cartilage over bone is given for one of femur and tibia{}: --femur BONE CARTILAGE --tibia "
                          "BONE CARTILAGE",
                          told.empty() ? "" : " (" + told + ")"));
  return out.has_errors() ? std::nullopt : std::optional(sorted);
}

}  // namespace genu
