// What accuracy costs in time, as text, table and diagram.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/work_precision.h"
#include "genu/study/accuracy_report.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

constexpr std::array<const char*, kAccuracyEffects> kPartColumns = {"us_search", "us_contact_equations",
                                                                    "us_ligaments"};

/// Degrees have a colour each.
std::string series_of(const AccuracySetting& s) {
  if (s.knob != AccuracySetting::Knob::mesh || s.degree == 0) return to_string(s.knob);
  return fmt::format("edge length, degree {}", s.degree);
}

/// The same colours in every picture.
std::vector<std::string> series_in_order() {
  using Knob = AccuracySetting::Knob;
  std::vector<std::string> names = {series_of({})};
  for (const int degree : {2, 3, 4}) names.push_back(series_of({.knob = Knob::mesh, .degree = degree}));
  for (const Knob knob : {Knob::radius, Knob::tolerance, Knob::increments, Knob::model, Knob::layer, Knob::mesh})
    names.push_back(to_string(knob));
  return names;
}

std::vector<WorkPanel> panels_of(const AccuracyReport& report) {
  std::vector<WorkPanel> panels;
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    const AccuracyGroup& group = report.groups[g];
    WorkPanel panel{group.name + " [" + group.unit + "]", {}, 0};
    if (const auto t = report.targets.find(group.unit); t != report.targets.end()) panel.target = t->second;
    for (std::size_t i = 0; i < report.points.size(); ++i) {
      const AccuracyPoint& p = report.points[i];
      if (!p.complete()) continue;
      const double error = std::isnan(p.errors[g]) ? p.errors[g] : std::max(p.errors[g], kErrorRounding);
      panel.points.push_back(
          {p.name, series_of(p.setting), p.pose_seconds, error, static_cast<int>(i) == report.chosen});
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

ResultTable table_of(const AccuracyReport& report) {
  ResultTable table;
  for (const char* column : {"varied", "setting", "solved", "build_ms", "us_a_pose", "spread"})
    table.add_column(column);
  for (const char* column : kPartColumns) table.add_column(column);
  for (const AccuracyGroup& g : report.groups) table.add_column(g.name + "_" + g.unit);
  table.add_column("front");
  std::vector<std::vector<bool>> fronts;
  std::vector<std::size_t> place(report.points.size(), 0);
  for (const WorkPanel& panel : panels_of(report)) fronts.push_back(pareto_front(panel.points));
  std::size_t drawn = 0;
  for (const AccuracyPoint& p : report.points) {
    table.add_row();
    table.set("varied", std::string(to_string(p.setting.knob)));
    table.set("setting", p.name);
    table.set("solved", fmt::format("{}/{}", p.solved, p.asked));
    table.set("build_ms", 1e3 * p.build_seconds);
    table.set("us_a_pose", 1e6 * p.pose_seconds);
    table.set("spread", p.spread);
    for (std::size_t k = 0; k < kAccuracyEffects; ++k) table.set(kPartColumns[k], 1e6 * p.effect_seconds[k]);
    std::string front;
    for (std::size_t g = 0; g < report.groups.size(); ++g) {
      table.set(report.groups[g].name + "_" + report.groups[g].unit, p.errors[g]);
      if (p.complete() && fronts[g][drawn]) front += (front.empty() ? "" : " ") + report.groups[g].name;
    }
    table.set("front", front);
    if (p.complete()) ++drawn;
  }
  return table;
}

std::string microseconds(const AccuracyPoint& p, double seconds) {
  return p.complete() ? fmt::format("{:.1f}", 1e6 * seconds) : p.called_off ? "called off" : "-";
}

/// How far times can be trusted.
const char* trust(const AccuracyReport& report) {
  if (report.rounds < 2) return "; nothing tells how far to trust it: ask for more --rounds and --seconds";
  return report.noisy ? "; THE MACHINE WAS TOO BUSY to tell times apart: try again" : "";
}

}  // namespace

const std::array<const char*, kAccuracyEffects> kAccuracyEffectNames = {"search for contacts", "equations of contacts",
                                                                        "ligaments"};

std::string to_text(const AccuracyReport& report) {
  const ResultTable table = table_of(report);
  std::string out = "errors are the largest of any row, from " + report.reference + "\n\n";
  std::vector<std::string> head = {"varied", "setting", "solved", "build ms", "us a pose", "search"};
  for (const AccuracyGroup& g : report.groups) head.push_back(g.name + " " + g.unit);
  head.push_back("");
  std::vector<std::vector<std::string>> rows = {head};
  for (std::size_t i = 0; i < report.points.size(); ++i) {
    const AccuracyPoint& p = report.points[i];
    const bool again = i > 0 && report.points[i - 1].setting.knob == p.setting.knob;
    std::vector<std::string> row = {
        again ? "" : to_string(p.setting.knob),  p.name,
        fmt::format("{}/{}", p.solved, p.asked), fmt::format("{:.1f}", 1e3 * p.build_seconds),
        microseconds(p, p.pose_seconds),         p.complete() ? microseconds(p, p.effect_seconds[0]) : "-"};
    for (const double e : p.errors) row.push_back(std::isfinite(e) ? fmt::format("{:.2e}", e) : "-");
    const auto front = std::get<std::string>(table.at(i, table.column_index("front")));
    row.push_back(static_cast<int>(i) == report.chosen ? "<- chosen" : front.empty() ? "" : "*");
    rows.push_back(std::move(row));
  }
  std::vector<std::size_t> widths(head.size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c)
      line += c < 2 || c + 1 == row.size() ? fmt::format(" {:<{}} ", row[c], widths[c])
                                           : fmt::format(" {:>{}} ", row[c], widths[c]);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  out += "  *: no other setting is both faster and more exact, in one group at least\n";
  if (std::any_of(report.points.begin(), report.points.end(), [](const auto& p) { return p.called_off; }))
    out += fmt::format(
        "  called off: it took {:g} times as long as the scene as it is (another tolerance: {:g} times), "
        "and {:g} s at least\n",
        kTrialPatience, kShortPatience, kMinPatience);
  out += "\n";
  for (const AccuracyGroup& g : report.groups)
    if (g.finest_error > 0)
      out += fmt::format(
          "  {:<12}{} of the finest mesh: {:.2g} {} (uncertain by {:.1g}{})\n", "finest", g.name, g.finest_error,
          g.unit, g.finest_uncertainty,
          g.order > 0 ? fmt::format("; order {:.1f}", g.order) : ", no order is seen: noise and features decide");
  std::string stages, parts;
  for (const auto& [name, seconds] : report.stages)
    stages += fmt::format("{}{} {:.3f} s", stages.empty() ? "" : ", ", name, seconds);
  const AccuracyPoint& own = report.points[0];
  for (std::size_t k = 0; k < kAccuracyEffects; ++k)
    parts += fmt::format("{}{} {:.1f}", k == 0 ? "" : ", ", kAccuracyEffectNames[k], 1e6 * own.effect_seconds[k]);
  out += fmt::format("  {:<12}{}\n  {:<12}of {:.1f} us a pose: {}\n", "as it is", stages, "", 1e6 * own.pose_seconds,
                     parts);
  out += fmt::format("  {:<12}{} round{}, medians, on {}{}\n", "times", report.rounds, report.rounds == 1 ? "" : "s",
                     report.machine, trust(report));
  return out + fmt::format("  {:<12}{}\n", "answer", report.sentence);
}

std::string to_csv(const AccuracyReport& report) { return table_of(report).to_csv(); }

std::string to_svg(const AccuracyReport& report) {
  WorkPicture picture{report.title, panels_of(report), {}, series_in_order()};
  if (!report.targets.empty()) picture.words.push_back("dashed: the error that is allowed");
  if (report.chosen >= 0) picture.words.push_back("ring: chosen, " + report.points[at(report.chosen)].name);
  const auto tiny = [](const AccuracyPoint& p) {
    return p.complete() && std::any_of(p.errors.begin(), p.errors.end(), [](double e) { return e < kErrorRounding; });
  };
  if (std::any_of(report.points.begin(), report.points.end(), tiny))
    picture.words.push_back(fmt::format("errors below {0:g} are drawn as {0:g}", kErrorRounding));
  picture.words.push_back(fmt::format("{}; medians of {} round{}{}", report.machine, report.rounds,
                                      report.rounds == 1 ? "" : "s",
                                      report.noisy ? "; the machine was too busy to tell times apart" : ""));
  return to_svg(picture);
}

}  // namespace genu
