#include "genu/study/accuracy_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// "0.01mm" as (0.01, "mm"). Nothing for what is none.
std::optional<std::pair<double, std::string>> target_of(const std::string& text) {
  for (const char* unit : {"mm", "deg", "N"}) {
    if (!text.ends_with(unit)) continue;
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

/// The largest error that is allowed: the target, or without one near the smallest of all.
double allowed(const AccuracyReport& report, std::size_t group) {
  const auto target = report.targets.find(report.groups[group].unit);
  if (target != report.targets.end()) return target->second;
  double smallest = std::numeric_limits<double>::infinity();
  if (!report.targets.empty()) return smallest;
  for (const AccuracyPoint& p : report.points)
    if (p.complete() && p.errors[group] >= 0) smallest = std::min(smallest, p.errors[group]);
  return std::max(kErrorFactor * smallest, kExactError);
}

bool keeps(const AccuracyReport& report, const AccuracyPoint& point) {
  for (std::size_t g = 0; g < report.groups.size(); ++g)
    if (!(point.errors[g] >= 0) || point.errors[g] > allowed(report, g)) return false;
  return point.complete();
}

/// Whether what was solved until it was called off says nothing against it.
bool may_keep(const AccuracyReport& report, const AccuracyPoint& point) {
  if (!point.called_off) return keeps(report, point);
  for (std::size_t g = 0; g < report.groups.size(); ++g)
    if (point.errors[g] > allowed(report, g)) return false;
  return true;
}

/// Errors of one coarse mesh may cancel by chance: those of the finer ones with the same degree have to be as small.
bool finer_keep_too(const AccuracyReport& report, const AccuracyPoint& point) {
  const AccuracySetting& s = point.setting;
  return s.knob != AccuracySetting::Knob::mesh ||
         std::all_of(report.points.begin(), report.points.end(), [&](const AccuracyPoint& other) {
           const AccuracySetting& o = other.setting;
           return o.knob != s.knob || o.degree != s.degree || o.edge_factor >= s.edge_factor || may_keep(report, other);
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
  // Of closed forms it is the mesh that is asked for: as they are they are exact.
  if (closed_forms && !report.targets.empty() && p.setting.edge_factor == 0) return false;
  return keeps(report, p) && finer_keep_too(report, p);
}

/// The fastest; of those that are about as fast, the most exact. `tolerances`: among those alone, or without them.
int best(const AccuracyReport& report, bool closed_forms, bool tolerances) {
  const auto considered = [&](const AccuracyPoint& p) {
    return (p.setting.tolerance > 0) == tolerances && eligible(report, p, closed_forms);
  };
  double fastest = std::numeric_limits<double>::infinity(), smallest = fastest;
  for (const AccuracyPoint& p : report.points)
    if (considered(p)) fastest = std::min(fastest, p.pose_seconds);
  int chosen = -1;
  for (std::size_t i = 0; i < report.points.size(); ++i) {
    const AccuracyPoint& p = report.points[i];
    if (!considered(p) || p.pose_seconds > kTimeFactor * fastest) continue;
    double product = 1;
    for (const double error : p.errors) product *= error;
    if (chosen >= 0 && product >= smallest) continue;
    smallest = product;
    chosen = static_cast<int>(i);
  }
  return chosen;
}

/// `chosen`, or the same with another tolerance where that saves time: the finest of those that save about as much.
int with_tolerance(const AccuracyReport& report, int chosen, bool closed_forms) {
  const AccuracyPoint& plain = report.points[at(chosen)];
  const auto same = [&](const AccuracyPoint& p) {
    AccuracySetting without = p.setting;
    without.tolerance = 0;
    without.knob = plain.setting.knob;
    return p.setting.tolerance > 0 && without == plain.setting && eligible(report, p, closed_forms);
  };
  double fastest = plain.pose_seconds;
  for (const AccuracyPoint& p : report.points)
    if (same(p)) fastest = std::min(fastest, p.pose_seconds);
  if (plain.pose_seconds <= kTimeFactor * fastest) return chosen;
  double finest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < report.points.size(); ++i) {
    const AccuracyPoint& p = report.points[i];
    if (!same(p) || p.pose_seconds > kTimeFactor * fastest || p.setting.tolerance >= finest) continue;
    finest = p.setting.tolerance;
    chosen = static_cast<int>(i);
  }
  return chosen;
}

}  // namespace

bool read_targets(const AccuracyChoice& choice, AccuracyReport& report, Diagnostics& out) {
  for (const std::string& text : choice.targets) {
    const auto target = target_of(text);
    if (!target) {
      out.add(error_at({}, Code::wrong_form, "--target", text, "must be a number > 0 with mm, deg or N: 0.01mm"));
      continue;
    }
    if (!report.targets.emplace(target->second, target->first).second)
      out.add(error_at({}, Code::duplicate, "--target", text, "is the second one in " + target->second));
  }
  return !out.has_errors();
}

void choose(AccuracyReport& report, bool closed_forms, double own_tolerance) {
  // Layers on closed forms are summed over these alone.
  closed_forms = closed_forms && std::any_of(report.points.begin(), report.points.end(),
                                             [](const auto& p) { return p.setting.edge_factor > 0; });
  report.chosen = best(report, closed_forms, false);
  if (report.chosen >= 0)
    report.chosen = with_tolerance(report, report.chosen, closed_forms);
  else
    report.chosen = best(report, closed_forms, true);  // as of a scene whose own tolerance is too coarse
  if (report.chosen < 0) {
    report.sentence = report.targets.empty() ? "No setting solves every pose: there is nothing to choose from."
                                             : "No setting that was tried keeps the target and solves every pose.";
    return;
  }
  const AccuracyPoint& p = report.points[at(report.chosen)];
  report.sentence = fmt::format("{} cost {} a pose: {}{}.", errors_text(report, p), time_text(p.pose_seconds), p.name,
                                p.setting.tolerance > 0 ? "" : fmt::format(", tolerance {:.3g}", own_tolerance));
}

std::vector<AccuracySetting> tolerances_to_try(const AccuracyReport& report) {
  std::vector<AccuracySetting> out;
  if (report.chosen < 0) return out;
  AccuracySetting setting = report.points[at(report.chosen)].setting;
  // Those of the scene as it is have been tried already.
  if (setting.tolerance > 0 || setting.knob == AccuracySetting::Knob::own) return out;
  setting.knob = AccuracySetting::Knob::tolerance;
  for (const AccuracyPoint& p : report.points) {
    if (p.setting.knob != AccuracySetting::Knob::tolerance || !p.complete()) continue;
    setting.tolerance = p.setting.tolerance;
    out.push_back(setting);
  }
  return out;
}

}  // namespace genu
