#include "genu/judge/run_folder.h"

#include <algorithm>
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
  Diagnostics found;
  auto text = text_of_file(path.string(), found);
  for (Diagnostic d : found.items()) {
    if (d.code == Code::no_such_file) d.code = Code::no_results;
    out.add(std::move(d));
  }
  return text;
}

bool is_count(const json& value) { return value.is_number_unsigned(); }

/// genu 0.1 wrote FNV-1a.
bool has_old_checksums(const json& summary) {
  const json results = summary.value("results", json());
  return results.is_object() && results.contains("fnv1a64");
}

/// The first key of summary.json with a missing or wrong value, of those that every run writes; else empty.
std::string wrong_key(const json& summary, bool given) {
  if (!summary.value("partial", json()).is_boolean()) return "partial";
  const json files = summary.value("files", json()), results = summary.value("results", json());
  if (!files.is_array()) return "files";
  for (const json& file : files)
    if (!file.is_object() || !file.value("path", json()).is_string() || !file.value("xxh128", json()).is_string())
      return "files";
  if (!results.is_object() || !is_count(results.value("rows", json())) || !results.value("xxh128", json()).is_string())
    return "results";
  if (given) return {};
  const char* counted = summary.contains("motion") ? "rows" : "poses";  // a motion counts rows, a path poses
  const json counts = summary.value(counted, json());
  return counts.is_object() && is_count(counts.value("solved", json())) ? "" : counted;
}

/// "Solved, but the joint jumped ..." of a run that jumps or is not plausible; else empty.
std::string doubt_of(const json& summary) {
  const json verdict = summary.value("verdict", json());
  if (!verdict.is_object() || verdict.value("class", json()) != "doubtful") return {};
  const json sentences = verdict.value("sentences", json());
  return sentences.is_array() && !sentences.empty() && sentences[0].is_string() ? sentences[0].get<std::string>() : "";
}

/// What the run changed in its scene; false where that is not what a run writes.
bool read_changes(const json& summary, SceneChanges& changes) {
  if (!summary.contains("changes")) return true;
  const json& said = summary["changes"];
  const auto read = [&](const char* key, std::vector<std::string>& options) {
    if (!said.is_object() || !said.contains(key) || !said[key].is_array()) return false;
    for (const json& option : said[key]) {
      if (!option.is_string()) return false;
      options.push_back(option.get<std::string>());
    }
    return true;
  };
  return read("without", changes.without) && read("set", changes.set);
}

/// Warns where the table is not the one that the run wrote.
void compare_table(const json& written, const std::string& path, const std::string& text, Diagnostics& out) {
  if (checksum(text).xxh128 == written["xxh128"].get<std::string>()) return;
  const auto rows = written["rows"].get<std::size_t>();
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  const std::size_t now = lines - std::min<std::size_t>(lines, 1);
  if (now != rows)
    out.error(Code::results_changed, path,
              fmt::format("has {} rows where the run wrote {}: it was cut or added to since", now, rows));
  else
    out.warning(Code::results_changed, path, "is not, byte for byte, what the run wrote: it has changed since");
}

/// Warns where the caller's scene is not the one that the run read.
void compare_scene(const json& summary, const std::string& scene, Diagnostics& out) {
  const auto now = file_checksum(scene);
  if (now && !summary["files"].empty() && summary["files"].front()["xxh128"].get<std::string>() != now->xxh128)
    out.warning(Code::other_scene, scene,
                "is not, byte for byte, the scene that the run read: the results are read with what it says");
}

/// Warns of files that have changed since the run read them.
void compare_files(const json& summary, const std::string& path_of_summary, Diagnostics& out) {
  if (summary["files"].empty())
    out.warning(Code::results_changed, path_of_summary, "does not say which files the run has read");
  for (const json& file : summary["files"]) {
    const auto path = file["path"].get<std::string>();
    const auto now = file_checksum(path);
    if (!now)
      out.warning(Code::other_scene, path, "is no longer there: the run read it");
    else if (now->xxh128 != file["xxh128"].get<std::string>())
      out.warning(Code::other_scene, path, "has changed since the run: its results are read with what it says now");
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
  if (!summary.is_object()) return out.error(Code::no_results, summary_path, "is no summary of a run"), std::nullopt;
  if (has_old_checksums(summary))
    return out.error(Code::other_version, summary_path,
                     "has checksums of another version of genu, " + summary.value("genu", json()).dump() +
                         ", which this one does not know"),
           std::nullopt;
  const bool given = summary.contains("columns");
  if (given && !given_too)
    return out.error(Code::not_applicable, summary_path,
                     "is of poses that were given: nothing there is called balanced"),
           std::nullopt;
  if (const std::string wrong = wrong_key(summary, given); !wrong.empty())
    return out.error(Code::no_results, summary_path,
                     "`" + wrong + "` is missing or not what a run writes: it is no summary of a run"),
           std::nullopt;
  RunFolder found{scene, *results};
  if (scene.empty()) {
    for (const char* key : {"scene_path", "scene"})
      if (found.scene.path.empty() && summary.contains(key) && summary[key].is_string())
        found.scene.path = summary[key].get<std::string>();
    if (found.scene.path.empty())
      return out.error(Code::other_scene, summary_path, "does not say which scene it is of: give --scene"),
             std::nullopt;
  }
  if (!read_changes(summary, found.scene.changes))
    return out.error(Code::no_results, summary_path, "`changes` is not what a run writes: it is no summary of a run"),
           std::nullopt;
  if (!scene.empty()) compare_scene(summary, scene, out);
  compare_files(summary, summary_path, out);
  compare_table(summary["results"], (at / "results.csv").string(), *results, out);
  if (summary["partial"].get<bool>())
    out.warning(Code::results_changed, at.string(), "is partial: the run was stopped before its end");
  if (out.has_errors()) return std::nullopt;
  found.doubt = doubt_of(summary);
  if (!given) found.ok_rows = summary[summary.contains("motion") ? "rows" : "poses"]["solved"].get<std::size_t>();
  return found;
}

}  // namespace genu::judge
