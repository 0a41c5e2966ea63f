#include "genu/results/calibration_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/tolerances.h"

namespace genu {

ResultTable calibration_table(const CalibrationReport& report) {
  ResultTable table;
  for (const char* name : {"parameter", "unit", "start", "value", "standard_error"}) table.add_column(name);
  const auto has_note = [](const CalibrationReport::Parameter& p) { return !p.note.empty(); };
  const bool notes = std::any_of(report.parameters.begin(), report.parameters.end(), has_note);
  if (notes) table.add_column("note");
  for (const auto& p : report.parameters) table.add_column("correlation." + p.name);
  for (std::size_t k = 0; k < report.parameters.size(); ++k) {
    const CalibrationReport::Parameter& p = report.parameters[k];
    table.add_row();
    table.set("parameter", p.name);
    table.set("unit", p.unit);
    table.set("start", p.start);
    table.set("value", p.value);
    table.set("standard_error", p.deviation);
    if (notes) table.set("note", p.note);
    for (std::size_t j = 0; j < report.parameters.size(); ++j)
      table.set("correlation." + report.parameters[j].name,
                report.correlation(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)));
  }
  return table;
}

ResultTable starts_table(const CalibrationReport& report) {
  ResultTable table;
  for (const char* name : {"name", "stop", "iterations", "rms"}) table.add_column(name);
  for (const auto& p : report.parameters)
    for (const char* when : {".start", ".end"}) table.add_column(p.name + when);
  for (const CalibrationReport::Start& s : report.starts) {
    table.add_row();
    table.set("name", s.name);
    table.set("stop", s.stop);
    table.set("iterations", static_cast<long>(s.iterations));
    table.set("rms", s.rms);
    for (std::size_t k = 0; k < report.parameters.size(); ++k) {
      table.set(report.parameters[k].name + ".start", s.start[k]);
      table.set(report.parameters[k].name + ".end", s.end[k]);
    }
  }
  return table;
}

namespace {

std::string error_words(const CalibrationReport::Parameter& p) {
  return std::isfinite(p.deviation) ? fmt::format("{:.2g}", p.deviation) : "undetermined";
}

}  // namespace

std::string to_text(const CalibrationReport& report) {
  std::string out;
  const auto line = [&](const std::string& name, const std::string& text) {
    out += fmt::format("  {:<12}{}\n", name, text);
  };
  if (!report.converged) line("caution", "the fit has not converged: its numbers are not those of the target");
  if (!report.misfit.empty()) line("caution", report.misfit);
  std::size_t width = 9;
  for (const auto& p : report.parameters) width = std::max(width, p.name.size());
  out += fmt::format("  {:<{}}  {:>14}  {:>14}  {:>14}  unit\n", "parameter", width, "start", "fitted", "std. error");
  for (const auto& p : report.parameters)
    out += fmt::format("  {:<{}}  {:>14.8g}  {:>14.8g}  {:>14}  {}{}{}\n", p.name, width, p.start, p.value,
                       error_words(p), p.unit, p.note.empty() ? "" : ": ", p.note);
  out += '\n';
  line("fit", fmt::format("{}; {} iterations, {} runs of the scene{}", report.stop, report.iterations, report.runs,
                          report.exact ? ", exact derivatives" : ""));
  for (const CalibrationReport::Start& s : report.starts)
    if (report.starts.size() > 1)
      line(&s == &report.starts.front() ? "starts" : "", fmt::format("{}: rms {:.3g}; {}", s.name, s.rms, s.stop));
  const bool stated = !report.columns.empty() && report.columns.front().stated;
  line("residual", fmt::format("rms {:.3g} of the {}, {:.3g} at the start", report.rms,
                               stated ? "stated errors" : "target's spread", report.start_rms));
  for (const auto& c : report.columns)
    line("", fmt::format("{}{}: rms {:.3g} over {} values", c.held_out ? c.file + ", not fitted: " : "", c.name, c.rms,
                         c.values));
  for (std::size_t i = 0; i < report.parameters.size(); ++i)
    for (std::size_t j = i + 1; j < report.parameters.size(); ++j) {
      const double r = report.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(r) < kCloseCorrelation) continue;
      line("correlated", fmt::format("{} and {}: {:.4f}; the target hardly separates them", report.parameters[i].name,
                                     report.parameters[j].name, r));
    }
  for (const std::string& what : report.undetermined) line("undetermined", what + ": the target does not depend on it");
  for (const std::string& sentence : report.slack) line("slack", sentence);
  if (!report.poorest.empty())
    line("poorest",
         fmt::format("{}: standard error {:.2g} of this direction", report.poorest, report.poorest_deviation));
  return out;
}

}  // namespace genu
