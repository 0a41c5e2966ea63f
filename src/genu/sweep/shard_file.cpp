#include "genu/sweep/shard_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "genu/assemble/table_text.h"
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

std::string shard_text(const SweepRecord& record, ShardId id, const std::vector<std::string>& rows) {
  std::string text = begin_of_head(record, id) + program_hash() + "\n" + column_line(record) + "\n";
  for (const std::string& row : rows) text.append(row).append("\n");
  text += fmt::format("{}{} {}\n", kEnd, rows.size(), checksum(text).xxh128);
  return text;
}

std::optional<std::string> read_shard(const std::string& folder, const SweepRecord& record, ShardId id,
                                      const EachRow& each, Diagnostics& out) {
  const std::string path = shard_path(folder, id);
  const auto text = text_of_file(path, out);
  if (!text) return std::nullopt;
  const auto refuse = [&](Code code, const char* why) {
    out.error(code, path, why);
    return std::nullopt;
  };
  const std::string begin = begin_of_head(record, id), columns = "\n" + column_line(record) + "\n";
  const std::size_t end = text->rfind(kEnd), head = text->find('\n');
  const std::uint64_t rows = id.last(record.runs()) - id.first(record.runs());
  if (end == std::string::npos || text->back() != '\n') return refuse(Code::broken_file, "is cut short");
  if (!text->starts_with(begin) || text->compare(head, columns.size(), columns) != 0)
    return refuse(Code::other_scene, "belongs to another study, or the study has changed");
  const std::string expected =
      fmt::format("{}{} {}\n", kEnd, rows, checksum(std::string_view(*text).substr(0, end)).xxh128);
  if (text->compare(end, std::string::npos, expected) != 0)
    return refuse(Code::results_changed, "has changed since it was written");
  const std::string_view lines = std::string_view(*text).substr(0, end).substr(head + columns.size());
  if (static_cast<std::uint64_t>(std::count(lines.begin(), lines.end(), '\n')) != rows)
    return refuse(Code::broken_file, "has another number of rows than runs");
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t stop = lines.find('\n', at);
    each(lines.substr(at, stop - at));
    at = stop + 1;
  }
  return text->substr(begin.size(), head - begin.size());
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

std::vector<std::string> split_row(std::string_view line) {
  std::vector<TextCell> cells;
  if (!split_separated(line, ',', cells)) return {};
  std::vector<std::string> words;
  for (TextCell& cell : cells) words.push_back(std::move(cell.text));
  return words;
}

}  // namespace genu
