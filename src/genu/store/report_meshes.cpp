#include "genu/store/report_meshes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "genu/mesh/display_mesh.h"
#include "genu/surface/tessellate.h"

namespace genu {
namespace {

constexpr double kEdgesAcross = 44;  // edges over the width of a shape that has a formula

/// The part of a shape that has something to do with the joint: a ball in the body's frame.
struct Ball {
  Vec3 centre;
  double radius;
  bool touched;  ///< it is known where the surface is touched
};

/// Round the places of a body that are known to matter.
class Places {
 public:
  Places(const Prepared& p, const ReportRun& run)
      : p_(p), of_body_(p.model.bodies.size()), touched_(p.model.bodies.size()) {
    for (const LigamentDef& l : p.scene.ligaments)
      for (const LigamentDef::End& end : l.path_points()) add(end);
    for (const ReportContact& c : run.contacts)
      for (std::size_t row = 0; row < run.body_poses.size(); ++row) {
        if (!c.point[row].allFinite() || run.body_poses[row].empty()) continue;
        const std::vector<Pose>& X = run.body_poses[row];
        touched_[at(c.body_b)].push_back(c.point[row]);
        touched_[at(c.body_a)].push_back(X[at(c.body_a)].inverse() * (X[at(c.body_b)] * c.point[row]));
      }
  }

  Ball around(const SurfaceDef& def, const Surface& surface) const {
    std::vector<Vec3> touched;
    constexpr double kTouchedDistance = 2e-3;  // m: of another surface of the body otherwise
    for (const Vec3& point : touched_[at(def.body)])
      if (const auto gap = surface.gap(point); gap && std::abs(*gap) < kTouchedDistance) touched.push_back(point);
    const std::vector<Vec3>& all = touched.empty() ? of_body_[at(def.body)] : touched;
    if (all.empty()) return {def.placement.p, 2 * p_.model.scales.size, false};
    Vec3 low = all.front(), high = low;
    for (const Vec3& point : all) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    return {(low + high) / 2, std::max(0.75 * (high - low).norm(), 1.25 * p_.model.scales.size), !touched.empty()};
  }

 private:
  void add(const LigamentDef::End& end) { of_body_[at(end.body)].push_back(end.point); }

  const Prepared& p_;
  std::vector<std::vector<Vec3>> of_body_, touched_;
};

ReportMesh shown(std::string name, int body, ReportMesh::Kind kind, Mesh mesh, std::size_t most) {
  const std::size_t in_full = mesh.triangles.size();
  Mesh few = display_mesh(std::move(mesh), most);
  return {std::move(name), body, kind, std::move(few.vertices), std::move(few.triangles), in_full};
}

Mesh triangles_of(const Prepared& p, std::size_t i, const Places& places) {
  const SurfaceDef& def = p.scene.surfaces[i];
  const Surface& surface = *p.surfaces[i];
  if (def.shape == SurfaceDef::Shape::mesh) return surface.triangles(0, Vec3::Zero(), 0);
  const Ball ball = places.around(def, surface);
  constexpr double kAcrossFlat = 8;
  const double across = def.shape == SurfaceDef::Shape::plane ? kAcrossFlat : kEdgesAcross;
  if (surface.is_unbounded()) return surface.triangles(2 * ball.radius / across, ball.centre, ball.radius);
  const double size = box_diagonal(surface, ball.radius / 4);
  constexpr double kHuge = 4;  // times the ball
  if (size <= 2 * kHuge * ball.radius) {
    Mesh mesh = surface.triangles(size / kEdgesAcross, ball.centre, size);
    // A socket that closes over what it holds would hide it.
    if (def.inside && !def.patch && ball.touched) keep_near(mesh, ball.centre, 0.3 * size);
    return mesh;
  }
  Mesh mesh = surface.triangles(2 * ball.radius / kEdgesAcross, ball.centre, ball.radius);
  keep_near(mesh, ball.centre, ball.radius);
  return mesh;
}

/// Triangles of a file, where it could be read.
std::optional<Mesh> mesh_of_file(MeshLibrary& meshes, const PieceFiles& file, double unit, const Pose& placement) {
  Diagnostics ignored;
  auto mesh = meshes.read(file, unit, ignored);
  if (!mesh || ignored.has_errors()) return std::nullopt;
  for (Vec3& v : mesh->vertices) v = placement * v;
  return mesh;
}

}  // namespace

std::vector<ReportMesh> report_meshes(const Prepared& p, const ReportRun& run, std::size_t most) {
  std::vector<ReportMesh> out;
  const Places places(p, run);
  for (std::size_t i = 0; i < p.scene.surfaces.size(); ++i) {
    const SurfaceDef& def = p.scene.surfaces[i];
    out.push_back(shown(def.name, def.body, ReportMesh::Kind::surface, triangles_of(p, i, places), most));
  }
  std::set<std::pair<int, PieceFiles>> added;  // one bone often lies under several surfaces
  const auto add_bone = [&](const std::string& name, int body, const PieceFiles& file, double unit, const Pose& X) {
    if (!added.emplace(body, file).second) return;
    if (auto mesh = mesh_of_file(*p.meshes, file, unit, X))
      out.push_back(shown(name, body, ReportMesh::Kind::bone, std::move(*mesh), most));
  };
  for (const SurfaceDef& s : p.scene.surfaces)
    if (s.thickness && s.thickness->measured)
      add_bone("bone under " + s.name, s.body, s.thickness->bone, s.thickness->bone_unit, s.placement);
  for (std::size_t b = 0; b < p.scene.bodies.size(); ++b) {
    const BodyDef& body = p.scene.bodies[b];
    if (!body.solid) continue;
    Pose X = body.solid->placement;
    X.p -= p.scene.origins[b];  // the file's own place is not moved where the body's origin is
    add_bone(body.name + " (solid)", static_cast<int>(b), body.solid->file, body.solid->file_unit, X);
  }
  return out;
}

}  // namespace genu
