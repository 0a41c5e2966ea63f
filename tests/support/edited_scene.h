// A scene with one of its parameters changed, and a solved pose of it solved again: what derivatives are held to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "genu/assemble/build_surface.h"
#include "genu/equilibrium/active_set.h"
#include "genu/model/build_model.h"
#include "genu/model/ligament_pieces.h"
#include "genu/model/parameters.h"
#include "genu/results/pose_table.h"
#include "support/moved_surface.h"

namespace genu::test {

/// Adds `delta` (SI) to a number that a scene says; `offset`, `factor` and `prescribed` are none.
inline void edit(SceneTables& scene, const Parameter& p, double delta) {
  if (double* number = parameter_number(scene, p)) *number += delta;
}

/// The surface of an edited scene: rebuilt where it has a formula, else the one it had; moved where it is the offset.
inline std::shared_ptr<const Surface> edited_surface(const SceneTables& scene, std::size_t k,
                                                     const std::shared_ptr<const Surface>& before, const Parameter& p,
                                                     double delta) {
  const bool own = p.of_surface() && p.object == static_cast<int>(k);
  if (own && p.kind == Parameter::Kind::offset) return std::make_shared<MovedSurface>(before, delta, Vec3::Zero());
  if (own && scene.surfaces[k].shape == SurfaceDef::Shape::mesh)
    return std::make_shared<MovedSurface>(before, 0, delta * Vec3::Unit(p.component));
  std::shared_ptr<const Surface> rebuilt = make_analytic_surface(scene.surfaces[k]);
  return rebuilt ? rebuilt : before;
}

/// Numbers of results.csv for a pose, by column.
inline std::map<std::string, double> numbers_of(const PlacedScene& scene, const JointModel& model,
                                                const std::vector<StepPlan>& steps, const PosePoint& point) {
  PoseRecord record{point, std::vector<double>(model.pairs.size(), std::numeric_limits<double>::quiet_NaN())};
  for (const ActiveContact& c : point.pose.state.contacts) record.pair_gap[static_cast<std::size_t>(c.pair)] = 0;
  for (const OpenContact& c : point.pose.open) {
    double& gap = record.pair_gap[static_cast<std::size_t>(c.pair)];
    if (!(gap <= c.gap)) gap = c.gap;
  }
  for (std::size_t pair = 0; pair < record.pair_gap.size(); ++pair)  // of pairs that never touched
    if (std::isnan(record.pair_gap[pair]))
      record.pair_gap[pair] = ContactField(model).smallest_gap(point.pose.state, static_cast<int>(pair));
  const ResultTable table = pose_table(scene, model, steps, {record});
  std::map<std::string, double> out;
  for (const std::string& column : table.columns()) out[column] = table.number(0, column);
  return out;
}

/// The numbers of a solved pose of `scene` after `delta` (SI) is added to a parameter: the same contacts, Newton's
/// method to rounding from where the pose was.
inline std::map<std::string, double> solved_again(PlacedScene scene,
                                                  const std::vector<std::shared_ptr<const Surface>>& surfaces,
                                                  const std::vector<StepPlan>& steps, PosePoint point,
                                                  const Parameter& p, double delta) {
  edit(scene, p, delta);
  std::vector<std::shared_ptr<const Surface>> edited;
  for (std::size_t k = 0; k < surfaces.size(); ++k) edited.push_back(edited_surface(scene, k, surfaces[k], p, delta));
  Diagnostics out;
  const auto model = build_model(scene, edited, out);
  EXPECT_TRUE(model.has_value()) << p.name;
  if (!model) return {};
  if (p.kind == Parameter::Kind::factor) point.target.load_factors[static_cast<std::size_t>(p.object)] += delta;
  for (auto& prescribed : point.target.prescribed)
    if (p.kind == Parameter::Kind::prescribed && prescribed.coordinate == p.quantity) prescribed.value += delta;
  for (ActiveContact& c : point.pose.state.contacts) {
    const auto& pair = model->pairs[static_cast<std::size_t>(c.pair)];
    EXPECT_TRUE(pair.a->project(c.geometry.a.p, c.geometry.a) && pair.b->project(c.geometry.b.p, c.geometry.b));
  }
  settle_wraps(*model, point.pose.state);  // round the edited surfaces
  NewtonOptions options;
  options.residual_tolerance = 1e-15;  // as far as rounding lets it fall
  Newton newton(*model);
  const NewtonReport report = newton.solve(point.pose.state, point.target, options);
  EXPECT_TRUE(report.converged()) << p.name << ": " << to_string(report.outcome) << ", " << report.residual;
  if (!point.pose.open.empty()) {
    ContactField field(*model);
    ActiveSetSolver(*model, field, options).follow_open(point.pose);
  }
  return numbers_of(scene, *model, steps, point);
}

}  // namespace genu::test
