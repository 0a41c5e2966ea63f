// Dortmans' knee with its tori in closed form or as meshes of a given size, at a solved pose.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/geometry/blend_surface.h"
#include "genu/geometry/tessellate.h"
#include "genu/run/run_scene.h"
#include "genu/solver/walker.h"

namespace genu::bench {

/// About `triangles` nearly equilateral triangles on a torus, in its own frame. Finer than `genu mesh` would go.
inline Mesh torus_mesh(double R, double r, std::size_t triangles) {
  constexpr double kPi = std::numbers::pi;
  // columns * rows * 2 triangles with columns : rows = 2 pi R : 2 pi r / kRowSpacing.
  const double aspect = R / (r / kRowSpacing);
  const int rows =
      2 * std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / (2 * aspect)) / 2)));
  const int columns = static_cast<int>(std::lround(static_cast<double>(triangles) / (2.0 * rows)));
  return grid_mesh({columns, true}, {rows, true}, [&](double u, double v) {
    const double phi = 2 * kPi * u, theta = 2 * kPi * v, around = R + r * std::cos(theta);
    return Vec3(around * std::cos(phi), around * std::sin(phi), r * std::sin(theta));
  });
}

class BenchKnee {
 public:
  /// `triangles` for each condyle, 0 for the closed form.
  explicit BenchKnee(std::size_t triangles) {
    Diagnostics problems;
    prepared_ = prepare(GENU_SOURCE_DIR "/meshes/dortmans1984/scene.toml", problems);
    if (!prepared_) return;
    Prepared& p = *prepared_;
    for (std::size_t i = 0; triangles > 0 && i < p.scene.surfaces.size(); ++i) {
      const SurfaceDef& def = p.scene.surfaces[i];
      if (def.shape != SurfaceDef::Shape::torus) continue;
      Mesh mesh = torus_mesh(def.major_radius, def.minor_radius, triangles);
      triangles_ = mesh.triangles.size();
      for (Vec3& v : mesh.vertices) v = def.placement * v;
      const Timer timer;
      p.surfaces[i] = BlendSurface::build(std::move(mesh), {}, def.name, problems);
      build_seconds_ += timer.seconds();
      if (!p.surfaces[i]) return;
    }
    auto model = build_model(p.scene, p.surfaces, problems);
    if (!model) return;
    p.model = std::move(*model);
    const Timer timer;
    field_ = std::make_unique<ContactField>(p.model);
    search_seconds_ = timer.seconds();
    solver_ = std::make_unique<ContactSetSolver>(p.model, *field_, options_.newton);
    walker_ = std::make_unique<Walker>(*solver_, options_, no_event_);
    find_start();
  }
  BenchKnee(const BenchKnee&) = delete;
  BenchKnee& operator=(const BenchKnee&) = delete;

  bool good() const { return good_; }
  std::size_t triangles() const { return triangles_; }
  double build_seconds() const { return build_seconds_; }    ///< of both condyles
  double search_seconds() const { return search_seconds_; }  ///< for what the contact search prepares once

  /// From the solved pose at 30 deg to 31 deg: prediction, Newton, the look at both surface pairs, the certificate and
  /// the eigenvalues at the end; a degree of 70, as in the scene. False if that took more than one step.
  bool warm_pose() {
    walker_->begin(way_, 1, start_, start_report_);
    const int before = walker_->substeps();
    return walker_->walk_to(kDegree) && walker_->substeps() == before + 1;
  }

  /// Newton alone over the same degree, from the pose at 30 deg, contacts given.
  bool newton_only() {
    State state = start_.state;
    const NewtonReport report = solver_->newton().solve(state, way_.target(kDegree), options_.newton);
    iterations_ = report.iterations;
    return report.converged();
  }
  int iterations() const { return iterations_; }

 private:
  static constexpr double kFlexion = 30 * units::kDegree, kRange = 70 * units::kDegree;
  static constexpr double kDegree = 1.0 / 70;  ///< of `way_`

  StepPlan flexion(double from, double to) const {
    StepPlan plan;
    plan.prescribed.push_back({prepared_->steps[0].prescribed[0].coordinate, from, to});
    return plan;
  }

  void find_start() {
    way_ = flexion(kFlexion, kFlexion + kRange);
    Balanced pose;
    pose.state = reference_state(prepared_->model);
    pose.last_number.assign(prepared_->model.pairs.size(), 0);
    const StepPlan way = flexion(0, kFlexion);
    const PoseReport cold = solver_->settle_cold(pose, way.target(0));
    if (cold.status != PoseStatus::ok) return;
    walker_->begin(way, 1, pose, cold);
    for (int k = 1; k <= 30; ++k)
      if (!walker_->walk_to(k / 30.0)) return;
    start_ = walker_->pose();
    start_report_ = walker_->report();
    good_ = true;
  }

  std::optional<Prepared> prepared_;
  std::unique_ptr<ContactField> field_;
  PathOptions options_;
  std::function<void(PathEvent)> no_event_ = [](const PathEvent&) {};
  std::unique_ptr<ContactSetSolver> solver_;
  std::unique_ptr<Walker> walker_;
  StepPlan way_;
  Balanced start_;
  PoseReport start_report_;
  std::size_t triangles_ = 0;
  double build_seconds_ = 0, search_seconds_ = 0;
  int iterations_ = 0;
  bool good_ = false;
};

}  // namespace genu::bench
