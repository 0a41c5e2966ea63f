#include "genu/sweep/shard_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "genu/assemble/table_text.h"
#include "genu/core/atomic_output.h"
#include "genu/core/file_checksum.h"
#include "genu/core/file_text.h"
#include "genu/store/input_hash.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnd = "# end ";

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

/// What a shard's file is like, without its rows.
struct WholeFile {
  bool whole = false;  ///< ends with the line that every shard ends with
  std::string head, columns, end;
  std::uint64_t rows = 0;
  std::string sum;  ///< of all before the end
};

WholeFile look_through(std::istream& in) {
  WholeFile file;
  RunningChecksum sum;
  std::uint64_t lines = 0;
  std::string line;
  while (std::getline(in, line)) {
    file.whole = !in.eof() && line.starts_with(kEnd);
    file.end = line;
    if (file.whole) continue;  // what follows an end belongs to no shard: then the last line is none
    if (lines == 0) file.head = line;
    if (lines == 1) file.columns = line;
    sum.add(line.append("\n"));
    ++lines;
  }
  file.rows = lines > 2 ? lines - 2 : 0;
  file.sum = sum.sum().xxh128;
  return file;
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
  StagedFile file(shard_path(folder, id), Durable::yes);
  RunningChecksum sum;
  const auto write = [&](std::string_view text) {
    sum.add(text);
    file.write(text);
  };
  write(begin_of_head(record, id) + program_hash() + "\n" + column_line(record) + "\n");
  for (const std::string& row : rows) {
    write(row);
    write("\n");
  }
  file.write(fmt::format("{}{} {}\n", kEnd, rows.size(), sum.sum().xxh128));
  return file.commit();
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
  const WholeFile file = look_through(in);
  if (!file.whole) return refuse(Code::broken_file, "is cut short");
  const std::string begin = begin_of_head(record, id);
  if (!file.head.starts_with(begin) || file.columns != column_line(record))
    return refuse(Code::other_scene, "belongs to another study, or the study has changed");
  const std::uint64_t rows = id.last(record.runs()) - id.first(record.runs());
  if (file.end != fmt::format("{}{} {}", kEnd, rows, file.sum))
    return refuse(Code::results_changed, "has changed since it was written");
  if (file.rows != rows) return refuse(Code::broken_file, "has another number of rows than runs");
  in.clear();
  in.seekg(static_cast<std::streamoff>(file.head.size() + file.columns.size() + 2));
  std::string row;
  for (std::uint64_t k = 0; k < rows && std::getline(in, row); ++k) each(row);
  return file.head.substr(begin.size());
}

std::vector<std::uint64_t> missing_shards(const std::string& folder, const SweepRecord& record, Diagnostics& out) {
  std::vector<std::uint64_t> missing;
  std::error_code ignored;
  for (std::uint64_t k = 1; k <= record.shards; ++k) {
    const ShardId id{k, record.shards};
    Diagnostics broken;
    if (fs::exists(shard_path(folder, id), ignored) && read_shard(
                                                           folder, record, id, [](std::string_view) {}, broken))
      continue;
    missing.push_back(k);
    for (const Diagnostic& d : broken.items()) out.warning(d.code, d.file, d.rule);
  }
  return missing;
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
