#include "genu/sweep/sweep_record.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "genu/core/atomic_output.h"
#include "genu/core/file_text.h"

namespace genu {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int kRecordFormat = 3;

std::string to_json(const SweepRecord& r) {
  ordered_json j = {{"genu_sweep", kRecordFormat},
                    {"version", r.version},
                    {"study", r.study},
                    {"title", r.title},
                    {"hash", r.hash},
                    {"design", r.design},
                    {"random", r.random},
                    {"seed", r.seed},
                    {"samples", r.samples},
                    {"block", r.block},
                    {"shards", r.shards},
                    {"main", r.main},
                    {"tables", r.tables}};
  j["cases"] = ordered_json::array();
  for (const auto& c : r.cases) j["cases"].push_back({{"scene", c.scene}, {"what_if", c.what_if}});
  j["factors"] = r.factors;
  j["mesh_errors"] = r.mesh_errors;
  j["kept"] = ordered_json::array();
  for (const auto& k : r.kept) {
    j["kept"].push_back({{"name", k.name}, {"column", k.column}});
    if (k.at_value) j["kept"].back()["value"] = k.value;
  }
  j["events"] = ordered_json::array();
  for (const SweepEvent& e : r.events)
    j["events"].push_back({{"name", e.name}, {"kept", e.kept}, {"above", e.above}, {"limit", e.limit}});
  return j.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

SweepRecord from_json(const ordered_json& j) {
  SweepRecord r;
  r.version = j.at("version"), r.study = j.at("study"), r.title = j.at("title"), r.hash = j.at("hash");
  r.design = j.at("design"), r.random = j.at("random"), r.main = j.at("main"), r.tables = j.at("tables");
  r.seed = j.at("seed"), r.samples = j.at("samples"), r.block = j.at("block"), r.shards = j.at("shards");
  for (const auto& c : j.at("cases")) r.cases.push_back({c.at("scene"), c.at("what_if")});
  for (const auto& f : j.at("factors")) r.factors.push_back(f);
  for (const auto& f : j.at("mesh_errors")) r.mesh_errors.push_back(f);
  for (const auto& k : j.at("kept"))
    r.kept.push_back({k.at("name"), k.at("column"), k.contains("value"), k.value("value", 0.0)});
  for (const auto& e : j.at("events")) {
    r.events.push_back({e.at("name"), e.at("kept"), e.at("above"), e.at("limit")});
    for (const std::size_t k : r.events.back().kept) j.at("kept").at(k);  // throws where there is none
  }
  return r;
}

/// A name that no other thread or process of this machine or another has.
std::string temporary_name(const std::string& path) {
  static std::atomic<int> count = 0;
  char host[256] = "host";
  ::gethostname(host, sizeof host - 1);
  const fs::path p(path);
  return (p.parent_path() / fmt::format(".{}.{}-{}-{}", p.filename().string(), host, ::getpid(), ++count)).string();
}

/// Writes a file where none is; one that is there, whoever made it meanwhile, is left. What went wrong, else an empty
/// text.
std::string write_where_none_is(const std::string& path, const std::string& content) {
  const std::string mine = temporary_name(path);
  if (std::string error = write_file_atomically(mine, content, Durable::yes); !error.empty()) return error;
  int error = ::link(mine.c_str(), path.c_str()) == 0 ? 0 : errno;
  const bool has_links = error == 0 || error == EEXIST;  // some file systems have none
  if (!has_links) error = ::rename(mine.c_str(), path.c_str()) == 0 ? 0 : errno;
  ::unlink(mine.c_str());
  return error == 0 || error == EEXIST ? std::string() : path + ": cannot be written: " + std::strerror(error);
}

/// Whether a folder holds files of others. Another shard may be writing the record at this moment.
bool holds_others(const std::string& folder) {
  std::error_code code;
  bool others = false;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name == kSweepRecord) return false;
    others = others || !name.starts_with(std::string(".") + kSweepRecord);
  }
  return others || code;
}

}  // namespace

SweepRecord record_of(const Sweep& sweep, std::uint64_t shards) {
  SweepRecord r;
  r.version = GENU_VERSION;
  r.study = fs::absolute(sweep.def.file).lexically_normal().string();
  r.title = sweep.def.title;
  r.hash = sweep.hash;
  r.design = to_string(sweep.def.design);
  r.random = is_random(sweep.def.design);
  r.seed = sweep.def.seed;
  r.samples = sweep.design.samples();
  r.block = sweep.design.block();
  r.shards = shards;
  for (const SweepCase& in : sweep.cases) r.cases.push_back({in.scene, in.what_if});
  for (const Factor& factor : sweep.factors) {
    if (factor.mesh_error) r.mesh_errors.push_back(r.factors.size());
    r.factors.push_back(factor.name);
  }
  for (const KeptNumber& k : sweep.kept)
    r.kept.push_back({k.name, k.column, k.row == KeepDef::Row::Kind::value, k.value});
  r.events = sweep.events;
  r.main = sweep.cases.front().main.column;
  r.tables = !sweep.def.tables.empty();
  return r;
}

std::optional<SweepRecord> read_record(const std::string& folder, Diagnostics& out) {
  const std::string path = (fs::path(folder) / kSweepRecord).string();
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    out.error(Code::no_results, folder, "holds no sweep: no sweep.json is there");
    return std::nullopt;
  }
  const auto text = text_of_file(path, out);
  if (!text) return std::nullopt;
  const auto json = ordered_json::parse(*text, nullptr, false);
  try {
    if (!json.is_discarded() && json.at("genu_sweep") == kRecordFormat) return from_json(json);
  } catch (const ordered_json::exception&) {  // the same as a text that is no JSON
  }
  out.error(Code::broken_file, path, "is damaged, or of another version of genu");
  return std::nullopt;
}

bool claim_folder(const std::string& folder, const SweepRecord& record, Diagnostics& out) {
  std::error_code code;
  const fs::path path = fs::path(folder) / kSweepRecord;
  if (!fs::exists(path, code) && fs::exists(folder, code) && holds_others(folder)) {
    out.error(Code::no_output_folder, folder, "holds other things than a sweep: choose another folder");
    return false;
  }
  if (!fs::exists(path, code)) {
    fs::create_directories(folder, code);
    const std::string error = write_where_none_is(path.string(), to_json(record));
    if (!error.empty()) {
      out.error(Code::cannot_write, {}, error);
      return false;
    }
  }
  const auto there = read_record(folder, out);
  if (!there) return false;
  if (there->hash != record.hash) {
    out.error(
        Code::other_scene, folder,
        "belongs to another study, or the study, a scene, a mesh or genu has changed since: choose another folder");
    return false;
  }
  if (there->shards == record.shards) return true;
  out.error(Code::conflict, folder,
            fmt::format("is divided into {}: use --shard K/{}, or choose another folder",
                        there->shards == 1 ? "one shard" : fmt::format("{} shards", there->shards), there->shards));
  return false;
}

}  // namespace genu
