#include "genu/sweep/sweep_table.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "genu/core/counted.h"
#include "genu/sweep/shard_file.h"
#include "genu/sweep/statistics.h"
#include "genu/sweep/sweep_def.h"

namespace genu {
namespace {

double number_of(std::string_view cell) {
  double value = kNoNumber;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

/// The cells of a line; where none is in quotes they are parts of it, else of `texts`. None where a quote is not
/// closed.
void find_cells(std::string_view line, std::vector<std::string_view>& cells, std::vector<std::string>& texts) {
  cells.clear();
  if (line.find('"') != std::string_view::npos) {
    texts = split_row(line);
    cells.assign(texts.begin(), texts.end());
    return;
  }
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t stop = std::min(line.size(), line.find(',', at));
    cells.push_back(line.substr(at, stop - at));
    at = stop + 1;
  }
}

/// The case of the same scene as it is.
std::size_t as_it_is(const SweepRecord& record, std::size_t c) {
  for (std::size_t k = 0; k < record.cases.size(); ++k)
    if (record.cases[k].scene == record.cases[c].scene && record.cases[k].what_if == kAsItIs) return k;
  return c;
}

SweepTable empty_table(const SweepRecord& record) {
  SweepTable table;
  table.record = record;
  table.draws.resize(record.factors.size());
  table.cases.resize(record.cases.size());
  for (std::vector<double>& draws : table.draws) draws.reserve(record.samples);
  for (std::size_t c = 0; c < record.cases.size(); ++c) {
    SweepTable::Case& in = table.cases[c];
    in.study = record.study;
    in.reference = as_it_is(record, c);
    if (record.cases.size() > 1) in.name = record.cases[c].scene + "/" + record.cases[c].what_if;
    in.kept.resize(record.kept.size());
    for (std::vector<double>& kept : in.kept) kept.reserve(record.samples);
    in.jumps.reserve(record.samples);
    in.jump_at.reserve(record.samples);
    in.classes.reserve(record.samples);
    in.reasons.reserve(record.samples);
  }
  return table;
}

void add_row(SweepTable& table, std::uint64_t run, const std::vector<std::string_view>& cells) {
  SweepTable::Case& in = table.cases[run / table.record.samples];
  std::size_t c = 3;  // behind sample, scene and what-if
  in.classes.emplace_back(cells[c++]);
  in.jumps.push_back(number_of(cells[c++]));
  in.jump_at.push_back(number_of(cells[c++]));
  const bool first_case = run < table.record.samples;
  for (std::vector<double>& draws : table.draws) {
    if (first_case) draws.push_back(number_of(cells[c]));
    ++c;
  }
  for (std::vector<double>& kept : in.kept) kept.push_back(number_of(cells[c++]));
  in.reasons.emplace_back(cells[c]);
}

}  // namespace

std::string SweepTable::case_name(std::size_t c) const {
  const auto& in = record.cases[c];
  const bool scenes = std::any_of(record.cases.begin(), record.cases.end(),
                                  [&](const auto& other) { return other.scene != record.cases.front().scene; });
  const bool what_ifs =
      std::any_of(record.cases.begin(), record.cases.end(), [](const auto& other) { return other.what_if != kAsItIs; });
  if (!what_ifs) return in.scene;
  return scenes ? in.scene + ", " + in.what_if : in.what_if;
}

std::vector<double> SweepTable::independent(const std::vector<double>& values) const {
  std::vector<double> out;
  for (std::size_t s = 0; s < values.size(); ++s)
    if (!repeats_draws(s)) out.push_back(values[s]);
  return out;
}

std::optional<SweepTable> read_sweep_table(const std::string& folder, const EachRow& row, Diagnostics& out) {
  const auto record = read_record(folder, out);
  if (!record) return std::nullopt;
  std::error_code ignored;
  std::vector<std::uint64_t> missing;
  for (std::uint64_t k = 1; k <= record->shards; ++k)
    if (!std::filesystem::exists(shard_path(folder, {k, record->shards}), ignored)) missing.push_back(k);
  if (!missing.empty()) {
    out.error(Code::no_results, folder,
              fmt::format("lacks {} of {} shards: {}", missing.size(), record->shards, as_array_list(missing)));
    return std::nullopt;
  }
  SweepTable table = empty_table(*record);
  std::vector<std::string_view> cells;
  std::vector<std::string> texts;
  row(column_line(*record));
  const std::size_t width = split_row(column_line(*record)).size();
  std::set<std::string> programs;
  for (std::uint64_t k = 1; k <= record->shards; ++k) {
    const ShardId id{k, record->shards};
    const std::size_t errors = out.count(Diagnostic::Severity::error);
    std::uint64_t run = id.first(record->runs());
    const auto add = [&](std::string_view line) {
      if (out.count(Diagnostic::Severity::error) > errors) return;  // of a row before
      find_cells(line, cells, texts);
      if (cells.size() != width || !line.starts_with(begin_of_row(*record, run)))
        return out.error(Code::broken_file, shard_path(folder, id),
                         fmt::format("has a row {} that is none of this sweep", run - id.first(record->runs()) + 1));
      add_row(table, run++, cells);
      row(line);
    };
    if (const auto program = read_shard(folder, *record, id, add, out)) programs.insert(*program);
  }
  if (programs.size() > 1)
    out.warning(Code::results_changed, folder,
                "has shards of different builds of genu or kinds of processors: their rows may differ by rounding");
  if (out.has_errors()) return std::nullopt;
  return table;
}

}  // namespace genu
