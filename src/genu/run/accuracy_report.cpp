// What accuracy costs in time, as text, table and diagram.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/work_precision.h"
#include "genu/run/accuracy.h"

namespace genu {
namespace {

std::vector<WorkPanel> panels_of(const AccuracyReport& report) {
  std::vector<WorkPanel> panels;
  for (std::size_t g = 0; g < report.groups.size(); ++g) {
    const AccuracyGroup& group = report.groups[g];
    WorkPanel panel{group.name + " [" + group.unit + "]", {}, 0};
    if (const auto t = report.targets.find(group.unit); t != report.targets.end()) panel.target = t->second;
    for (const AccuracyPoint& p : report.points)
      if (p.complete()) panel.points.push_back({p.name, to_string(p.setting.knob), p.pose_seconds, p.errors[g]});
    panels.push_back(std::move(panel));
  }
  return panels;
}

ResultTable table_of(const AccuracyReport& report) {
  ResultTable table;
  for (const char* column : {"varied", "setting", "solved", "build_ms", "us_a_pose", "spread"})
    table.add_column(column);
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

}  // namespace

std::string to_text(const AccuracyReport& report) {
  const ResultTable table = table_of(report);
  std::string out = "errors are the largest of any row, from " + report.reference + "\n\n";
  std::vector<std::string> head = {"varied", "setting", "solved", "build ms", "us a pose"};
  for (const AccuracyGroup& g : report.groups) head.push_back(g.name + " " + g.unit);
  head.push_back("");
  std::vector<std::vector<std::string>> rows = {head};
  for (std::size_t i = 0; i < report.points.size(); ++i) {
    const AccuracyPoint& p = report.points[i];
    const bool again = i > 0 && report.points[i - 1].setting.knob == p.setting.knob;
    std::vector<std::string> row = {
        again ? "" : to_string(p.setting.knob), p.name, fmt::format("{}/{}", p.solved, p.asked),
        fmt::format("{:.1f}", 1e3 * p.build_seconds), fmt::format("{:.1f}", 1e6 * p.pose_seconds)};
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
  out += "  *: no other setting is both faster and more exact, in one group at least\n\n";
  for (const AccuracyGroup& g : report.groups)
    if (g.finest_error > 0)
      out += fmt::format(
          "  {:<12}{} of the finest mesh: {:.2g} {} (uncertain by {:.1g}{})\n", "finest", g.name, g.finest_error,
          g.unit, g.finest_uncertainty,
          g.order > 0 ? fmt::format("; order {:.1f}", g.order) : ", no order is seen: noise and features decide");
  std::string stages;
  for (const auto& [name, seconds] : report.stages)
    stages += fmt::format("{}{} {:.3f} s", stages.empty() ? "" : ", ", name, seconds);
  out += fmt::format("  {:<12}{}\n", "as it is", stages);
  out += fmt::format("  {:<12}{} rounds, medians, on {}{}\n", "times", report.rounds, report.machine,
                     report.noisy ? "; THE MACHINE WAS TOO BUSY to tell times apart: try again" : "");
  return out + fmt::format("  {:<12}{}\n", "answer", report.sentence);
}

std::string to_csv(const AccuracyReport& report) { return table_of(report).to_csv(); }

std::string to_svg(const AccuracyReport& report) {
  return to_svg(report.title + ", " + report.machine, panels_of(report));
}

}  // namespace genu
