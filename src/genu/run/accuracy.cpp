#include "genu/run/accuracy.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include <fmt/format.h>

#include "genu/core/timer.h"
#include "genu/run/chosen_scene.h"

namespace genu {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kNoisy = 0.5;    // spread of a setting's times, in the median over all settings
constexpr int kFewestRounds = 2;  // to speak of a spread

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

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
        if (ends_with(column, "_deg")) turn.columns.push_back(column);
        if (ends_with(column, "_mm")) place.columns.push_back(column);
      }
  for (const ContactDef& c : p.scene.contacts) has(c.name + ".force_N", contact);
  for (const LayerDef& l : p.scene.layers) has(l.pair.name + ".force_N", contact);
  for (const LigamentDef& l : p.scene.ligaments) has(l.name + ".force_N", ligament);
  std::vector<AccuracyGroup> out;
  for (AccuracyGroup& g : {std::ref(turn), std::ref(place), std::ref(contact), std::ref(ligament)})
    if (!g.columns.empty()) out.push_back(std::move(g));
  return out;
}

/// "0.01mm" as (0.01, "mm"). Nothing for what is none.
std::optional<std::pair<double, std::string>> target_of(const std::string& text) {
  for (const char* unit : {"mm", "deg", "N"}) {
    if (!ends_with(text, unit)) continue;
    const std::string number = text.substr(0, text.size() - std::string(unit).size());
    std::size_t used = 0;
    double value = 0;
    try {
      value = std::stod(number, &used);
    } catch (const std::exception&) {
      return std::nullopt;
    }
    while (used < number.size() && number[used] == ' ') ++used;
    if (used != number.size() || !std::isfinite(value) || !(value > 0)) return std::nullopt;
    return std::pair(value, std::string(unit));
  }
  return std::nullopt;
}

/// One setting with all that solving it needs.
struct Trial {
  AccuracySetting setting;
  std::optional<Prepared> prepared;
  double build_seconds = 0;
  ResultTable poses;
  int solved = 0, asked = 0;
  std::vector<double> seconds;  ///< a pose, of each round
};

double median(std::vector<double> values) {
  if (values.empty()) return kNaN;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Solves a trial once, for `most` seconds or about that long; its table and rows are those of the last time. False
/// where it was called off: the trial is then as it was.
bool solve_once(Trial& trial, const RunOptions& options, double most, Solution* keep) {
  RunOptions mine = options;
  const Timer timer;
  mine.path.newton.cancelled =
      mine.cancelled = [&] { return timer.seconds() > most || asked_to_stop(options.cancelled); };
  if (trial.setting.tolerance > 0) {
    mine.path.newton.residual_tolerance = trial.setting.tolerance;
    mine.path.newton.residual_floor = std::max(mine.path.newton.residual_floor, trial.setting.tolerance);
  }
  ContactField field(trial.prepared->model);
  Solution solution = solve(*trial.prepared, field, mine);
  if (asked_to_stop(options.cancelled)) return false;
  trial.solved = solution.summary.poses_solved;
  trial.asked = solution.summary.poses_asked;
  if (trial.solved > 0) trial.seconds.push_back(solution.summary.seconds.back().second / trial.solved);  // "solving"
  trial.poses = solution.poses;
  if (keep != nullptr) *keep = std::move(solution);
  return true;
}

/// Solves all trials in turn, round after round. False where it is called off before each has been solved once.
bool solve_all(std::vector<Trial>& trials, const AccuracyChoice& choice, const RunOptions& options, int& rounds,
               Solution& own) {
  constexpr double kPatience = 20, kAtLeast = 2;  // times as long as the scene as it is, s: more is of no use to anyone
  const Timer timer;
  double most = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(trials.size());
  for (rounds = 0; rounds < choice.rounds && (rounds < kFewestRounds || timer.seconds() < choice.seconds); ++rounds)
    for (int i = 0; i < count; ++i) {
      Trial& trial = trials[at(i)];
      if (rounds > 0 && trial.solved < trial.asked) continue;  // what does not get there need not be timed
      if (!solve_once(trial, options, most, i == 0 && rounds == 0 ? &own : nullptr)) return rounds > 0;
      if (i == 0) most = std::max(kAtLeast, kPatience * timer.seconds() / (rounds + 1));
      if (options.varied_progress) options.varied_progress(rounds * count + i + 1, choice.rounds * count);
    }
  return true;
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

AccuracyPoint point_of(const Prepared& p, const Trial& trial, const Trial& finest,
                       const std::vector<AccuracyGroup>& groups) {
  AccuracyPoint out{trial.setting, describe(p, trial.setting), {}, trial.solved,
                    trial.asked,   trial.build_seconds,        0,  0};
  const double stretch = trial.setting.increments > 0 ? trial.setting.increments : 1;
  for (const AccuracyGroup& group : groups) {
    const double off = largest_difference(finest.poses, trial.poses, group.columns, stretch);
    out.errors.push_back(std::hypot(off, group.finest_error));
  }
  out.pose_seconds = median(trial.seconds);
  const auto [low, high] = std::minmax_element(trial.seconds.begin(), trial.seconds.end());
  if (!trial.seconds.empty()) out.spread = (*high - *low) / out.pose_seconds;
  return out;
}

bool keeps(const AccuracyReport& report, const AccuracyPoint& point) {
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    if (!(point.errors[g] >= 0)) return false;
    const auto target = report.targets.find(report.groups[g].unit);
    if (target != report.targets.end() && point.errors[g] > target->second) return false;
    if (!report.targets.empty()) continue;
    double smallest = std::numeric_limits<double>::infinity();
    for (const AccuracyPoint& p : report.points)
      if (p.complete() && p.errors[g] >= 0) smallest = std::min(smallest, p.errors[g]);
    constexpr double kWithin = 2, kExact = 1e-6;
    if (point.errors[g] > std::max(kWithin * smallest, kExact)) return false;
  }
  return point.complete();
}

/// Errors of one coarse mesh may cancel by chance: those of the finer ones with the same degree have to be as small.
bool finer_keep_too(const AccuracyReport& report, const AccuracyPoint& point) {
  const AccuracySetting& s = point.setting;
  return s.knob != AccuracySetting::Knob::mesh ||
         std::all_of(report.points.begin(), report.points.end(), [&](const AccuracyPoint& other) {
           const AccuracySetting& o = other.setting;
           return o.knob != s.knob || o.degree != s.degree || o.edge_factor >= s.edge_factor || keeps(report, other);
         });
}

std::string time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} us", 1e6 * seconds);
  return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

std::string errors_text(const AccuracyReport& report, const AccuracyPoint& point) {
  std::string out;
  for (std::size_t g = 0; g < report.groups.size(); ++g)
    out += fmt::format("{}{:.2g} {} ({})",
                       g == 0                          ? ""
                       : g + 1 == report.groups.size() ? " and "
                                                       : ", ",
                       point.errors[g], report.groups[g].unit, report.groups[g].name);
  return out;
}

bool eligible(const AccuracyReport& report, const AccuracyPoint& p, bool closed_forms) {
  using Knob = AccuracySetting::Knob;
  if (p.setting.knob == Knob::model) return false;       // another joint, not a less exact one
  if (p.setting.knob == Knob::increments) return false;  // other rows are asked for
  if (p.setting.knob == Knob::tolerance) return false;   // a scene does not say it
  // Of closed forms it is the mesh that is asked for: as they are they are exact.
  if (closed_forms && !report.targets.empty() && p.setting.knob != Knob::mesh) return false;
  return keeps(report, p) && finer_keep_too(report, p);
}

/// The fastest; of those that are about as fast, the most exact.
void choose(AccuracyReport& report, bool closed_forms) {
  constexpr double kAsFast = 1.1;
  double fastest = std::numeric_limits<double>::infinity(), smallest = fastest;
  for (const AccuracyPoint& p : report.points)
    if (eligible(report, p, closed_forms)) fastest = std::min(fastest, p.pose_seconds);
  for (std::size_t i = 0; i < report.points.size(); ++i) {
    const AccuracyPoint& p = report.points[i];
    if (!eligible(report, p, closed_forms) || p.pose_seconds > kAsFast * fastest) continue;
    double product = 1;
    for (const double error : p.errors) product *= error;
    if (report.chosen >= 0 && product >= smallest) continue;
    smallest = product;
    report.chosen = static_cast<int>(i);
  }
  if (report.chosen < 0) {
    report.sentence = report.targets.empty() ? "No setting solves every pose: there is nothing to choose from."
                                             : "No setting that was tried keeps the target and solves every pose.";
    return;
  }
  const AccuracyPoint& p = report.points[at(report.chosen)];
  report.sentence = fmt::format("{} cost {} a pose: {}.", errors_text(report, p), time_text(p.pose_seconds), p.name);
}

bool read_targets(const AccuracyChoice& choice, AccuracyReport& report, Diagnostics& out) {
  for (const std::string& text : choice.targets) {
    const auto target = target_of(text);
    if (!target) {
      out.add({.file = {}, .key = "--target", .found = text, .rule = "must be a number > 0 with mm, deg or N: 0.01mm"});
      continue;
    }
    if (!report.targets.emplace(target->second, target->first).second)
      out.add({.file = {}, .key = "--target", .found = text, .rule = "is the second one in " + target->second});
  }
  return !out.has_errors();
}

}  // namespace

double largest_difference(const ResultTable& reference, const ResultTable& other,
                          const std::vector<std::string>& columns, double stretch) {
  double largest = kNaN;
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
  constexpr double kLeast = 0.5, kMost = 8;
  std::vector<double> errors, orders;
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (std::size_t j = i + 1; j < factors.size(); ++j) {
      const double ratio = differences[j] / differences[i];
      const auto of = [&](double p) { return (std::pow(factors[j], p) - 1) / (std::pow(factors[i], p) - 1); };
      if (!(ratio >= of(kLeast)) || !(ratio <= of(kMost))) continue;
      double low = kLeast, high = kMost;
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
    out.error(path, "is a motion over time: genu accuracy compares poses, and a motion has its own `tolerance`");
    return kExitRefused;
  }
  if (folder && !report.targets.empty()) {
    // Before an hour of solving: could every setting be written?
    chosen_scene(path, *prepared, {.edge_factor = 3, .degree = 2, .layer_tolerance = 1e-2}, *folder, out);
    if (out.has_errors()) return kExitRefused;
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
    const Timer timer;
    Trial trial{setting, with_setting(*prepared, setting), 0, {}, 0, 0, {}};
    trial.build_seconds = timer.seconds();
    if (trial.prepared) trials.push_back(std::move(trial));
  }
  if (!solve_all(trials, choice, options, report.rounds, own)) {
    out.error(path, "interrupted before every setting was solved once: there is nothing to compare");
    return kExitIncomplete;
  }
  report.groups = groups_of(*prepared, trials[0].poses);
  for (const auto& [unit, value] : report.targets)
    if (std::none_of(report.groups.begin(), report.groups.end(), [&, u = unit](const auto& g) { return g.unit == u; }))
      out.add({.file = {}, .key = "--target", .found = unit, .rule = "no output of this scene has this unit"});
  if (out.has_errors()) return kExitRefused;
  estimate_finest(*prepared, trials, report.groups);
  std::vector<double> spreads;
  for (const Trial& trial : trials) {
    report.points.push_back(point_of(*prepared, trial, trials[0], report.groups));
    spreads.push_back(report.points.back().spread);
  }
  report.stages = prepared->seconds;
  report.stages.push_back(own.summary.seconds.back());
  report.noisy = report.rounds >= kFewestRounds && median(spreads) > kNoisy;
  choose(report, has_closed_forms_alone(*prepared) && mesh_unit(*prepared) > 0);
  int code = report.chosen < 0 ? kExitIncomplete : kExitOk;
  if (!folder) return code;
  own.folder = folder_for(*folder, options, own.summary);
  std::vector<std::pair<std::string, std::string>> files = {{"accuracy.csv", to_csv(report)},
                                                            {"accuracy.svg", to_svg(report)}};
  if (!report.targets.empty() && report.chosen >= 0)
    for (auto& file : chosen_scene(path, *prepared, report.points[at(report.chosen)].setting, own.folder, out))
      files.push_back(std::move(file));
  if (const std::string error = write_results(own.folder, *prepared, own, files); !error.empty()) {
    out.add({.file = {}, .key = {}, .found = {}, .rule = error});
    code = kExitFailed;
  }
  return code;
}

}  // namespace genu
