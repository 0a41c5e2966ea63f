#include "genu/calibrate/calibration_reader.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "genu/assemble/pose_file.h"
#include "genu/assemble/refuse_option.h"
#include "genu/assemble/with_numbers.h"
#include "genu/calibrate/finite_number.h"
#include "genu/calibrate/laxity_experiment.h"
#include "genu/calibrate/run_experiment.h"
#include "genu/calibrate/tolerances.h"
#include "genu/results/motion_table.h"
#include "genu/scene/words.h"

namespace genu {

std::pair<std::string, std::string> parts_of_target(const std::string& target) {
  const std::size_t equals = target.find('=');
  if (equals == std::string::npos) return {"", target};
  return {target.substr(0, equals), target.substr(equals + 1)};
}

namespace {

double duration_of(const Prepared& prepared) {
  if (prepared.scene.dynamics) return prepared.scene.dynamics->duration;
  double sum = 0;
  for (const StepDef& step : prepared.scene.steps) sum += step.duration;
  return sum;
}

std::vector<std::string> known_columns(const Prepared& p) {
  return (p.scene.dynamics ? motion_table(p.scene, p.model, {}) : pose_table(p.scene, p.model, p.steps, {})).columns();
}

/// "NAME=SIGMA" texts; others are refused.
std::vector<std::pair<std::string, double>> errors_of(const std::vector<std::string>& texts, Diagnostics& out) {
  std::vector<std::pair<std::string, double>> errors;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const auto value = equals == std::string::npos ? std::nullopt : finite_number(text.substr(equals + 1));
    if (value && *value >= kLeastError)
      errors.emplace_back(text.substr(0, equals), *value);
    else
      refuse_option(out, Code::out_of_range, "--error", text,
                    fmt::format("must be COLUMN=SIGMA with a number from {:g} to {:g}", kLeastError, kMaxNumber));
  }
  return errors;
}

/// The measured things that a fit follows, each with its scene.
class ExperimentReader {
 public:
  ExperimentReader(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns,
                   const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out)
      : prepared_(prepared), unknowns_(unknowns), choice_(choice), options_(options), out_(out) {}

  CalibrationExperiments read() {
    for (const std::string& target : choice_.targets) add(target, false);
    for (const std::string& target : choice_.held_out) add(target, true);
    for (const std::string& file : choice_.candidates) add_candidates(file);
    if (!out_.has_errors()) state_errors();
    return std::move(found_);
  }

 private:
  void add(const std::string& target, bool held_out) {
    const auto [scene, file] = parts_of_target(target);
    std::unique_ptr<CalibrationExperiment> made;
    const auto& columns = held_out && !choice_.predict_columns.empty() ? choice_.predict_columns : choice_.columns;
    if (scene.empty()) {
      made = read(prepared_, file, columns);
    } else if (auto other = prepare({scene, {}}, out_)) {
      share_search(*other);
      if (ScenesUnknowns(*other, unknowns_).none())
        out_.error(Code::unknown_name, scene, "has none of the numbers that --vary names");
      else
        made = read(*other, file, columns);
    }
    if (!made) return;
    made->file = file;
    made->held_out = held_out;
    found_.followed.push_back(std::move(made));
  }

  std::unique_ptr<CalibrationExperiment> read(const Prepared& scene, const std::string& file,
                                              const std::vector<std::string>& columns) {
    const std::vector<std::string> known = known_columns(scene);
    if (!is_laxity_table(file)) {
      auto target = read_calibration_target(file, columns, known, duration_of(scene), out_, axes_of(scene));
      return target ? run_experiment(scene, unknowns_, std::move(*target), options_) : nullptr;
    }
    auto target = read_laxity_target(file, columns, known, out_);
    auto knee = with_laxity_loads(scene, out_);
    if (!target || !knee) return nullptr;
    share_search(knee->prepared);
    return laxity_experiment(*knee, unknowns_, std::move(*target), choice_.compression, options_.cancelled);
  }

  /// Each curve of a laxity table is one measurement that could be made, each of its loads once.
  void add_candidates(const std::string& file) {
    if (!read_pose_file(file, out_)) return;
    if (!is_laxity_table(file)) {
      refuse_option(out_, Code::wrong_form, "--design", file,
                    "must be a laxity table: columns flexion_deg, test, load_N or load_Nm, displacement_mm or "
                    "displacement_deg, as genu laxity writes them");
      return;
    }
    const auto all = read_laxity_target(file, choice_.columns, known_columns(prepared_), out_);
    auto knee = with_laxity_loads(prepared_, out_);
    if (!all || !knee) return;
    share_search(knee->prepared);
    for (std::size_t c = 0; c < all->curves.size(); ++c) {
      LaxityTarget curve;
      std::set<std::pair<double, std::size_t>> taken;
      for (const LaxityTarget::Value& v : all->values)
        if (v.curve == c && taken.insert({v.load, v.column}).second)
          curve.add(all->curves[c].flexion, all->curves[c].kind, v.load, all->columns[v.column], v.value);
      if (curve.values.empty()) continue;
      curve.arrange();
      auto made = laxity_experiment(*knee, unknowns_, std::move(curve), choice_.compression, options_.cancelled);
      const std::string name = made->label(0);
      found_.candidates.push_back({name, std::move(made)});
    }
  }

  /// All columns have a stated error, or none has; a prior needs them.
  void state_errors() {
    const auto errors = errors_of(choice_.errors, out_);
    std::string without;
    bool any = false;
    std::vector<bool> used(errors.size());
    const auto state = [&](CalibrationExperiment& e) {
      e.state_errors(errors);
      for (const auto& column : e.columns()) {
        any = any || column.stated;
        if (!column.stated && !e.held_out) without = column.name;
        for (std::size_t k = 0; k < errors.size(); ++k) used[k] = used[k] || matches(errors[k].first, column.name);
      }
    };
    for (const auto& e : found_.followed) state(*e);
    for (const auto& c : found_.candidates) state(*c.experiment);
    any = any || !found_.candidates.empty();
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (!used[k])
        refuse_option(out_, Code::unknown_name, "--error", errors[k].first, "is no column that a target follows");
    const bool priors = std::any_of(unknowns_.begin(), unknowns_.end(), [](const auto& u) { return u.prior; });
    if (without.empty() || !(any || priors)) return;
    out_.add(
        error_at({}, Code::missing_key, "--error", {},
                 "is missing for " + without +
                     (!found_.candidates.empty() ? ": a test is worth what its errors allow, so --design needs them"
                      : any                      ? ": state the error of every column, or of none"
                            : ": a prior can be weighed against measurements only if their errors are stated")));
  }

  const Prepared& prepared_;
  const std::vector<CalibrationUnknown>& unknowns_;
  const CalibrationChoice& choice_;
  const RunOptions& options_;
  Diagnostics& out_;
  CalibrationExperiments found_;
};

}  // namespace

CalibrationExperiments read_experiments(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns,
                                        const CalibrationChoice& choice, const RunOptions& options, Diagnostics& out) {
  return ExperimentReader(prepared, unknowns, choice, options, out).read();
}

}  // namespace genu
