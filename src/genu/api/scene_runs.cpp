// What is asked of a scene: runs, poses from elsewhere, derivatives, the equations for another solver.
#include <cmath>

#include <fmt/format.h>

#include "genu/api/results_of.h"
#include "genu/api/scene_inside.h"
#include "genu/api/table_of.h"
#include "genu/core/units.h"
#include "genu/model/generalised_forces.h"
#include "genu/scene/words.h"
#include "genu/study/evaluate.h"
#include "genu/study/laxity.h"
#include "genu/study/laxity_table.h"
#include "genu/study/run_motion.h"
#include "genu/study/sensitivity.h"

namespace genu::api {

genu::RunOptions options_of(const RunOptions& options) {
  genu::RunOptions out;
  out.error_bars = options.error_bars;
  out.progress = options.progress;
  out.varied_progress = options.progress;
  out.cancelled = options.cancelled;
  return out;
}

Results Scene::run(const RunOptions& options) const {
  const auto ready = inside_->assembled();
  Diagnostics out;
  const genu::RunOptions how = options_of(options);
  auto found = use(*ready, [&](const Prepared& prepared) {
    return prepared.scene.dynamics ? move_all(prepared, how, out) : solve_all(prepared, how, out);
  });
  check(out);
  return results_of(ready, std::move(*found), changes());
}

namespace {

/// The columns as the text of a table: what is wrong with a cell is found where the program finds it.
PoseFile file_of(const Poses& poses) {
  PoseFile file;
  file.path = "poses";
  file.names.line = 1;
  for (const std::string& name : poses.names) file.names.cells.push_back({name, 1});
  if (!poses.status.empty()) file.names.cells.push_back({"status", 1});
  const std::size_t rows = poses.columns.empty() ? 0 : poses.columns.front().size();
  for (std::size_t r = 0; r < rows; ++r) {
    PoseFile::Row row{static_cast<int>(r) + 2, {}};
    for (const auto& column : poses.columns) row.cells.push_back({fmt::format("{}", column[r]), 1});
    if (!poses.status.empty()) row.cells.push_back({poses.status[r], 1});
    file.rows.push_back(std::move(row));
  }
  return file;
}

void check_shape(const Poses& poses) {
  if (poses.names.size() != poses.columns.size())
    refuse(Code::wrong_form, "poses", {},
           fmt::format("have {} names and {} columns", poses.names.size(), poses.columns.size()));
  if (poses.columns.empty() || poses.columns.front().empty()) refuse(Code::missing_key, "poses", {}, "have no row");
  if (!poses.status.empty() && poses.status.size() != poses.columns.front().size())
    refuse(Code::wrong_form, "poses", "\"status\"",
           fmt::format("has {} rows, and {} has {}", poses.status.size(), poses.names.front(),
                       poses.columns.front().size()));
  for (std::size_t k = 0; k < poses.names.size(); ++k)
    if (poses.columns[k].size() != poses.columns.front().size())
      refuse(Code::wrong_form, "poses", with_quotes(poses.names[k]),
             fmt::format("has {} rows, and {} has {}", poses.columns[k].size(), poses.names.front(),
                         poses.columns.front().size()));
}

}  // namespace

Results Scene::evaluate(const Poses& poses, const std::function<bool()>& cancelled) const {
  check_shape(poses);
  const auto ready = inside_->assembled();
  Diagnostics out;
  EvaluateOptions options;
  options.columns.units = poses.units;
  options.cancelled = cancelled;
  auto found = use(*ready, [&](const Prepared& prepared) -> std::optional<Evaluation> {
    if (refuse_motion(prepared, "evaluate", out)) return std::nullopt;
    return evaluate_file(prepared, file_of(poses), options, out);
  });
  check(out);
  return results_of(ready, std::move(found->records), std::move(found->poses), std::move(found->summary), changes());
}

Sensitivity Scene::sensitivity(const std::vector<std::string>& of, const std::vector<std::string>& to,
                               const RunOptions& options) const {
  if (!inside_->laws.empty())
    refuse(Code::not_applicable, "sensitivity", {}, "has no derivatives of a law of your own");
  const auto ready = inside_->assembled();
  Diagnostics out;
  SensitivityResult found;
  use(*ready, [&](const Prepared& prepared) {
    return solve_and_differentiate(prepared, {of, to}, options_of(options), out, found);
  });
  check(out);
  const SensitivityRows& rows = found.rows;
  Sensitivity result{results_of(ready, std::move(found.solution), changes()), {}, {}, {}, {}, rows.derivatives, {}, {}};
  for (const Output& o : rows.outputs) result.of.push_back(o.column), result.of_units.push_back(o.unit);
  for (const Parameter& p : rows.parameters) {
    result.to.push_back(p.name);
    result.to_units.push_back(p.unit);
    result.changes.push_back(p.change_text);
  }
  for (std::size_t r = 0; r < rows.rows(); ++r)
    for (std::size_t o = 0; o < rows.outputs.size(); ++o)
      for (std::size_t p = 0; p < rows.parameters.size(); ++p) result.effects.push_back(rows.effect(r, o, p));
  return result;
}

namespace {

/// Throws for what the command line does not take either.
LaxityChoice choice_of(const LaxityOptions& options) {
  LaxityChoice choice;
  const auto number = [](const char* key, double value, double least, double most) {
    if (!(value >= least && value <= most))
      refuse(Code::out_of_range, key, fmt::format("{:.6g}", value),
             fmt::format("must be from {:g} to {:g}", least, most));
    return value;
  };
  constexpr double kMostLoad = 1e5, kMostAngle = 180, kMostIncrements = 1000;
  for (const double angle : options.at)
    choice.flexions.push_back(units::kDegree * number("at", angle, -kMostAngle, kMostAngle));
  const auto add = [&](LaxityTest::Kind kind, const char* key, double load) {
    if (number(key, load, 0, kMostLoad) > 0) choice.tests.push_back({kind, load});
  };
  add(LaxityTest::Kind::drawer, "anterior", options.anterior);
  add(LaxityTest::Kind::varus, "varus", options.varus);
  add(LaxityTest::Kind::rotation, "internal", options.internal);
  if (choice.flexions.empty() || choice.tests.empty())
    refuse(Code::missing_key, "laxity", {}, "needs a flexion angle and a load above 0");
  choice.compression = number("compression", options.compression, 0, kMostLoad);
  choice.increments = static_cast<int>(number("increments", options.increments, 1, kMostIncrements));
  choice.cancelled = options.cancelled;
  return choice;
}

}  // namespace

Laxity Scene::laxity(const LaxityOptions& options) const {
  const LaxityChoice choice = choice_of(options);
  const auto ready = inside_->assembled();
  Diagnostics out;
  LaxityResult found;
  const int code = use(*ready, [&](const Prepared& prepared) { return test_laxity(prepared, choice, out, found); });
  check(out);
  return {table_of(laxity_rows(found.scenes)), table_of(laxity_summary(found.scenes)), code == kExitOk, found.verdict,
          found.text};
}

std::vector<double> Scene::start() const {
  const auto ready = inside_->assembled();
  const JointModel& model = ready->prepared.model;
  const State start = start_state(model);
  std::vector<double> values;
  for (const CoordinateRef& c : free_coordinates(model)) values.push_back(start.coordinates[at(c.joint)][at(c.index)]);
  return values;
}

namespace {

std::vector<double> factors_of(const Prepared& prepared, const Loading& loading) {
  std::vector<double> factors(prepared.scene.loads.size(), 1.0);
  std::vector<std::string> known;
  for (const LoadDef& load : prepared.scene.loads) known.push_back(load.name);
  for (const auto& [name, factor] : loading.factors) {
    const auto place = std::find(known.begin(), known.end(), name);
    if (place == known.end())
      refuse(Code::unknown_name, "factors", with_quotes(name), "is no load of this scene" + did_you_mean(name, known));
    if (!std::isfinite(factor))
      refuse(Code::out_of_range, "factors." + name, fmt::format("{}", factor), "must be finite");
    factors[static_cast<std::size_t>(place - known.begin())] = factor;
  }
  for (const StepDef& step : prepared.scene.steps)
    for (const StepDef::Prescribed& p : step.prescribe)
      for (const int driver : p.drivers)
        if (const std::string& name = known[at(driver)]; !loading.factors.contains(name))
          refuse(Code::missing_key, "factors." + name, {},
                 "is needed: the load drives " + quantity_name(prepared.scene, p.coordinate) +
                     ", so its factor is an unknown of every pose");
  return factors;
}

/// Throws where the scene or the values have no such forces.
GeneralisedForces forces_at(const Prepared& prepared, std::span<const double> q, const Loading& loading) {
  const JointModel& model = prepared.model;
  if (!model.pairs.empty())
    refuse(Code::not_applicable, "contact." + model.pairs.front().name, {},
           "is rigid: its forces are unknowns of an equilibrium, and no function of the coordinates");
  const std::size_t n = free_coordinates(model).size();
  if (q.size() != n)
    refuse(Code::wrong_form, "q", {}, fmt::format("has {} values, and there are {} coordinates", q.size(), n));
  for (const double value : q)
    if (!std::isfinite(value)) refuse(Code::out_of_range, "q", fmt::format("{}", value), "must be finite");
  if (!std::isfinite(loading.time))
    refuse(Code::out_of_range, "time", fmt::format("{}", loading.time), "must be finite");
  Linearization memory;
  const auto found =
      generalised_forces(model, {q.begin(), q.end()}, factors_of(prepared, loading), loading.time, memory);
  if (!found) refuse(Code::not_applicable, "q", {}, "is a gimbal pose of a joint, where its angles are no coordinates");
  if (!found->forces.allFinite() || !found->derivatives.allFinite())
    refuse(Code::out_of_range, "q", {}, "is so large that forces overflow");
  return *found;
}

}  // namespace

std::vector<double> Scene::residual(std::span<const double> q, const Loading& loading) const {
  const auto ready = inside_->assembled();
  const GeneralisedForces found = use(*ready, [&](const Prepared& p) { return forces_at(p, q, loading); });
  return {found.forces.data(), found.forces.data() + found.forces.size()};
}

Matrix Scene::stiffness(std::span<const double> q, const Loading& loading) const {
  const auto ready = inside_->assembled();
  const GeneralisedForces found = use(*ready, [&](const Prepared& p) { return forces_at(p, q, loading); });
  const auto n = static_cast<std::size_t>(found.derivatives.rows());
  Matrix out{n, n, {}};
  for (Eigen::Index i = 0; i < found.derivatives.rows(); ++i)
    for (Eigen::Index j = 0; j < found.derivatives.cols(); ++j) out.values.push_back(-found.derivatives(i, j));
  return out;
}

}  // namespace genu::api
