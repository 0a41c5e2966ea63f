#include "genu/sweep/merge_sweep.h"

#include <filesystem>
#include <optional>
#include <vector>

#include "genu/assemble/solution.h"
#include "genu/core/atomic_output.h"
#include "genu/sweep/npz_file.h"
#include "genu/sweep/summary_tables.h"
#include "genu/sweep/sweep_page.h"
#include "genu/sweep/sweep_table.h"
#include "genu/sweep/table_file.h"

namespace genu {
namespace {

/// samples.npz: draws of each factor (one dimension: the samples), kept numbers, classes and jumps of each case.
std::string write_arrays(const std::filesystem::path& path, const SweepTable& sweep) {
  NpzFile file(path);
  std::vector<std::string> scenes, what_ifs;
  for (const auto& in : sweep.record.cases) scenes.push_back(in.scene), what_ifs.push_back(in.what_if);
  file.add_words("scene", {&scenes}, true);
  file.add_words("what_if", {&what_ifs}, true);
  for (std::size_t f = 0; f < sweep.draws.size(); ++f)
    file.add_numbers(sweep.record.factors[f], {&sweep.draws[f]}, true);
  std::vector<const std::vector<std::string>*> classes;
  std::vector<const std::vector<double>*> jumps, jump_at;
  for (const SweepTable::Case& in : sweep.cases) {
    classes.push_back(&in.classes);
    jumps.push_back(&in.jumps);
    jump_at.push_back(&in.jump_at);
  }
  file.add_words("class", classes, false);
  file.add_numbers("jumps", jumps, false);
  file.add_numbers("jump_at", jump_at, false);
  for (std::size_t k = 0; k < sweep.record.kept.size(); ++k) {
    std::vector<const std::vector<double>*> kept;
    for (const SweepTable::Case& in : sweep.cases) kept.push_back(&in.kept[k]);
    file.add_numbers(sweep.record.kept[k].name, kept, false);
  }
  return file.commit();
}

}  // namespace

int merge_sweep(const std::string& folder, Diagnostics& out, std::string& text) {
  const std::filesystem::path in = folder;
  StagedFile samples(in / "samples.csv", Durable::yes);  // row by row: all of them may be larger than the memory
  const auto add = [&](std::string_view row) {
    samples.write(row);
    samples.write("\n");
  };
  const auto sweep = read_sweep_table(folder, add, out);
  if (!sweep) return kExitRefused;
  std::optional<StagedFile> whole_tables;
  if (sweep->record.tables) whole_tables.emplace(in / "tables.csv", Durable::yes);
  if (whole_tables && !merge_tables(folder, sweep->record, *whole_tables, out)) return kExitRefused;
  const SweepTables tables = tables_of(*sweep);
  std::vector<std::pair<std::string, std::string>> files = {
      {"statistics.csv", tables.statistics.to_csv()}, {"events.csv", tables.events.to_csv()},
      {"ranks.csv", tables.ranks.to_csv()},           {"convergence.csv", tables.convergence.to_csv()},
      {"summary.json", summary_json(*sweep, tables)}, {"report.html", sweep_page(*sweep, tables)}};
  if (sweep->record.block > 1) files.emplace_back("indices.csv", tables.indices.to_csv());
  std::string error = samples.commit();
  if (error.empty() && whole_tables) error = whole_tables->commit();
  if (error.empty()) error = write_arrays(in / "samples.npz", *sweep);
  for (const auto& [name, content] : files)
    if (error.empty()) error = write_file_atomically(in / name, content, Durable::yes);
  if (!error.empty()) {
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  text = summary_text(*sweep, tables);
  return kExitOk;
}

}  // namespace genu
