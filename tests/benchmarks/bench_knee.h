// Dortmans' knee with its tori in closed form or as meshes of a given size, bent from 30 to 60 deg by degrees.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/model/build_model.h"
#include "genu/path/path_follower.h"
#include "genu/study/run_scene.h"
#include "genu/surface/blend_surface.h"
#include "genu/surface/tessellate.h"
#include "support/places.h"

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
    prepared_ = prepare(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml", problems);
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
    solver_ = std::make_unique<ActiveSetSolver>(p.model, *field_, options_.newton);
    follower_ = std::make_unique<PathFollower>(*solver_, options_, no_event_);
    find_path();
  }
  BenchKnee(const BenchKnee&) = delete;
  BenchKnee& operator=(const BenchKnee&) = delete;

  bool good() const { return good_; }
  std::size_t triangles() const { return triangles_; }
  double build_seconds() const { return build_seconds_; }    ///< of both condyles
  double search_seconds() const { return search_seconds_; }  ///< for what the contact search prepares once

  static constexpr int kPoses = 30;

  /// A pose each degree from 31 to 60 deg as a run walks it: prediction, Newton, the look at both surface pairs, the
  /// certificate, what happens on the way, the eigenvalues at the end. False if a degree took more than one step.
  bool follow() {
    follower_->begin(way_, 1, path_[0].pose, path_[0].report);
    const int before = follower_->substeps();
    for (int k = 1; k <= kPoses; ++k)
      if (!follower_->advance_to(k * kDegree)) return false;
    return follower_->substeps() == before + kPoses;
  }

  /// Of each of these poses the solve alone: prediction, Newton, the path's tangent, and the checks of the contacts
  /// that are held.
  bool solve() {
    Correction tangent = path_[0].tangent;
    prediction_->went_on(kDegree, tangent_before_, tangent);
    iterations_ = 0;
    for (int k = 0; k < kPoses; ++k) {
      const Target target = way_.target((k + 1) * kDegree);
      if (!prediction_->at(path_[k].pose.state, tangent, kDegree, state_)) return false;
      const NewtonReport report = solver_->newton().solve(state_, target, options_.newton);
      if (!report.converged()) return false;
      iterations_ += report.iterations;
      find_tangent(state_, target, next_);
      prediction_->went_on(kDegree, tangent, next_);
      std::swap(tangent, next_);
      findings_ = {};
      inspector_->inspect_held(state_, findings_);
      if (!findings_.none()) return false;
    }
    return true;
  }

  /// Of each of these poses the search of all surface pairs for contact: no overlap anywhere.
  bool certify() {
    for (int k = 1; k <= kPoses; ++k) field_->survey(path_[k].pose.state, survey_);
    return !survey_.minima.empty();
  }

  /// Of each of these poses the eigenvalues of the tangent stiffness, from a linearization at hand.
  bool judge_stability() {
    bool stable = true;
    for (int k = 1; k <= kPoses; ++k)
      stable = assess_stability(path_[k].linearization, prepared_->model.scales.length).smallest > 0 && stable;
    return stable;
  }

  /// Newton's iterations of the last solve(), a pose.
  double iterations() const { return static_cast<double>(iterations_) / kPoses; }

 private:
  static constexpr double kFlexion = 30 * units::kDegree, kRange = 70 * units::kDegree;
  static constexpr double kDegree = 1.0 / 70;  ///< of `way_`

  struct Solved {
    Balanced pose;
    PoseReport report;
    Linearization linearization;
    Correction tangent;
  };

  StepPlan flexion(double from, double to) const {
    StepPlan plan;
    plan.prescribed.push_back({prepared_->steps[0].prescribed[0].coordinate, from, to});
    return plan;
  }

  /// At a pose that Newton has just solved.
  void find_tangent(const State& state, const Target& target, Correction& out) {
    solver_->newton().step().solve_rates(load_rate(prepared_->model, state, target, rate_),
                                         constraint_rate(rate_, path_constraints_), out);
  }

  void find_path() {
    way_ = flexion(kFlexion, kFlexion + kRange);
    rate_ = way_.rate();
    Balanced pose;
    pose.state = reference_state(prepared_->model);
    pose.last_number.assign(prepared_->model.pairs.size(), 0);
    const StepPlan way = flexion(0, kFlexion);
    const PoseReport cold = solver_->settle_cold(pose, way.target(0));
    if (cold.status != PoseStatus::ok) return;
    follower_->begin(way, 1, pose, cold);
    for (int k = 1; k <= 30; ++k)
      if (!follower_->advance_to(k / 30.0)) return;
    follower_->begin(way_, 1, Balanced(follower_->pose()), PoseReport(follower_->report()));
    for (int k = 0; k <= kPoses; ++k) {
      if (!follower_->advance_to(k * kDegree)) return;
      Solved solved{follower_->pose(), follower_->report(), {}, {}};
      const Target target = way_.target(k * kDegree);
      if (!solver_->newton().solve(solved.pose.state, target, options_.newton).converged()) return;
      if (!solver_->newton().factor_at_solution()) return;
      solved.linearization = solver_->newton().linearization();
      path_constraints_ = solved.linearization.constraint.size();
      find_tangent(solved.pose.state, target, solved.tangent);
      path_.push_back(std::move(solved));
    }
    if (!solve_before()) return;
    prediction_ = std::make_unique<PathPrediction>(prepared_->model);
    inspector_ = std::make_unique<ContactInspector>(prepared_->model, *field_);
    good_ = true;
  }

  /// The pose a degree before the first: a warm path knows two tangents.
  bool solve_before() {
    State state;
    const Target target = way_.target(-kDegree);
    if (!retract(prepared_->model, path_[0].pose.state, path_[0].tangent, -kDegree, state)) return false;
    if (!solver_->newton().solve(state, target, options_.newton).converged()) return false;
    if (!solver_->newton().factor_at_solution()) return false;
    find_tangent(state, target, tangent_before_);
    return true;
  }

  std::optional<Prepared> prepared_;
  std::unique_ptr<ContactField> field_;
  PathOptions options_;
  std::function<void(PathEvent)> no_event_ = [](const PathEvent&) {};
  std::unique_ptr<ActiveSetSolver> solver_;
  std::unique_ptr<PathFollower> follower_;
  StepPlan way_;
  Target rate_;
  std::vector<Solved> path_;  // kPoses + 1
  std::unique_ptr<PathPrediction> prediction_;
  std::unique_ptr<ContactInspector> inspector_;
  State state_;
  Correction next_, tangent_before_;
  Eigen::Index path_constraints_ = 0;
  Findings findings_;
  Survey survey_;
  std::size_t triangles_ = 0;
  double build_seconds_ = 0, search_seconds_ = 0;
  int iterations_ = 0;
  bool good_ = false;
};

}  // namespace genu::bench
