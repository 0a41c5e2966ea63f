#include "genu/study/calibrate.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/assemble/refuse_option.h"
#include "genu/assemble/scene_values.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/least_squares.h"
#include "genu/results/motion_table.h"
#include "genu/scene/reader.h"
#include "genu/scene/words.h"
#include "genu/study/calibration_target.h"
#include "genu/study/run_motion.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// A parameter as the unknown u of the fit, 0 at the start: exp(u) times the start, or u scales more.
struct Unknown {
  Parameter parameter;
  double start = 0;  ///< SI
  double scale = 1;  ///< SI; of a parameter that is no share of itself
  bool positive = true;

  double value(double u) const { return positive ? start * std::exp(u) : start + scale * u; }
  double slope(double u) const { return positive ? value(u) : scale; }
};

void add_unknown(Scene& scene, const Parameter& p, std::vector<Unknown>& unknowns, Diagnostics& out) {
  const auto same = [&](const Unknown& u) { return u.parameter.name == p.name; };
  if (std::any_of(unknowns.begin(), unknowns.end(), same)) return;
  Unknown u{p, *parameter_number(scene, p), 1, p.positive};
  if (!u.positive) u.scale = std::max(std::abs(u.start), kUnknownScale * p.change);
  if (u.positive && !(u.start > 0))
    refuse_option(out, Code::out_of_range, "--vary", p.name,
                  "is 0: what is fitted as a share of itself must start above 0");
  unknowns.push_back(u);
}

std::vector<Unknown> choose_unknowns(Scene& scene, const std::vector<std::string>& patterns, Diagnostics& out) {
  std::vector<Unknown> unknowns;
  const std::vector<Parameter> all = parameters_of(scene);
  // Surfaces are made once, before the fit.
  const auto can_vary = [&](const Parameter& p) { return !p.of_surface() && parameter_number(scene, p) != nullptr; };
  std::vector<std::string> known;
  for (const Parameter& p : all)
    if (can_vary(p)) known.push_back(p.name);
  for (const std::string& pattern : patterns) {
    bool found = false, fixed = false;
    for (const Parameter& p : all) {
      if (!matches(scene, pattern, p.name)) continue;
      const bool can = can_vary(p);
      found = found || can;
      fixed = fixed || !can;
      if (can) add_unknown(scene, p, unknowns, out);
    }
    if (!found && fixed)
      refuse_option(out, Code::not_applicable, "--vary", pattern,
                    "cannot be fitted: numbers of ligaments, loads, bodies and joints can, as they stand in the scene");
    else if (!found)
      refuse_option(out, Code::unknown_name, "--vary", pattern,
                    "is no parameter of this scene" + did_you_mean(pattern, known));
  }
  if (patterns.empty()) out.add(error_at({}, Code::missing_key, "--vary", {}, "names no parameter"));
  return unknowns;
}

double duration_of(const Prepared& prepared) {
  if (prepared.scene.dynamics) return prepared.scene.dynamics->duration;
  double sum = 0;
  for (const StepDef& step : prepared.scene.steps) sum += step.duration;
  return sum;
}

std::vector<std::string> known_columns(const Prepared& p) {
  return (p.scene.dynamics ? motion_table(p.scene, p.model, {}) : pose_table(p.scene, p.model, p.steps, {})).columns();
}

class Calibration {
 public:
  Calibration(const Prepared& prepared, std::vector<Unknown> unknowns, CalibrationTarget target,
              const RunOptions& options)
      : prepared_(prepared), unknowns_(std::move(unknowns)), target_(std::move(target)) {
    options_.path = options.path;
    options_.cancelled = options.cancelled;
    wanted_.resize(static_cast<Eigen::Index>(target_.values.size()));
    scale_.resize(wanted_.size());
    for (Eigen::Index k = 0; k < wanted_.size(); ++k) {
      const CalibrationTarget::Value& v = target_.values[static_cast<std::size_t>(k)];
      wanted_[k] = v.value;
      scale_[k] = target_.columns[v.column].scale;
    }
    // Where the errors of a central difference, one of its length and one of what it divides, are alike.
    const double error = prepared.scene.dynamics ? prepared.scene.dynamics->tolerance : 1e-12;
    difference_ = std::clamp(std::cbrt(error), 1e-4, 1e-2);
  }

  /// The scene with other values, ready to be solved; empty where its laws cannot be.
  std::optional<Prepared> with(const VecX& u) const {
    std::vector<NewNumber> numbers;
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      numbers.emplace_back(unknowns_[k].parameter, unknowns_[k].value(u[static_cast<Eigen::Index>(k)]));
    Diagnostics unused;
    return with_numbers(prepared_, numbers, unused);
  }

  Solution solve_scene(const Prepared& p) const {
    ++runs_;
    if (p.scene.dynamics) return solve_motion(p, options_);
    ContactField field = contact_field(p);
    return solve(p, field, options_);
  }

  std::optional<VecX> residuals(const VecX& u) const {
    const auto p = with(u);
    if (!p) return std::nullopt;
    const Solution s = solve_scene(*p);
    if (s.summary.poses_solved != s.summary.poses_asked) return std::nullopt;
    auto values = values_at(target_, s.poses);
    if (!values) return std::nullopt;
    return VecX((*values - wanted_).cwiseQuotient(scale_));
  }

  /// Central differences, side by side on all threads.
  std::optional<MatX> jacobian(const VecX& u) const {
    const auto n = static_cast<std::size_t>(u.size());
    std::vector<std::optional<VecX>> beside(2 * n);
    tbb::parallel_for(std::size_t{0}, 2 * n, [&](std::size_t k) {
      VecX x = u;
      x[static_cast<Eigen::Index>(k / 2)] += k % 2 == 0 ? difference_ : -difference_;
      beside[k] = residuals(x);
    });
    MatX J(wanted_.size(), u.size());
    for (std::size_t k = 0; k < n; ++k) {
      if (!beside[2 * k] || !beside[2 * k + 1]) return std::nullopt;
      J.col(static_cast<Eigen::Index>(k)) = (*beside[2 * k] - *beside[2 * k + 1]) / (2 * difference_);
    }
    return J;
  }

  LeastSquaresResult fit(int most_iterations) const {
    LeastSquaresOptions how;
    how.most_iterations = most_iterations;
    how.most_step = kMaxLogStep;
    how.noise = kDerivativeNoise;
    return least_squares({[this](const VecX& u) { return residuals(u); }, [this](const VecX& u) { return jacobian(u); },
                          options_.cancelled},
                         VecX::Zero(static_cast<Eigen::Index>(unknowns_.size())), how);
  }

  CalibrationReport report(const LeastSquaresResult& fit, double start_cost) const {
    CalibrationReport out;
    const LeastSquaresUncertainty uncertainty =
        least_squares_uncertainty(fit.jacobian, fit.residuals, kDerivativeNoise);
    out.correlation = uncertainty.correlation;
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const Unknown& u = unknowns_[k];
      const double x = fit.x[static_cast<Eigen::Index>(k)], si = u.parameter.si;
      out.parameters.push_back({u.parameter.name, u.parameter.unit, u.start / si, u.value(x) / si,
                                uncertainty.deviation[static_cast<Eigen::Index>(k)] * std::abs(u.slope(x)) / si});
    }
    for (const VecX& v : uncertainty.undetermined) out.undetermined.push_back(direction(v));
    for (std::size_t c = 0; c < target_.columns.size(); ++c) out.columns.push_back(column(c, fit.residuals));
    out.stop = to_string(fit.stop);
    out.converged = converged(fit.stop);
    out.iterations = fit.iterations;
    out.runs = runs_;
    const auto count = static_cast<double>(fit.residuals.size());
    out.rms = std::sqrt(fit.residuals.squaredNorm() / count);
    out.start_rms = std::sqrt(start_cost / count);
    return out;
  }

  ResultTable comparison(const ResultTable& results) const {
    ResultTable table;
    for (const char* name : {"time_s", "column", "target", "scene", "difference"}) table.add_column(name);
    const auto values = values_at(target_, results);
    for (std::size_t k = 0; values && k < target_.values.size(); ++k) {
      const CalibrationTarget::Value& v = target_.values[k];
      const double scene = (*values)[static_cast<Eigen::Index>(k)];
      table.add_row();
      table.set("time_s", v.time);
      table.set("column", target_.columns[v.column].name);
      table.set("target", v.value);
      table.set("scene", scene);
      table.set("difference", v.value - scene);
    }
    return table;
  }

  std::vector<std::pair<Parameter, double>> values(const VecX& u) const {
    std::vector<std::pair<Parameter, double>> out;
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      out.emplace_back(unknowns_[k].parameter, unknowns_[k].value(u[static_cast<Eigen::Index>(k)]));
    return out;
  }

 private:
  CalibrationReport::Column column(std::size_t c, const VecX& residuals) const {
    CalibrationReport::Column out{target_.columns[c].name, 0, 0, target_.columns[c].scale};
    for (std::size_t k = 0; k < target_.values.size(); ++k) {
      if (target_.values[k].column != c) continue;
      ++out.values;
      out.rms += std::pow(residuals[static_cast<Eigen::Index>(k)] * out.scale, 2);
    }
    out.rms = std::sqrt(out.rms / static_cast<double>(std::max<std::size_t>(1, out.values)));
    return out;
  }

  /// "j1.damping", or the parameters that change together by which powers of ten.
  std::string direction(const VecX& v) const {
    std::string together;
    int count = 0;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      if (std::abs(v[k]) < kNamedComponent) continue;
      const std::string& name = unknowns_[static_cast<std::size_t>(k)].parameter.name;
      together += (count++ > 0 ? ", " : "") + fmt::format("{} {:+.2f}", name, v[k]);
      if (std::abs(v[k]) > 1 - kNamedComponent * kNamedComponent) return name;
    }
    return "a change of " + together + " together (shares of themselves)";
  }

  const Prepared& prepared_;
  std::vector<Unknown> unknowns_;
  CalibrationTarget target_;
  RunOptions options_;
  VecX wanted_, scale_;
  double difference_ = 1e-4;
  mutable std::atomic<int> runs_ = 0;
};

int write_calibration(const std::string& folder, const RunOptions& options, const Prepared& fitted,
                      const Calibration& calibration, const VecX& u, Diagnostics& out, CalibrationResult& result) {
  result.solution.folder = folder_for(folder, options, result.solution.summary);
  const std::string text =
      with_values(fitted.scene.file, fitted.scene, calibration.values(u), result.solution.folder, out);
  if (out.has_errors()) return kExitFailed;
  const std::string error = write_results(result.solution.folder, fitted, result.solution,
                                          {{"scene.toml", text},
                                           {"calibration.csv", calibration_table(result.report).to_csv()},
                                           {"comparison.csv", calibration.comparison(result.solution.poses).to_csv()}});
  if (error.empty()) return result.solution.summary.exit_code;
  out.error(Code::cannot_write, {}, error);
  return kExitFailed;
}

/// Whether the scene's text can take the values: said before anything is fitted.
bool can_be_written(const Prepared& prepared, const std::vector<Unknown>& unknowns,
                    const std::optional<std::string>& folder, Diagnostics& out) {
  std::vector<std::pair<Parameter, double>> values;
  for (const Unknown& u : unknowns) values.emplace_back(u.parameter, u.start);
  return !with_values(prepared.scene.file, prepared.scene, values, folder.value_or("."), out).empty() &&
         !out.has_errors();
}

}  // namespace

int run_calibration(const SceneSource& source, const std::optional<std::string>& folder,
                    const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out,
                    CalibrationResult& result) {
  auto prepared = prepare_run(source, folder, out, {choice.target});
  if (!prepared) return kExitRefused;
  const std::vector<Unknown> unknowns = choose_unknowns(prepared->source, choice.vary, out);
  const auto target =
      read_calibration_target(choice.target, choice.columns, known_columns(*prepared), duration_of(*prepared), out);
  if (out.has_errors() || !target || !can_be_written(*prepared, unknowns, folder, out)) return kExitRefused;
  if (target->values.size() < unknowns.size()) {
    out.error(
        Code::missing_key, choice.target,
        fmt::format("holds {} values, fewer than the {} numbers to be fitted", target->values.size(), unknowns.size()));
    return kExitRefused;
  }
  share_search(*prepared);
  ContactField field = contact_field(*prepared);
  if (!check_start(*prepared, field, out)) return kExitRefused;

  const Calibration calibration(*prepared, unknowns, *target, options);
  const auto start = calibration.residuals(VecX::Zero(static_cast<Eigen::Index>(unknowns.size())));
  if (!start) {
    out.error(Code::not_solved, source.path,
              "cannot be fitted from these values: not all of its rows can be computed (genu run says why)");
    return kExitRefused;
  }
  if (!std::isfinite(start->squaredNorm())) {
    out.error(Code::out_of_range, choice.target,
              "cannot be fitted: beside its values, or how they differ, the scene's are beyond all numbers");
    return kExitRefused;
  }
  const LeastSquaresResult fit = calibration.fit(choice.most_iterations);
  if (fit.jacobian.size() == 0) {
    out.error(Code::not_solved, source.path, std::string("is not fitted: ") + to_string(fit.stop));
    return kExitIncomplete;
  }
  const auto fitted = calibration.with(fit.x);
  result.solution = calibration.solve_scene(*fitted);
  result.report = calibration.report(fit, start->squaredNorm());
  RunSummary& s = result.solution.summary;
  s.verdict.push_back(
      fmt::format("{} numbers fitted to {} values; {}.", unknowns.size(), target->values.size(), result.report.stop));
  if (!result.report.converged || !result.report.undetermined.empty()) s.exit_code = kExitIncomplete;
  return folder ? write_calibration(*folder, options, *fitted, calibration, fit.x, out, result) : s.exit_code;
}

}  // namespace genu
