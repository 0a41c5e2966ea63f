#include "genu/study/accuracy.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include <fmt/format.h>

#include "genu/scene/tolerances.h"
#include "genu/store/report.h"
#include "genu/study/accuracy_choice.h"
#include "genu/study/accuracy_trials.h"
#include "genu/study/chosen_scene.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

constexpr double kNotTimed = std::numeric_limits<double>::quiet_NaN();

/// What times were taken on.
std::string machine() {
  std::ifstream in("/proc/cpuinfo");
  std::string name = "an unknown processor";
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos) {
      name = line.substr(line.find(": ") + 2);
      break;
    }
  return fmt::format("{}, {} cores", name, std::thread::hardware_concurrency());
}

std::vector<AccuracyGroup> groups_of(const Prepared& p, const ResultTable& poses) {
  AccuracyGroup turn{"rotation", "deg", {}, 0, 0, 0}, place{"position", "mm", {}, 0, 0, 0},
      contact{"contact force", "N", {}, 0, 0, 0}, ligament{"ligament force", "N", {}, 0, 0, 0};
  const auto has = [&](const std::string& column, AccuracyGroup& group) {
    if (poses.has_column(column)) group.columns.push_back(column);
  };
  for (const std::string& column : poses.columns())
    for (const auto& joint : p.scene.joints)
      if (column.rfind(joint.name + ".", 0) == 0 && column.find('.') == column.rfind('.')) {
        if (column.ends_with("_deg")) turn.columns.push_back(column);
        if (column.ends_with("_mm")) place.columns.push_back(column);
      }
  for (const ContactDef& c : p.scene.contacts) has(c.name + ".force_N", contact);
  for (const LayerDef& l : p.scene.layers) has(l.pair.name + ".force_N", contact);
  for (const LigamentDef& l : p.scene.ligaments) has(l.name + ".force_N", ligament);
  std::vector<AccuracyGroup> out;
  for (AccuracyGroup& g : {std::ref(turn), std::ref(place), std::ref(contact), std::ref(ligament)})
    if (!g.columns.empty()) out.push_back(std::move(g));
  return out;
}

/// The finest solution's own error, from the meshes of the scene's own degree.
void estimate_finest(const Prepared& p, const std::vector<Trial>& trials, std::vector<AccuracyGroup>& groups) {
  if (has_closed_forms_alone(p)) return;
  int degree = 0;
  for (const SurfaceNote& note : p.notes)
    if (note.blend) degree = std::max(degree, note.blend->facts().degree);
  for (AccuracyGroup& group : groups) {
    std::vector<double> factors, differences;
    for (const Trial& t : trials)
      if (t.setting.knob == AccuracySetting::Knob::mesh && t.setting.degree == degree && t.setting.edge_factor > 1) {
        factors.push_back(t.setting.edge_factor);
        differences.push_back(largest_difference(trials[0].poses, t.poses, group.columns, 1));
      }
    extrapolate(factors, differences, group);
  }
}

/// What errors are counted from: the scene as it is, or with a finer tolerance than it has.
const Trial& finest_of(const std::vector<Trial>& trials) {
  const Trial* finest = &trials[0];
  double tolerance = trials[0].prepared->scene.solver.tolerance;
  for (const Trial& t : trials)
    if (t.setting.knob == AccuracySetting::Knob::tolerance && t.setting.edge_factor == 0 && t.complete() &&
        t.setting.tolerance < tolerance) {
      finest = &t;
      tolerance = t.setting.tolerance;
    }
  return *finest;
}

AccuracyPoint point_of(const Prepared& p, const Trial& trial, const Trial& finest,
                       const std::vector<AccuracyGroup>& groups) {
  AccuracyPoint out{trial.setting, describe(p, trial.setting), {}, trial.solved, trial.asked, trial.build_seconds};
  out.called_off = trial.called_off && !trial.complete();
  const double stretch = trial.setting.increments > 0 ? trial.setting.increments : 1;
  for (const AccuracyGroup& group : groups) {
    const double off = largest_difference(finest.poses, trial.poses, group.columns, stretch);
    out.errors.push_back(std::hypot(off, group.finest_error));
  }
  out.pose_seconds =
      trial.complete() ? median(trial.seconds) : kNotTimed;  // else most of the time is of poses not found
  out.spread = spread(trial.seconds);
  for (std::size_t k = 0; k < kAccuracyEffects; ++k) out.effect_seconds[k] = median(trial.effects[k]);
  return out;
}

/// Errors and times of all trials, and the one to be taken.
void compare(const Prepared& p, const std::vector<Trial>& trials, AccuracyReport& report) {
  report.groups = groups_of(p, trials[0].poses);
  estimate_finest(p, trials, report.groups);
  const Trial& finest = finest_of(trials);
  std::vector<double> spreads;
  for (const Trial& trial : trials) {
    report.points.push_back(point_of(p, trial, finest, report.groups));
    if (trial.seconds.size() >= kMinRounds) spreads.push_back(report.points.back().spread);
  }
  report.noisy = median(spreads) > kNoisySpread;
  choose(report, has_closed_forms_alone(p), p.scene.solver.tolerance);
}

/// The files beside the scene's own results.
std::vector<std::pair<std::string, std::string>> files_of(const AccuracyReport& report, const std::string& path,
                                                          const Prepared& p, const std::string& folder,
                                                          Diagnostics& out) {
  std::vector<std::pair<std::string, std::string>> files = {{"accuracy.csv", to_csv(report)},
                                                            {"accuracy.svg", to_svg(report)}};
  if (report.targets.empty() || report.chosen < 0) return files;
  for (auto& file : chosen_scene(path, p, report.points[at(report.chosen)].setting, folder, out))
    files.push_back(std::move(file));
  return files;
}

}  // namespace

double largest_difference(const ResultTable& reference, const ResultTable& other,
                          const std::vector<std::string>& columns, double stretch) {
  double largest = kNotTimed;
  for (std::size_t row = 0; row < reference.rows(); ++row) {
    const double there = static_cast<double>(row) * stretch;
    const auto match = static_cast<std::size_t>(std::llround(there));
    if (there != std::floor(there) || match >= other.rows()) continue;
    for (const std::string& column : columns) {
      if (!other.has_column(column)) continue;
      const double off = std::abs(reference.number(row, column) - other.number(match, column));
      if (std::isfinite(off)) largest = std::isnan(largest) ? off : std::max(largest, off);
    }
  }
  return largest;
}

void extrapolate(const std::vector<double>& factors, const std::vector<double>& differences, AccuracyGroup& out) {
  out.order = 0;
  out.finest_error = out.finest_uncertainty = 0;
  if (factors.empty() || !std::isfinite(differences[0])) return;
  // Without an order, the first coarser mesh is all that is known.
  out.finest_error = out.finest_uncertainty = differences[0];
  // d = C (f^p - 1): of every two differences their own p, and from that C, the finest's error.
  std::vector<double> errors, orders;
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (std::size_t j = i + 1; j < factors.size(); ++j) {
      const double ratio = differences[j] / differences[i];
      const auto of = [&](double p) { return (std::pow(factors[j], p) - 1) / (std::pow(factors[i], p) - 1); };
      if (!(ratio >= of(kMinOrder)) || !(ratio <= of(kMaxOrder))) continue;
      double low = kMinOrder, high = kMaxOrder;
      for (int k = 0; k < 60; ++k) (of(0.5 * (low + high)) < ratio ? low : high) = 0.5 * (low + high);
      orders.push_back(low);
      errors.push_back(differences[i] / (std::pow(factors[i], low) - 1));
    }
  if (errors.empty()) return;
  const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
  out.order = median(orders);
  out.finest_error = *most;
  out.finest_uncertainty = errors.size() > 1 ? *most - *least : *most;  // one estimate has nothing to be compared with
}

int run_accuracy(const std::string& path, const std::optional<std::string>& folder, const AccuracyChoice& choice,
                 const RunOptions& options, Diagnostics& out, AccuracyReport& report, Solution& own) {
  if (!read_targets(choice, report, out)) return kExitRefused;
  auto prepared = prepare_run(path, folder, out);
  if (!prepared) return kExitRefused;
  if (prepared->scene.dynamics) {
    out.error(Code::not_applicable, path,
              "is a motion over time: genu accuracy compares poses, and a motion has its own `tolerance`");
    return kExitRefused;
  }
  if (folder && !report.targets.empty()) {
    // Before an hour of solving: could every setting be written?
    const AccuracySetting all{
        .edge_factor = 3, .degree = 2, .tolerance = kLoosestSolverTolerance, .layer_tolerance = 1e-2};
    if (chosen_scene(path, *prepared, all, *folder, out).empty() || out.has_errors()) return kExitRefused;
  }
  ContactField field(prepared->model);
  if (!check_start(*prepared, field, out)) return kExitRefused;
  report.title = prepared->scene.title;
  report.machine = machine();
  report.reference = has_closed_forms_alone(*prepared) ? "the same path in closed form"
                                                       : "the finest meshes (those of the scene), with their own error";
  std::vector<Trial> trials;
  for (const AccuracySetting& setting : accuracy_settings(*prepared)) {
    if (asked_to_stop(options.cancelled)) return kExitIncomplete;
    if (auto trial = make_trial(*prepared, setting)) trials.push_back(std::move(*trial));
  }
  const auto tolerances = [&](const std::vector<Trial>& so_far) {
    AccuracyReport of_these = report;
    compare(*prepared, so_far, of_these);
    std::vector<Trial> more;
    for (const AccuracySetting& setting : tolerances_to_try(of_these))
      if (auto trial = make_trial(*prepared, setting)) more.push_back(std::move(*trial));
    return more;
  };
  if (!solve_all(trials, choice, options, tolerances, report.rounds, own)) {
    out.error(Code::interrupted, path, "interrupted before every setting was solved once: there is nothing to compare");
    return kExitIncomplete;
  }
  compare(*prepared, trials, report);
  for (const auto& [unit, value] : report.targets)
    if (std::none_of(report.groups.begin(), report.groups.end(), [&, u = unit](const auto& g) { return g.unit == u; }))
      out.add(error_at({}, Code::unknown_name, "--target", unit, "no output of this scene has this unit"));
  if (out.has_errors()) return kExitRefused;
  report.stages = prepared->seconds;
  report.stages.emplace_back("solving", seconds_of(own.summary, "solving"));
  int code = report.chosen < 0 ? kExitIncomplete : kExitOk;
  if (!folder) return code;
  own.folder = folder_for(*folder, options, own.summary);
  auto files = files_of(report, path, *prepared, own.folder, out);
  add_report(*prepared, own, files, {{"What accuracy costs in time", to_svg(report), to_text(report)}});
  if (const std::string error = write_results(own.folder, *prepared, own, files); !error.empty()) {
    out.error(Code::cannot_write, {}, error);
    code = kExitFailed;
  }
  return code;
}

}  // namespace genu
