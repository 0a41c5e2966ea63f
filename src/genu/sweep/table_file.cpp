#include "genu/sweep/table_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>

#include "genu/core/file_text.h"
#include "genu/core/program_hash.h"
#include "genu/sweep/whole_file.h"

namespace genu {
namespace {

constexpr std::string_view kTable = "# table ";

std::string begin_of_tables(const SweepRecord& record, ShardId id) {
  return fmt::format("# genu sweep {} tables {} of {} by ", record.hash, id.number, id.count);
}

/// The two numbers of a line "# table RUN ROWS".
struct TableLine {
  std::uint64_t run = 0, rows = 0;
};

TableLine table_line(std::string_view line) {
  TableLine table;
  line.remove_prefix(std::min(kTable.size(), line.size()));
  const auto [blank, error] = std::from_chars(line.data(), line.data() + line.size(), table.run);
  if (error == std::errc() && blank != line.data() + line.size())
    std::from_chars(blank + 1, line.data() + line.size(), table.rows);
  return table;
}

/// Whether an event of the study's own happens in a row of samples.csv.
bool event_happens(const SweepEvent& event, std::size_t first_kept, const std::vector<std::string>& cells) {
  return std::any_of(event.kept.begin(), event.kept.end(), [&](std::size_t k) {
    const std::string& cell = cells.at(first_kept + k);
    double value = 0;
    const bool number = std::from_chars(cell.data(), cell.data() + cell.size(), value).ec == std::errc();
    return number && (event.above ? value > event.limit : value < event.limit);
  });
}

/// The columns of several tables: each new one behind the one that it follows in its table.
class AllColumns {
 public:
  void add(std::string_view line) {
    if (!seen_.emplace(line, std::vector<std::size_t>()).second) return;
    auto at = names_.begin();
    for (const std::string& name : split_row(line)) {
      const auto there = std::find(names_.begin(), names_.end(), name);
      at = there != names_.end() ? there + 1 : names_.insert(at, name) + 1;
    }
  }

  /// Where the columns of a table go. The line is one that was added.
  const std::vector<std::size_t>& places(const std::string& line) {
    std::vector<std::size_t>& places = seen_[line];
    if (places.empty())
      for (const std::string& name : split_row(line))
        places.push_back(static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin()));
    return places;
  }

  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> seen_;
};

/// Writes the rows of a shard's tables, whose file has been checked.
void add_rows(const std::string& path, const SweepRecord& record, AllColumns& columns, StagedFile& file) {
  std::ifstream in(path, std::ios::binary);
  std::string line, head;
  std::vector<std::string> cells(columns.names().size());
  std::getline(in, line);
  while (std::getline(in, line) && line.starts_with(kTable)) {
    const TableLine table = table_line(line);
    std::getline(in, head);
    const std::vector<std::size_t>& places = columns.places(head);
    const bool as_they_are = places.size() == cells.size() && std::is_sorted(places.begin(), places.end());
    const std::string begin = begin_of_row(record, table.run);
    for (std::uint64_t k = 0; k < table.rows && std::getline(in, line); ++k) {
      file.write(begin);
      if (as_they_are) {
        file.write(line + "\n");
        continue;
      }
      std::fill(cells.begin(), cells.end(), std::string());
      const std::vector<std::string> own = split_row(line);
      for (std::size_t c = 0; c < std::min(own.size(), places.size()); ++c) cells[places[c]] = csv_word(own[c]);
      file.write(fmt::format("{}\n", fmt::join(cells, ",")));
    }
  }
}

}  // namespace

bool wants_table(const Sweep& sweep, std::uint64_t run, std::string_view row) {
  const TablesDef& wanted = sweep.def.tables;
  if (wanted.all) return true;
  const std::uint64_t sample = sweep.sample_of(run);
  if (std::any_of(wanted.samples.begin(), wanted.samples.end(), [&](const auto& s) { return s.number == sample; }))
    return true;
  if (wanted.words.empty()) return false;
  const std::vector<std::string> cells = split_row(row);
  constexpr std::size_t kClass = 3, kJumps = 4, kFirstDraw = 6;
  return std::any_of(wanted.words.begin(), wanted.words.end(), [&](const TablesDef::Word& word) {
    if (word.text == "jumped") return cells.at(kJumps) != "0";
    const auto own = std::find_if(sweep.events.begin(), sweep.events.end(),
                                  [&](const SweepEvent& event) { return event.name == word.text; });
    return own == sweep.events.end() ? cells.at(kClass) == word.text
                                     : event_happens(*own, kFirstDraw + sweep.factors.size(), cells);
  });
}

std::string tables_path(const std::string& folder, ShardId id) {
  return std::filesystem::path(shard_path(folder, id)).replace_extension(".tables").string();
}

std::string write_tables(const std::string& folder, const SweepRecord& record, ShardId id,
                         const std::vector<std::uint64_t>& runs, const KeptTables& tables) {
  WholeFileWriter file(tables_path(folder, id));
  file.write(begin_of_tables(record, id) + program_hash() + "\n");
  for (const std::uint64_t run : runs) {
    const auto table = tables.read(run);
    if (!table) return fmt::format("{}.part: the table of run {} cannot be read", tables_path(folder, id), run);
    const auto lines = static_cast<std::uint64_t>(std::count(table->begin(), table->end(), '\n'));
    file.write(fmt::format("{}{} {}\n", kTable, run, lines - 1));
    file.write(*table);
  }
  return file.commit(runs.size());
}

bool check_tables(const std::string& folder, const SweepRecord& record, ShardId id,
                  const std::function<void(std::string_view columns)>& each, Diagnostics& out) {
  const std::string path = tables_path(folder, id);
  const auto refuse = [&](Code code, const char* why) {
    out.error(code, path, why);
    return false;
  };
  std::error_code ignored;
  std::ifstream in;
  if (std::filesystem::is_regular_file(path, ignored)) in.open(path, std::ios::binary);
  if (!in.is_open()) return refuse(Code::no_such_file, "cannot be read");
  std::uint64_t tables = 0;
  bool columns = false;
  const WholeFile file = look_through(in, [&](std::uint64_t, std::string_view line) {
    if (columns) each(line);
    columns = line.starts_with(kTable);
    if (columns) ++tables;
  });
  if (!file.whole) return refuse(Code::broken_file, "is cut short");
  if (!file.head.starts_with(begin_of_tables(record, id)))
    return refuse(Code::other_scene, "belongs to another study, or the study has changed");
  if (!file.ends_with(tables)) return refuse(Code::results_changed, "has changed since it was written");
  return true;
}

bool merge_tables(const std::string& folder, const SweepRecord& record, StagedFile& file, Diagnostics& out) {
  AllColumns columns;
  bool good = true;
  for (std::uint64_t k = 1; k <= record.shards; ++k)
    good = check_tables(
               folder, record, {k, record.shards}, [&](std::string_view line) { columns.add(line); }, out) &&
           good;
  if (!good) return false;
  std::string head = "sample,scene,what_if";
  for (const std::string& name : columns.names()) head += "," + csv_word(name);
  file.write(head + "\n");
  for (std::uint64_t k = 1; k <= record.shards; ++k)
    add_rows(tables_path(folder, {k, record.shards}), record, columns, file);
  return true;
}

}  // namespace genu
