// Dortmans' knee with its surfaces cut into triangles, against the same knee in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "genu/assemble/build_surface.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/model/build_model.h"
#include "genu/study/run_scene.h"
#include "genu/surface/blend_surface.h"
#include "support/judged.h"
#include "support/temporary_folder.h"

namespace genu::test {

/// How a surface becomes a mesh.
enum class MeshRoute {
  memory,  ///< the tessellation itself, in double precision
  file,    ///< written as STL (single precision) by `genu mesh`'s writer and read back as a scene's mesh
};

struct MeshStudyOptions {
  MeshRoute route = MeshRoute::file;
  bool planes_too = false;  ///< else only the tori are meshes
  int degree = 3;
};

/// One edge length of the study. Errors are the largest over all poses.
struct MeshStudyRow {
  double edge = 0;  ///< m, as asked for
  double median_edge = 0;
  std::size_t triangles = 0;  ///< of one torus
  double position_error = 0;  ///< m
  double rotation_error = 0;  ///< rad
  double force_error = 0;     ///< N, of any contact
  double build_seconds = 0;   ///< of all surfaces
  double pose_seconds = 0;    ///< for one row of the results
  std::string failure;        ///< empty where every pose was solved
};

inline constexpr double kPlateauReach = 0.02;  // m: half the side of a meshed plane

/// The knee, walked in steps of a degree. Rows every `increment` degrees are compared.
class MeshStudy {
 public:
  explicit MeshStudy(std::string scene_file) : scene_file_(std::move(scene_file)) {
    Diagnostics problems;
    exact_ = prepare(scene_file_, problems);
    if (!exact_) return;
    ContactField field(exact_->model);
    const Timer timer;
    reference_ = solve(*exact_, field, {});
    exact_seconds_ = timer.seconds() / static_cast<double>(reference_.records.size());
    test::expect_judged_ok(*exact_, reference_.poses);
  }

  bool good() const { return exact_ && reference_.summary.exit_code == kExitOk; }
  double exact_pose_seconds() const { return exact_seconds_; }

  MeshStudyRow measure(double edge, const MeshStudyOptions& options) const {
    MeshStudyRow row;
    row.edge = edge;
    Prepared p;
    p.scene = exact_->scene;
    p.steps = exact_->steps;
    Diagnostics problems;
    const Timer building;
    if (options.route == MeshRoute::file)
      build_from_files(edge, options, p, row, problems);
    else
      build_in_memory(edge, options, p, row, problems);
    row.build_seconds = building.seconds();
    if (!problems.has_errors()) {
      if (auto model = build_model(p.scene, p.surfaces, problems)) p.model = std::move(*model);
    }
    if (problems.has_errors()) {
      row.failure = to_string(problems.items().front());
      return row;
    }
    ContactField field(p.model);
    const Timer solving;
    const Solution found = solve(p, field, {});
    row.pose_seconds = solving.seconds() / static_cast<double>(found.records.size());
    compare(found, row);
    return row;
  }

 private:
  static bool becomes_mesh(const SurfaceDef& def, const MeshStudyOptions& options) {
    return def.shape == SurfaceDef::Shape::torus || options.planes_too;
  }

  static Mesh cut(const SurfaceDef& def, double edge) {
    return make_analytic_surface(def)->triangles(edge, def.placement.p, kPlateauReach);
  }

  /// The facts of the first surface that is a mesh: the medial torus.
  static void note(const BlendSurface& surface, MeshStudyRow& row) {
    if (row.triangles > 0) return;
    row.triangles = surface.mesh().triangles.size();
    row.median_edge = surface.facts().median_edge;
  }

  static void build_in_memory(double edge, const MeshStudyOptions& options, Prepared& p, MeshStudyRow& row,
                              Diagnostics& problems) {
    for (const SurfaceDef& def : p.scene.surfaces) {
      if (!becomes_mesh(def, options)) {
        p.surfaces.push_back(make_analytic_surface(def));
        continue;
      }
      auto surface = BlendSurface::build(cut(def, edge), {std::nullopt, options.degree}, def.name, problems);
      if (surface) note(*surface, row);
      p.surfaces.push_back(std::move(surface));
    }
  }

  static void build_from_files(double edge, const MeshStudyOptions& options, Prepared& p, MeshStudyRow& row,
                               Diagnostics& problems) {
    const TemporaryFolder folder;
    for (SurfaceDef& def : p.scene.surfaces) {
      if (!becomes_mesh(def, options)) continue;
      const std::string file = folder / (def.name + ".stl");
      if (const std::string error = write_stl(cut(def, edge), file, units::kMillimetre, def.name); !error.empty())
        problems.error(Code::cannot_write, file, error);
      def.shape = SurfaceDef::Shape::mesh;
      def.placement = Pose{};
      def.file = file;
      def.file_unit = units::kMillimetre;
      if (options.degree != 3) def.degree = options.degree;
    }
    MeshLibrary meshes;
    p.surfaces = build_surfaces(p.scene, meshes, p.notes, p.seconds, problems);
    for (const auto& surface : p.surfaces)
      if (const auto* blend = dynamic_cast<const BlendSurface*>(surface.get())) note(*blend, row);
  }

  void compare(const Solution& found, MeshStudyRow& row) const {
    if (found.summary.exit_code != kExitOk) {
      row.failure = "not every pose was solved";
      for (const PathEvent& e : found.events)
        if (e.kind == PathEvent::Kind::stopped) row.failure += ": " + e.what;
      return;
    }
    for (std::size_t i = 0; i < reference_.records.size(); ++i) {
      const State &want = reference_.records[i].point.pose.state, &have = found.records[i].point.pose.state;
      const Pose &X = want.poses.back(), &Y = have.poses.back();
      row.position_error = std::max(row.position_error, (X.p - Y.p).norm());
      row.rotation_error = std::max(row.rotation_error, log_rotation(Y.R * X.R.transpose()).norm());
      if (want.contacts.size() != have.contacts.size()) {
        row.failure = fmt::format("pose {} has {} contacts for {}", i, have.contacts.size(), want.contacts.size());
        return;
      }
      for (const ActiveContact& c : want.contacts)
        for (const ActiveContact& d : have.contacts)
          if (c.pair == d.pair) row.force_error = std::max(row.force_error, std::abs(c.force - d.force));
    }
  }

  std::string scene_file_;
  std::optional<Prepared> exact_;
  Solution reference_;
  double exact_seconds_ = 0;
};

/// Slope of log(error) over log(median edge), least squares.
template <typename Error>
double observed_order(const std::vector<MeshStudyRow>& rows, const Error& error) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const MeshStudyRow& row : rows) {
    const double x = std::log(row.median_edge), y = std::log(error(row));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace genu::test
