#include "genu/judge/run_folder.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/core/file_checksum.h"

namespace genu::judge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::optional<std::string> text_of(const fs::path& path, Diagnostics& out) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return out.error(path.string(), "is no file that can be read"), std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) return out.error(path.string(), "cannot be read"), std::nullopt;
  return text.str();
}

void warn(const std::string& file, std::string rule, Diagnostics& out) {
  out.add({.severity = Diagnostic::Severity::warning, .file = file, .key = {}, .found = {}, .rule = std::move(rule)});
}

/// Files that the run read and that have changed since.
void compare_files(const json& summary, Diagnostics& out) {
  const auto files = summary.find("files");
  if (files == summary.end() || !files->is_array()) return;
  for (const json& file : *files) {
    if (!file.is_object() || !file.value("path", json()).is_string() || !file.value("fnv1a64", json()).is_string())
      continue;
    const auto path = file["path"].get<std::string>();
    const auto now = file_checksum(path);
    if (!now)
      warn(path, "is no longer there: the run read it", out);
    else if (now->fnv1a64 != file["fnv1a64"].get<std::string>())
      warn(path, "has changed since the run: its results are judged by what it says now", out);
  }
}

}  // namespace

std::optional<RunFolder> read_run_folder(const std::string& folder, const std::string& scene, Diagnostics& out,
                                         bool given_too) {
  const fs::path at = folder;
  const std::string summary_path = (at / "summary.json").string();
  const auto results = text_of(at / "results.csv", out);
  const auto text = text_of(summary_path, out);
  if (!results || !text) return std::nullopt;
  const json summary = json::parse(*text, nullptr, false);
  if (!summary.is_object()) return out.error(summary_path, "is no summary of a run"), std::nullopt;
  if (summary.contains("columns") && !given_too)
    return out.error(summary_path, "is of poses that were given: nothing there is called balanced"), std::nullopt;
  RunFolder found{scene, *results};
  if (scene.empty()) {
    for (const char* key : {"scene_path", "scene"})
      if (found.scene.empty() && summary.contains(key) && summary[key].is_string())
        found.scene = summary[key].get<std::string>();
    if (found.scene.empty())
      return out.error(summary_path, "does not say which scene it is of: give --scene"), std::nullopt;
  }
  compare_files(summary, out);
  return found;
}

}  // namespace genu::judge
