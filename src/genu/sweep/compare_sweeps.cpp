#include "genu/sweep/compare_sweeps.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "genu/assemble/solution.h"
#include "genu/core/atomic_output.h"
#include "genu/sweep/page_parts.h"
#include "genu/sweep/summary_tables.h"
#include "genu/sweep/sweep_page.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> scenes_in(const SweepRecord& record) {
  std::vector<std::string> scenes;
  for (const SweepRecord::Case& in : record.cases)
    if (std::find(scenes.begin(), scenes.end(), in.scene) == scenes.end()) scenes.push_back(in.scene);
  return scenes;
}

std::optional<std::size_t> kept_named(const SweepRecord& record, const std::string& name) {
  const auto found =
      std::find_if(record.kept.begin(), record.kept.end(), [&](const SweepRecord::Kept& k) { return k.name == name; });
  if (found == record.kept.end()) return std::nullopt;
  return static_cast<std::size_t>(found - record.kept.begin());
}

const SweepEvent* event_named(const SweepRecord& record, const std::string& name) {
  const auto found =
      std::find_if(record.events.begin(), record.events.end(), [&](const SweepEvent& e) { return e.name == name; });
  return found == record.events.end() ? nullptr : &*found;
}

/// Whether sample k of both is drawn alike: all factors that both vary have the same draws.
bool same_samples(const SweepTable& a, const SweepTable& b) {
  bool any = false;
  for (std::size_t f = 0; f < a.record.factors.size(); ++f) {
    const auto found = std::find(b.record.factors.begin(), b.record.factors.end(), a.record.factors[f]);
    if (found == b.record.factors.end()) continue;
    if (a.draws[f] != b.draws[static_cast<std::size_t>(found - b.record.factors.begin())]) return false;
    any = true;
  }
  return any;
}

void check_alike(const NamedSweep& first, const NamedSweep& other, Diagnostics& out) {
  const SweepRecord &a = first.second.record, &b = other.second.record;
  const auto refuse = [&](const std::string& why) { out.error(Code::conflict, other.first, why); };
  if (a.samples != b.samples)
    refuse(fmt::format("has {} samples, and {} has {}: run both with as many", b.samples, first.first, a.samples));
  if (a.block != b.block) refuse("has `indices`, or another number of factors with them, than " + first.first);
  if (a.random != b.random) refuse("has another kind of design than " + first.first);
  if (scenes_in(a).size() != scenes_in(b).size())
    refuse(fmt::format("has {} scenes, and {} has {}", scenes_in(b).size(), first.first, scenes_in(a).size()));
  if (a.main != b.main) refuse(fmt::format("is over {}, and {} is over {}", b.main, first.first, a.main));
}

class SweepJoiner {
 public:
  explicit SweepJoiner(const std::vector<NamedSweep>& sweeps) : sweeps_(sweeps), first_(sweeps.front().second) {
    all_.record = first_.record;
    all_.record.factors.clear();
    all_.record.cases.clear();
    all_.record.hash.clear();
    keep_common();
    for (const NamedSweep& sweep : sweeps) add(sweep);
  }

  JoinedSweeps take() { return {std::move(all_), std::move(paired_)}; }

 private:
  bool all_have(const std::string& number) const {
    return std::all_of(sweeps_.begin(), sweeps_.end(),
                       [&](const NamedSweep& s) { return kept_named(s.second.record, number).has_value(); });
  }

  bool all_have(const SweepEvent& event) const {
    return std::all_of(sweeps_.begin(), sweeps_.end(), [&](const NamedSweep& s) {
      const SweepEvent* other = event_named(s.second.record, event.name);
      return other != nullptr && other->above == event.above && other->limit == event.limit;
    });
  }

  void keep_common() {
    std::erase_if(all_.record.kept, [&](const SweepRecord::Kept& k) { return !all_have(k.name); });
    std::erase_if(all_.record.events, [&](const SweepEvent& e) { return !all_have(e); });
    for (SweepEvent& event : all_.record.events) {
      std::vector<std::size_t> kept;
      for (const std::size_t k : event.kept)
        if (const auto here = kept_named(all_.record, first_.record.kept[k].name)) kept.push_back(*here);
      event.kept = kept;
    }
  }

  void add(const NamedSweep& sweep) {
    const auto& [name, table] = sweep;
    const std::size_t before = all_.cases.size();
    const std::vector<std::string> own = scenes_in(table.record), shown = scenes_in(first_.record);
    const bool many = table.cases.size() > own.size();
    for (std::size_t c = 0; c < table.cases.size(); ++c) {
      const SweepRecord::Case& in = table.record.cases[c];
      const auto scene = std::find(own.begin(), own.end(), in.scene) - own.begin();
      all_.record.cases.push_back({shown[static_cast<std::size_t>(scene)], many ? name + ", " + in.what_if : name});
      SweepTable::Case joined = table.cases[c];
      joined.kept.clear();
      for (const SweepRecord::Kept& k : all_.record.kept)
        joined.kept.push_back(table.cases[c].kept[kept_named(table.record, k.name).value()]);
      joined.reference += before;
      all_.cases.push_back(std::move(joined));
    }
    if (before == 0 || !same_samples(first_, table)) return;
    compare_with_first(table, before);
    paired_.push_back(name);
  }

  /// Each case with that of the first study which has its what-if, else with the scene as it is.
  void compare_with_first(const SweepTable& table, std::size_t before) {
    for (std::size_t c = 0; c < table.cases.size(); ++c) {
      std::optional<std::size_t> best;
      for (std::size_t k = 0; k < first_.cases.size(); ++k) {
        if (all_.record.cases[k].scene != all_.record.cases[before + c].scene) continue;
        const bool same = first_.record.cases[k].what_if == table.record.cases[c].what_if;
        if (same || (!best && first_.cases[k].reference == k)) best = k;
      }
      if (best) all_.cases[before + c].reference = *best;
    }
  }

  const std::vector<NamedSweep>& sweeps_;
  const SweepTable& first_;
  SweepTable all_;
  std::vector<std::string> paired_;
};

/// The folder's own name; the path as given where that is taken.
std::string short_name(const std::string& folder, const std::vector<NamedSweep>& others) {
  fs::path path = fs::path(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string name = path.filename().string();
  const bool taken = std::any_of(others.begin(), others.end(), [&](const auto& other) { return other.first == name; });
  return taken || name.empty() || name == "." || name == ".." ? folder : name;
}

std::vector<std::string> names_of(const std::vector<NamedSweep>& sweeps) {
  std::vector<std::string> names;
  for (const auto& [name, table] : sweeps) names.push_back(name);
  return names;
}

std::string about(const std::vector<NamedSweep>& sweeps, const JoinedSweeps& all) {
  const std::string counts = fmt::format("{} studies of {} samples. ", sweeps.size(), all.table.record.samples);
  if (all.paired.empty()) return counts + "Their samples have other draws: there are no differences sample by sample.";
  return counts + fmt::format("Samples of {} have the draws of {}: differences are those of each knee with itself.",
                              fmt::join(all.paired, ", "), sweeps.front().first);
}

}  // namespace

std::optional<JoinedSweeps> join_sweeps(const std::vector<NamedSweep>& sweeps, Diagnostics& out) {
  for (std::size_t k = 1; k < sweeps.size(); ++k) check_alike(sweeps.front(), sweeps[k], out);
  if (out.has_errors()) return std::nullopt;
  JoinedSweeps all = SweepJoiner(sweeps).take();
  if (all.table.record.kept.empty()) {
    out.error(Code::conflict, fmt::format("{}", fmt::join(names_of(sweeps), ", ")), "keep no number in common");
    return std::nullopt;
  }
  return all;
}

bool has_sweep(const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(), [](const std::string& folder) {
    std::error_code ignored;
    return fs::exists(fs::path(folder) / kSweepRecord, ignored);
  });
}

int compare_sweeps(const std::vector<std::string>& folders, const std::string& file, Diagnostics& out) {
  std::vector<NamedSweep> sweeps;
  for (const std::string& folder : folders)
    if (auto table = read_sweep_table(
            folder, [](std::string_view) {}, out))
      sweeps.emplace_back(short_name(folder, sweeps), std::move(*table));
  if (!file.ends_with(".html")) out.error(Code::usage, file, "is a page: choose a name that ends with .html");
  for (const std::string& folder : folders) {
    std::error_code unknown;
    if (fs::equivalent(fs::path(file).parent_path() / ".", folder, unknown))
      out.error(Code::page_in_result, file, "lies in a study that is compared: choose another folder");
  }
  if (const auto kept = why_not_replaced(file, kSweepPageMark)) out.error(kept->code, {}, kept->text);
  if (folders.size() < 2) out.error(Code::usage, file, "needs two studies at least to compare");
  if (out.has_errors()) return kExitRefused;
  const auto all = join_sweeps(sweeps, out);
  if (!all) return kExitRefused;
  const std::string title = fmt::format("{}", fmt::join(names_of(sweeps), ", ")),
                    page = compared_page(all->table, tables_of(all->table), title, about(sweeps, *all));
  if (const std::string error = write_file_atomically(file, page); !error.empty()) {
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  return kExitOk;
}

}  // namespace genu
