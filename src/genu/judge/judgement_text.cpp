#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/judge/judge.h"

namespace genu::judge {
namespace {

std::string with_comma_safe(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

}  // namespace

std::string to_text(const Judgement& j) {
  std::string out = fmt::format("{:<30}{:>9}{:>7}{:>12}{:>12}  {:<12}{}\n", "check", "numbers", "poses", "worst",
                                "tolerance", "unit", "where the worst is");
  for (const Finding& f : j.findings.all())
    out += fmt::format("{:<30}{:>9}{:>7}{:>12.3g}{:>12.3g}  {:<12}{}{}\n", f.check, f.judged, f.poses, f.worst,
                       f.tolerance, f.unit, f.where,
                       f.good() ? "" : fmt::format("   REJECTED in {} pose(s)", f.rejected.size()));
  for (const std::string& what : j.not_judged) out += "not judged: " + what + "\n";
  constexpr std::size_t kRowsListed = 10;
  for (std::size_t k = 0; k < std::min(kRowsListed, j.not_ok.size()); ++k)
    out += fmt::format("not judged: row {}, whose status is \"{}\"\n", j.not_ok[k].first + 1, j.not_ok[k].second);
  if (j.not_ok.size() > kRowsListed)
    out += fmt::format("not judged: {} more rows that are not ok\n", j.not_ok.size() - kRowsListed);
  if (j.judged == 0) return out + "verdict: no pose is called ok, there is nothing to judge\n";
  const std::size_t bad = j.rejected();
  for (std::size_t k = 0; k < std::min(kRowsListed, j.jumps.size()); ++k)
    out += fmt::format("jump: no path connects row {} with row {}; from there on it is another position\n", j.jumps[k],
                       j.jumps[k] + 1);
  return out + (bad == 0 ? fmt::format("verdict: accepted, all {} poses that are called ok\n", j.judged)
                         : fmt::format("verdict: REJECTED, {} of {} poses that are called ok\n", bad, j.judged));
}

std::string to_json(const Judgement& j) {
  nlohmann::ordered_json out;
  out["accepted"] = j.accepted();
  out["jumps_at_rows"] = nlohmann::ordered_json::array();
  for (const std::size_t row : j.jumps) out["jumps_at_rows"].push_back(row + 1);
  out["poses"] = {{"rows", j.rows}, {"judged", j.judged}, {"rejected", j.rejected()}};
  const auto number = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nullptr; };
  for (const Finding& f : j.findings.all()) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const std::size_t r : f.rejected) rows.push_back(r + 1);
    out["checks"].push_back({{"check", f.check},
                             {"numbers", f.judged},
                             {"poses", f.poses},
                             {"worst", number(f.worst)},
                             {"tolerance", number(f.tolerance)},
                             {"unit", f.unit},
                             {"where", f.where},
                             {"rejected_rows", rows}});
  }
  out["not_judged"] = j.not_judged;
  for (const auto& [row, status] : j.not_ok) out["rows_not_ok"].push_back({{"row", row + 1}, {"status", status}});
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string to_csv(const Judgement& j) {
  std::string out = "check,numbers,poses,worst,tolerance,unit,where,rejected_poses\n";
  for (const Finding& f : j.findings.all())
    out += fmt::format("{},{},{},{},{:.17g},{},{},{}\n", f.check, f.judged, f.poses,
                       std::isfinite(f.worst) ? fmt::format("{:.17g}", f.worst) : "", f.tolerance,
                       with_comma_safe(f.unit), with_comma_safe(f.where), f.rejected.size());
  return out;
}

}  // namespace genu::judge
