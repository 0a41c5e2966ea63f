#include "genu/results/report_merge.h"

#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "genu/results/report_data.h"
#include "genu/results/report_page.h"

namespace genu {
namespace {

/// The content of the element with this id; empty where there is none.
std::optional<std::string_view> element(std::string_view page, const std::string& id) {
  const std::size_t at = page.find(" id=\"" + id + "\">");
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t from = page.find('>', at) + 1, to = page.find('<', from);  // no text of ours holds a bare <
  if (to == std::string_view::npos) return std::nullopt;
  return page.substr(from, to - from);
}

nlohmann::ordered_json parsed(std::string_view page, const std::string& id) {
  const auto text = element(page, id);
  return text ? nlohmann::ordered_json::parse(*text, nullptr, false)
              : nlohmann::ordered_json(nlohmann::ordered_json::value_t::discarded);
}

bool has_runs(const nlohmann::ordered_json& json) {
  return json.is_object() && json.contains("runs") && json["runs"].is_array() && !json["runs"].empty();
}

}  // namespace

std::string why_no_report(const std::string& page) {
  const auto data = parsed(page, "genu-data"), times = parsed(page, "genu-times");
  if (!has_runs(data) || !has_runs(times) || times["runs"].size() != data["runs"].size())
    return "is no report.html of genu";
  if (!data.contains("format") || data["format"] != kReportFormat)
    return "is a report.html of another version of genu: run its scene again";
  for (const auto& run : data["runs"])
    if (!run.is_object() || !run.contains("summary") || !run.contains("chart") || !run.contains("poses"))
      return "is no report.html of genu";
  const std::size_t last = page.find_last_not_of(" \t\r\n");
  if (!std::string_view(page).substr(0, last + 1).ends_with("</html>")) return "is cut: its page has no end";
  return {};
}

std::string merged_report(const std::vector<NamedReport>& reports) {
  nlohmann::ordered_json data = {{"format", kReportFormat}, {"runs", nlohmann::ordered_json::array()}},
                         times = {{"runs", nlohmann::ordered_json::array()}};
  std::string title;
  for (const NamedReport& report : reports) {
    auto more = parsed(report.page, "genu-data");
    const auto more_times = parsed(report.page, "genu-times");
    const std::size_t count = more["runs"].size();
    for (std::size_t k = 0; k < count; ++k) {
      auto& run = more["runs"][k];
      const std::string own = run.contains("name") && run["name"].is_string() ? run["name"].get<std::string>() : "";
      run["name"] = count > 1 ? report.name + ": " + own : report.name;
      data["runs"].push_back(std::move(run));
    }
    for (const auto& run : more_times["runs"]) times["runs"].push_back(run);
    title += (title.empty() ? "" : " and ") + report.name;
  }
  return report_page(title, html_safe_json(data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)),
                     html_safe_json(times.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)));
}

}  // namespace genu
