#include "genu/sweep/shard_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "genu/assemble/table_text.h"
#include "genu/core/file_text.h"
#include "genu/core/program_hash.h"
#include "genu/sweep/whole_file.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

std::string as_cell(double number) { return std::isfinite(number) ? fmt::format("{}", number) : std::string(); }

/// On one line.
std::string as_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return csv_word(text);
}

/// The head up to the program's hash, which may differ from shard to shard.
std::string begin_of_head(const SweepRecord& record, ShardId id) {
  return fmt::format("# genu sweep {} shard {} of {} by ", record.hash, id.number, id.count);
}

std::string cell_of(const std::vector<std::string>& cells, std::size_t k) {
  return k < cells.size() ? cells[k] : std::string();
}

}  // namespace

std::string shard_path(const std::string& folder, ShardId id) {
  const std::size_t digits = std::to_string(id.count).size();
  return (fs::path(folder) / fmt::format("shard-{:0{}}-of-{}.csv", id.number, digits, id.count)).string();
}

std::string column_line(const SweepRecord& record) {
  std::string line = "sample,scene,what_if,class,jumps,jump_at";
  for (const std::string& factor : record.factors) line += "," + as_cell(factor);
  for (const auto& kept : record.kept) line += "," + as_cell(kept.name);
  return line + ",reason";
}

std::string begin_of_row(const SweepRecord& record, std::uint64_t run) {
  const auto& in = record.cases[run / record.samples];
  return fmt::format("{},{},{},", run % record.samples, as_cell(in.scene), as_cell(in.what_if));
}

std::string row_line(const SweepRecord& record, std::uint64_t run, const SampleResult& result) {
  std::string line =
      begin_of_row(record, run) + fmt::format("{},{},{}", result.verdict, result.jumps, as_cell(result.jump_at));
  for (const double draw : result.draws) line += "," + as_cell(draw);
  for (const double kept : result.kept) line += "," + as_cell(kept);
  return line + "," + as_cell(result.reason);
}

std::string write_shard(const std::string& folder, const SweepRecord& record, ShardId id,
                        const std::vector<std::string>& rows) {
  WholeFileWriter file(shard_path(folder, id));
  file.write(begin_of_head(record, id) + program_hash() + "\n" + column_line(record) + "\n");
  for (const std::string& row : rows) {
    file.write(row);
    file.write("\n");
  }
  return file.commit(rows.size());
}

std::optional<std::string> read_shard(const std::string& folder, const SweepRecord& record, ShardId id,
                                      const EachRow& each, Diagnostics& out) {
  const std::string path = shard_path(folder, id);
  const auto refuse = [&](Code code, const char* why) {
    out.error(code, path, why);
    return std::nullopt;
  };
  std::error_code ignored;
  std::ifstream in;
  if (fs::is_regular_file(path, ignored)) in.open(path, std::ios::binary);
  if (!in.is_open()) return refuse(Code::no_such_file, "cannot be read");
  std::string columns;
  const WholeFile file = look_through(in, [&](std::uint64_t number, std::string_view line) {
    if (number == 1) columns = line;
  });
  if (!file.whole) return refuse(Code::broken_file, "is cut short");
  const std::string begin = begin_of_head(record, id);
  if (!file.head.starts_with(begin) || columns != column_line(record))
    return refuse(Code::other_scene, "belongs to another study, or the study has changed");
  const std::uint64_t rows = id.last(record.runs()) - id.first(record.runs());
  if (!file.ends_with(rows)) return refuse(Code::results_changed, "has changed since it was written");
  if (file.lines != rows + 2) return refuse(Code::broken_file, "has another number of rows than runs");
  in.clear();
  in.seekg(static_cast<std::streamoff>(file.head.size() + columns.size() + 2));
  std::string row;
  for (std::uint64_t k = 0; k < rows && std::getline(in, row); ++k) each(row);
  return file.head.substr(begin.size());
}

std::string as_array_list(const std::vector<std::uint64_t>& numbers) {
  std::string list;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    list += (list.empty() ? "" : ",") + std::to_string(numbers[k]);
    if (last > k) list += (last > k + 1 ? "-" : ",") + std::to_string(numbers[last]);
    k = last + 1;
  }
  return list;
}

std::string class_of_row(std::string_view line) {
  constexpr std::size_t kClass = 3;
  std::size_t at = 0;
  for (std::size_t k = 0; k < kClass; ++k) {
    if (at >= line.size() || line[at] == '"') return cell_of(split_row(line), kClass);
    at = std::min(line.size(), line.find(',', at)) + 1;
  }
  return std::string(line.substr(std::min(at, line.size()), line.find(',', at) - at));
}

std::vector<std::string> split_row(std::string_view line) {
  std::vector<TextCell> cells;
  if (!split_separated(line, ',', cells)) return {};
  std::vector<std::string> words;
  for (TextCell& cell : cells) words.push_back(std::move(cell.text));
  return words;
}

}  // namespace genu
