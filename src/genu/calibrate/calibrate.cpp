#include "genu/calibrate/calibrate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/assemble/refuse_option.h"
#include "genu/assemble/scene_values.h"
#include "genu/calibrate/calibration_report.h"
#include "genu/calibrate/finite_number.h"
#include "genu/calibrate/laxity_experiment.h"
#include "genu/calibrate/run_experiment.h"
#include "genu/results/motion_table.h"
#include "genu/scene/words.h"
#include "genu/study/run_motion.h"

namespace genu {
namespace {

using Experiments = std::vector<std::unique_ptr<CalibrationExperiment>>;

double duration_of(const Prepared& prepared) {
  if (prepared.scene.dynamics) return prepared.scene.dynamics->duration;
  double sum = 0;
  for (const StepDef& step : prepared.scene.steps) sum += step.duration;
  return sum;
}

std::vector<std::string> known_columns(const Prepared& p) {
  return (p.scene.dynamics ? motion_table(p.scene, p.model, {}) : pose_table(p.scene, p.model, p.steps, {})).columns();
}

/// "SCENE" and "FILE" of "SCENE=FILE"; the scene is empty where there is none.
std::pair<std::string, std::string> parts_of(const std::string& target) {
  const std::size_t equals = target.find('=');
  if (equals == std::string::npos) return {"", target};
  return {target.substr(0, equals), target.substr(equals + 1)};
}

/// "NAME=SIGMA" texts; others are refused.
std::vector<std::pair<std::string, double>> errors_of(const std::vector<std::string>& texts, Diagnostics& out) {
  std::vector<std::pair<std::string, double>> errors;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const auto value = equals == std::string::npos ? std::nullopt : finite_number(text.substr(equals + 1));
    if (value && *value > 0)
      errors.emplace_back(text.substr(0, equals), *value);
    else
      refuse_option(out, Code::out_of_range, "--error", text, "must be COLUMN=SIGMA with a number above 0");
  }
  return errors;
}

/// The measured things that a fit follows, each with its scene.
class ExperimentReader {
 public:
  ExperimentReader(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns,
                   const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out)
      : prepared_(prepared), unknowns_(unknowns), choice_(choice), options_(options), out_(out) {}

  Experiments read() {
    for (const std::string& target : choice_.targets) add(target, false);
    for (const std::string& target : choice_.held_out) add(target, true);
    if (!out_.has_errors()) state_errors();
    return std::move(experiments_);
  }

 private:
  void add(const std::string& target, bool held_out) {
    const auto [scene, file] = parts_of(target);
    std::unique_ptr<CalibrationExperiment> made;
    if (scene.empty()) {
      made = read(prepared_, file);
    } else if (auto other = prepare({scene, {}}, out_)) {
      share_search(*other);
      if (ScenesUnknowns(*other, unknowns_).none())
        out_.error(Code::unknown_name, scene, "has none of the numbers that --vary names");
      else
        made = read(*other, file);
    }
    if (!made) return;
    made->file = file;
    made->held_out = held_out;
    experiments_.push_back(std::move(made));
  }

  std::unique_ptr<CalibrationExperiment> read(const Prepared& scene, const std::string& file) {
    const std::vector<std::string> known = known_columns(scene);
    if (!is_laxity_table(file)) {
      auto target = read_calibration_target(file, choice_.columns, known, duration_of(scene), out_, axes_of(scene));
      return target ? run_experiment(scene, unknowns_, std::move(*target), options_) : nullptr;
    }
    auto target = read_laxity_target(file, choice_.columns, known, out_);
    auto knee = with_laxity_loads(scene, out_);
    if (!target || !knee) return nullptr;
    share_search(knee->prepared);
    return laxity_experiment(*knee, unknowns_, std::move(*target), choice_.compression, options_.cancelled);
  }

  /// All columns have a stated error, or none has; a prior needs them.
  void state_errors() {
    const auto errors = errors_of(choice_.errors, out_);
    std::string without;
    bool any = false;
    std::vector<bool> used(errors.size());
    for (const auto& e : experiments_) {
      e->state_errors(errors);
      for (const auto& column : e->columns()) {
        any = any || column.stated;
        if (!column.stated && !e->held_out) without = column.name;
        for (std::size_t k = 0; k < errors.size(); ++k) used[k] = used[k] || matches(errors[k].first, column.name);
      }
    }
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (!used[k])
        refuse_option(out_, Code::unknown_name, "--error", errors[k].first, "is no column that a target follows");
    const bool priors = std::any_of(unknowns_.begin(), unknowns_.end(), [](const auto& u) { return u.prior; });
    if (without.empty() || !(any || priors)) return;
    out_.add(error_at({}, Code::missing_key, "--error", {},
                      "is missing for " + without +
                          (any ? ": state the error of every column, or of none"
                               : ": a prior can be weighed against measurements only if their errors are stated")));
  }

  const Prepared& prepared_;
  const std::vector<CalibrationUnknown>& unknowns_;
  const CalibrationChoice& choice_;
  const RunOptions& options_;
  Diagnostics& out_;
  Experiments experiments_;
};

/// Whether the scene's text can take the values: said before anything is fitted.
bool can_be_written(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns,
                    const std::optional<std::string>& folder, Diagnostics& out) {
  const auto values = numbers_at(unknowns, VecX::Zero(static_cast<Eigen::Index>(unknowns.size())));
  return !with_values(prepared.scene.file, prepared.scene, values, folder.value_or("."), out).empty() &&
         !out.has_errors();
}

/// `start` gets what the scene's own numbers give.
bool can_be_fitted(const CalibrationProblem& problem, const std::string& scene, CalibrationProblem::At& start,
                   Diagnostics& out) {
  std::size_t priors = 0;
  std::string file;
  for (const auto& u : problem.unknowns()) priors += u.prior ? 1 : 0;
  for (const auto& e : problem.experiments())
    if (!e->held_out) file = e->file;
  const auto values = static_cast<std::size_t>(problem.target_rows());
  if (values == 0)
    out.add(error_at({}, Code::missing_key, "--target", {}, "names no file: there is nothing to follow"));
  if (values > 0 && values + priors < problem.unknowns().size())
    out.error(
        Code::missing_key, file,
        fmt::format("holds {} values, fewer than the {} numbers to be fitted", values, problem.unknowns().size()));
  if (out.has_errors()) return false;
  start = problem.at(VecX::Zero(static_cast<Eigen::Index>(problem.unknowns().size())), true);
  if (start.residuals.size() == 0)
    out.error(Code::not_solved, scene, "cannot be fitted from these values: " + start.failed);
  else if (!std::isfinite(start.residuals.squaredNorm()))
    out.error(Code::out_of_range, file,
              "cannot be fitted: beside its values, or how they differ, the scene's are beyond all numbers");
  return !out.has_errors();
}

Solution solve_fitted(const Prepared& fitted, const RunOptions& options) {
  RunOptions plain;
  plain.path = options.path;
  plain.cancelled = options.cancelled;
  if (fitted.scene.dynamics) return solve_motion(fitted, plain);
  ContactField field = contact_field(fitted);
  return solve(fitted, field, plain);
}

int write_calibration(const std::string& folder, const RunOptions& options, const Prepared& fitted,
                      const std::vector<NewNumber>& numbers, const CalibrationFindings& found, Diagnostics& out,
                      CalibrationResult& result) {
  result.solution.folder = folder_for(folder, options, result.solution.summary);
  const std::string text = with_values(fitted.scene.file, fitted.scene, numbers, result.solution.folder, out);
  if (out.has_errors()) return kExitFailed;
  std::vector<std::pair<std::string, std::string>> files = {
      {"scene.toml", text},
      {"calibration.csv", calibration_table(result.report).to_csv()},
      {"comparison.csv", found.comparison.to_csv()},
      {"starts.csv", starts_table(result.report).to_csv()}};
  files.insert(files.end(), found.pictures.begin(), found.pictures.end());
  const std::string error = write_results(result.solution.folder, fitted, result.solution, files);
  if (error.empty()) return result.solution.summary.exit_code;
  out.error(Code::cannot_write, {}, error);
  return kExitFailed;
}

}  // namespace

int run_calibration(const SceneSource& source, const std::optional<std::string>& folder,
                    const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out,
                    CalibrationResult& result) {
  std::vector<std::string> inputs;
  for (const auto* list : {&choice.targets, &choice.held_out})
    for (const std::string& target : *list) inputs.push_back(parts_of(target).second);
  auto prepared = prepare_run(source, folder, out, inputs);
  if (!prepared) return kExitRefused;
  share_search(*prepared);
  const std::vector<CalibrationUnknown> unknowns =
      choose_unknowns(prepared->source, {choice.vary, choice.bounds, choice.priors}, out);
  const Experiments experiments = ExperimentReader(*prepared, unknowns, choice, options, out).read();
  if (out.has_errors() || !can_be_written(*prepared, unknowns, folder, out)) return kExitRefused;
  ContactField field = contact_field(*prepared);
  if (!check_start(*prepared, field, out)) return kExitRefused;

  // Where the errors of a central difference, one of its length and one of what it divides, are alike.
  const double error = prepared->scene.dynamics ? prepared->scene.dynamics->tolerance : 1e-12;
  const CalibrationProblem problem(unknowns, experiments, std::clamp(std::cbrt(error), 1e-4, 1e-2));
  CalibrationProblem::At start;
  if (!can_be_fitted(problem, source.path, start, out)) return kExitRefused;
  const CalibrationSearch found =
      search(problem, {choice.most_iterations, choice.starts, choice.spread, options.cancelled}, start);
  if (found.jacobian.size() == 0 || found.at_end.residuals.size() == 0) {
    out.error(Code::not_solved, source.path, std::string("is not fitted: ") + to_string(found.fit.stop));
    return kExitIncomplete;
  }
  const std::vector<NewNumber> numbers = numbers_at(unknowns, found.fit.x);
  const auto fitted = with_numbers(*prepared, numbers, out);
  if (!fitted) return kExitIncomplete;
  result.solution = solve_fitted(*fitted, options);
  const CalibrationFindings findings = find_out(problem, found);
  result.report = findings.report;
  result.report.runs = problem.runs();
  RunSummary& s = result.solution.summary;
  s.verdict.push_back(
      fmt::format("{} numbers fitted to {} values; {}.", unknowns.size(), problem.target_rows(), result.report.stop));
  const auto infinite = [](const auto& p) { return !std::isfinite(p.deviation); };
  const auto& parameters = result.report.parameters;
  if (!result.report.converged || std::any_of(parameters.begin(), parameters.end(), infinite))
    s.exit_code = kExitIncomplete;
  return folder ? write_calibration(*folder, options, *fitted, numbers, findings, out, result) : s.exit_code;
}

}  // namespace genu
