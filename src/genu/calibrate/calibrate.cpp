#include "genu/calibrate/calibrate.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "genu/assemble/refuse_option.h"
#include "genu/assemble/scene_values.h"
#include "genu/assemble/with_numbers.h"
#include "genu/calibrate/calibration_design.h"
#include "genu/calibrate/calibration_forward.h"
#include "genu/calibrate/calibration_reader.h"
#include "genu/calibrate/calibration_report.h"
#include "genu/study/run_motion.h"

namespace genu {
namespace {

/// Whether the scene's text can take the values: said before anything is fitted.
bool can_be_written(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns,
                    const std::optional<std::string>& folder, Diagnostics& out) {
  const auto values = numbers_at(unknowns, VecX::Zero(static_cast<Eigen::Index>(unknowns.size())));
  return !with_values(prepared.scene.file, prepared.scene, values, folder.value_or("."), out).empty() &&
         !out.has_errors();
}

/// `start` gets what the scene's own numbers give, or shorter lengths.
bool can_be_fitted(const CalibrationProblem& problem, const std::string& scene, SolvableStart& start,
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
  start = solvable_start(problem, VecX::Zero(static_cast<Eigen::Index>(problem.unknowns().size())));
  if (start.at.residuals.size() == 0)
    out.error(Code::not_solved, scene, "cannot be fitted from these values: " + start.at.failed);
  else if (!std::isfinite(start.at.residuals.squaredNorm()))
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

using Files = std::vector<std::pair<std::string, std::string>>;

/// With `study`, the study that draws the fitted numbers beside the scene; it may be empty.
int write_calibration(const std::string& folder, const RunOptions& options, const Prepared& fitted,
                      const std::vector<NewNumber>& numbers, Files files,
                      const std::function<std::string(const std::string& scene)>& study, Diagnostics& out,
                      CalibrationResult& result) {
  result.solution.folder = folder_for(folder, options, result.solution.summary);
  const std::string text = with_values(fitted.scene.file, fitted.scene, numbers, result.solution.folder, out);
  if (out.has_errors()) return kExitFailed;
  files.emplace_back("scene.toml", text);
  if (const std::string sweep = study ? study(text) : ""; !sweep.empty()) files.emplace_back("study.toml", sweep);
  const std::string error = write_results(result.solution.folder, fitted, result.solution, files);
  if (error.empty()) return result.solution.summary.exit_code;
  out.error(Code::cannot_write, {}, error);
  return kExitFailed;
}

/// Options that are of no use without others.
void refuse_lonely(const CalibrationChoice& choice, Diagnostics& out) {
  const auto refuse = [&](bool lonely, const char* option, const char* rule) {
    if (lonely) out.add(error_at({}, Code::conflict, option, {}, rule));
  };
  refuse(!choice.zero_load.correction.empty() && choice.zero_load.poses.empty(), "--correction", "needs --zero-load");
  refuse(!choice.narrow.empty() && choice.candidates.empty(), "--narrow", "needs --design");
  refuse(!choice.held_out.empty() && choice.targets.empty(), "--predict", "needs --target");
  refuse(!choice.predict_columns.empty() && choice.held_out.empty(), "--predict-columns", "needs --predict");
}

/// Names of --narrow that are none of the unknowns.
void refuse_unknown_names(const CalibrationChoice& choice, const std::vector<CalibrationUnknown>& unknowns,
                          Diagnostics& out) {
  std::vector<std::string> known;
  for (const CalibrationUnknown& u : unknowns) known.push_back(u.name);
  for (const std::string& name : choice.narrow) {
    const auto same = [&](const std::string& k) { return name == k || matches(name, k); };
    if (std::none_of(known.begin(), known.end(), same))
      refuse_option(out, Code::unknown_name, "--narrow", name,
                    "is no number that --vary names: those are " + fmt::format("{}", fmt::join(known, ", ")));
  }
}

/// Ranks what could be measured, beside what is.
void add_design(const CalibrationChoice& choice, const std::vector<CalibrationUnknown>& unknowns, const VecX& u,
                const MatX& J, const std::vector<DesignCandidate>& candidates, Files& files,
                CalibrationResult& result) {
  if (candidates.empty()) return;
  const MatX information = J.rows() > 0 ? MatX(J.transpose() * J) : MatX(MatX::Zero(u.size(), u.size()));
  const CalibrationDesign design = rank_candidates(unknowns, u, information, candidates, choice.narrow);
  result.text += design.text;
  files.emplace_back("design.csv", design.ranked.to_csv());
  files.emplace_back("design_order.csv", design.order.to_csv());
}

/// Nothing is followed: the rule's lengths, and what could be measured first.
int without_fit(const Prepared& prepared, const std::optional<std::string>& folder, const CalibrationProblem& problem,
                const CalibrationExperiments& experiments, const CalibrationChoice& choice, const RunOptions& options,
                Files files, Diagnostics& out, CalibrationResult& result) {
  const VecX u = VecX::Zero(static_cast<Eigen::Index>(problem.unknowns().size()));
  const std::vector<NewNumber> numbers = numbers_at(problem.unknowns(), u);
  const auto scene = with_numbers(prepared, numbers, out);
  if (!scene) return kExitIncomplete;
  add_design(choice, problem.unknowns(), u, problem.at(u, true).derivatives, experiments.candidates, files, result);
  result.solution = solve_fitted(*scene, options);
  RunSummary& s = result.solution.summary;
  s.verdict.emplace_back(choice.zero_load.poses.empty()
                             ? "Nothing is fitted."
                             : "Zero-load lengths are those of the rule: longest length times correction.");
  return folder ? write_calibration(*folder, options, *scene, numbers, files, {}, out, result) : s.exit_code;
}

/// The study's text for a scene's text; needs a fit of equilibria.
std::function<std::string(const std::string&)> study_of(const Prepared& fitted,
                                                        const std::vector<CalibrationUnknown>& unknowns,
                                                        const CalibrationFindings& found) {
  return [&](const std::string& scene) {
    VecX deviations = found.covariance.diagonal().cwiseSqrt();
    const auto& parameters = found.report.parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k)
      if (!std::isfinite(parameters[k].deviation)) deviations[static_cast<Eigen::Index>(k)] = parameters[k].deviation;
    return sweep_study(fitted, "scene.toml", scene, unknowns, deviations, found.report.correlation);
  };
}

/// Adds the fit to the verdict of the scene's results: in the headline where it cannot be right.
void say_fit(const CalibrationProblem& problem, CalibrationResult& result) {
  const CalibrationReport& report = result.report;
  RunSummary& s = result.solution.summary;
  const auto infinite = [](const auto& p) { return !std::isfinite(p.deviation); };
  const bool determined = std::none_of(report.parameters.begin(), report.parameters.end(), infinite);
  const bool right = report.converged && report.misfit.empty();
  std::string sentence =
      fmt::format("{} numbers fitted to {} values; {}", report.parameters.size(), problem.target_rows(), report.stop);
  if (!report.misfit.empty()) sentence += "; " + report.misfit;
  s.verdict.insert(right ? s.verdict.end() : s.verdict.begin(), sentence + ".");
  if (!right && s.verdict_class == RunSummary::Class::solved) s.verdict_class = RunSummary::Class::doubtful;
  if (!right && s.exit_code == kExitOk) s.exit_code = kExitDoubtful;
  if (!report.converged || !determined) s.exit_code = kExitIncomplete;
}

}  // namespace

int run_calibration(const SceneSource& source, const std::optional<std::string>& folder,
                    const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out,
                    CalibrationResult& result) {
  std::vector<std::string> inputs = choice.candidates;
  inputs.insert(inputs.end(), choice.zero_load.poses.begin(), choice.zero_load.poses.end());
  for (const auto* list : {&choice.targets, &choice.held_out})
    for (const std::string& target : *list) inputs.push_back(parts_of_target(target).second);
  auto prepared = prepare_run(source, folder, out, inputs);
  if (!prepared) return kExitRefused;
  share_search(*prepared);
  refuse_lonely(choice, out);
  std::vector<CalibrationUnknown> unknowns = choose_unknowns(prepared->source, {choice.vary, {}, {}}, out);
  if (!unknowns.empty()) refuse_unknown_names(choice, unknowns, out);
  Files files;
  if (!choice.zero_load.poses.empty() && !out.has_errors())
    if (const auto table = start_at_zero_load(*prepared, choice.zero_load, unknowns, out)) {
      files.emplace_back("zero_load.csv", table->to_csv());
      result.text += to_text(*table, table->columns(), 3, table->rows()) + "\n";
    }
  set_limits(prepared->source, {{}, choice.bounds, choice.priors}, unknowns, out);
  const CalibrationExperiments experiments = read_experiments(*prepared, unknowns, choice, options, out);
  if (out.has_errors() || !can_be_written(*prepared, unknowns, folder, out)) return kExitRefused;
  ContactField field = contact_field(*prepared);
  if (!check_start(*prepared, field, out)) return kExitRefused;

  // Where the errors of a central difference, one of its length and one of what it divides, are alike.
  const double error = prepared->scene.dynamics ? prepared->scene.dynamics->tolerance : 1e-12;
  const CalibrationProblem problem(unknowns, experiments.followed, std::clamp(std::cbrt(error), 1e-4, 1e-2));
  if (choice.targets.empty() && !(files.empty() && experiments.candidates.empty()))
    return without_fit(*prepared, folder, problem, experiments, choice, options, files, out, result);
  SolvableStart start;
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
  add_design(choice, unknowns, found.fit.x, found.jacobian, experiments.candidates, files, result);
  RunSummary& s = result.solution.summary;
  say_fit(problem, result);
  if (!folder) return s.exit_code;
  files.emplace_back("calibration.csv", calibration_table(result.report).to_csv());
  files.emplace_back("comparison.csv", findings.comparison.to_csv());
  files.emplace_back("starts.csv", starts_table(result.report).to_csv());
  if (!fitted->scene.dynamics)
    files.emplace_back("standard_errors.csv", result_errors(ScenesUnknowns(*prepared, unknowns), *fitted, found.fit.x,
                                                            result.solution.records, findings.covariance)
                                                  .to_csv());
  files.insert(files.end(), findings.pictures.begin(), findings.pictures.end());
  return write_calibration(*folder, options, *fitted, numbers, files, study_of(*fitted, unknowns, findings), out,
                           result);
}

}  // namespace genu
