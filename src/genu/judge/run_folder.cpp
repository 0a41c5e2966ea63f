#include "genu/judge/run_folder.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/core/file_checksum.h"
#include "genu/core/file_text.h"

namespace genu::judge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::optional<std::string> text_of(const fs::path& path, Diagnostics& out) {
  std::string why;
  auto text = text_of_file(path.string(), why);
  if (!text) out.error(path.string(), why);
  return text;
}

void warn(const std::string& file, std::string rule, Diagnostics& out) {
  out.add({.severity = Diagnostic::Severity::warning, .file = file, .key = {}, .found = {}, .rule = std::move(rule)});
}

/// Rows that the run called ok: a motion counts rows, a path poses.
std::optional<std::size_t> ok_rows(const json& summary) {
  for (const char* key : {"poses", "rows"})
    if (const json counts = summary.value(key, json()); counts.is_object())
      if (const json solved = counts.value("solved", json()); solved.is_number_unsigned())
        return solved.get<std::size_t>();
  return std::nullopt;
}

/// A scene of the caller's choice that is not what the run read.
void compare_scene(const json& summary, const std::string& scene, Diagnostics& out) {
  const json files = summary.value("files", json());
  if (!files.is_array() || files.empty() || !files.front().is_object()) return;
  const json hash = files.front().value("fnv1a64", json());
  const auto now = file_checksum(scene);
  if (now && hash.is_string() && hash.get<std::string>() != now->fnv1a64)
    warn(scene, "is not, byte for byte, the scene that the run read: the results are read with what it says", out);
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
      warn(path, "has changed since the run: its results are read with what it says now", out);
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
  if (!scene.empty()) compare_scene(summary, scene, out);
  compare_files(summary, out);
  if (summary.value("partial", json()) == true)
    warn(at.string(), "is partial: the run was stopped before its end", out);
  found.ok_rows = ok_rows(summary);
  return found;
}

}  // namespace genu::judge
