#include "genu/results/calibration_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/tolerances.h"

namespace genu {

ResultTable calibration_table(const CalibrationReport& report) {
  ResultTable table;
  for (const char* name : {"parameter", "unit", "start", "value", "standard_error"}) table.add_column(name);
  for (const auto& p : report.parameters) table.add_column("correlation." + p.name);
  for (std::size_t k = 0; k < report.parameters.size(); ++k) {
    const CalibrationReport::Parameter& p = report.parameters[k];
    table.add_row();
    table.set("parameter", p.name);
    table.set("unit", p.unit);
    table.set("start", p.start);
    table.set("value", p.value);
    table.set("standard_error", p.deviation);
    for (std::size_t j = 0; j < report.parameters.size(); ++j)
      table.set("correlation." + report.parameters[j].name,
                report.correlation(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)));
  }
  return table;
}

std::string to_text(const CalibrationReport& report) {
  std::string out;
  const auto line = [&](const std::string& name, const std::string& text) {
    out += fmt::format("  {:<12}{}\n", name, text);
  };
  std::size_t width = 9;
  for (const auto& p : report.parameters) width = std::max(width, p.name.size());
  out += fmt::format("  {:<{}}  {:>14}  {:>14}  {:>14}  unit\n", "parameter", width, "start", "fitted", "std. error");
  for (const auto& p : report.parameters)
    out += fmt::format("  {:<{}}  {:>14.8g}  {:>14.8g}  {:>14}  {}\n", p.name, width, p.start, p.value,
                       std::isfinite(p.deviation) ? fmt::format("{:.2g}", p.deviation) : "undetermined", p.unit);
  out += '\n';
  line("fit", fmt::format("{}; {} iterations, {} runs of the scene", report.stop, report.iterations, report.runs));
  line("residual", fmt::format("rms {:.3g} of the target's spread, {:.3g} at the start", report.rms, report.start_rms));
  for (const auto& c : report.columns) line("", fmt::format("{}: rms {:.3g} over {} values", c.name, c.rms, c.values));
  for (std::size_t i = 0; i < report.parameters.size(); ++i)
    for (std::size_t j = i + 1; j < report.parameters.size(); ++j) {
      const double r = report.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(r) < kCloseCorrelation) continue;
      line("correlated", fmt::format("{} and {}: {:.4f}; the target hardly separates them", report.parameters[i].name,
                                     report.parameters[j].name, r));
    }
  for (const std::string& what : report.undetermined) line("undetermined", what + ": the target does not depend on it");
  return out;
}

}  // namespace genu
