#include "genu/assemble/pose_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "genu/assemble/column_units.h"
#include "genu/assemble/plain_text.h"
#include "genu/assemble/tolerances.h"

namespace genu {
namespace {

using Cells = std::vector<TextCell>;

void drop_empty_end(Cells& cells, std::size_t least) {
  while (cells.size() > least && cells.back().text.empty()) cells.pop_back();
}

bool all_empty(const Cells& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const TextCell& c) { return c.text.empty(); });
}

bool all_numbers(const Cells& cells) {
  return !cells.empty() && std::all_of(cells.begin(), cells.end(), [](const TextCell& c) {
    return is_number(c.text) || has_decimal_comma(c.text);
  });
}

class PoseFileReader {
 public:
  PoseFileReader(const std::string& text, const std::string& path, Diagnostics& out)
      : lines_(lines_of(text)), errors_(path, out), out_(out) {
    file_.path = path;
  }

  std::optional<PoseFile> read() {
    const std::size_t names = find_names();
    if (errors_.count() > 0) return std::nullopt;
    if (names >= lines_.size()) return nothing("holds no row of column names");
    read_rows(names);
    check_promise(header_.rows, file_.rows.size(), "rows");
    check_promise(header_.columns, file_.names.cells.size(), "columns");
    if (errors_.count() > 0) return std::nullopt;
    if (file_.rows.empty()) return nothing("holds no pose below its column names");
    read_decimal_commas();
    file_.angles = header_.angles;
    return std::move(file_);
  }

 private:
  std::optional<PoseFile> nothing(const std::string& rule) {
    out_.error(Code::broken_file, file_.path, rule);
    return std::nullopt;
  }

  /// Index of the line of names.
  std::size_t find_names() {
    if (lines_.empty()) return 0;
    const TextLine& first = lines_.front();
    const auto end = std::find_if(lines_.begin(), lines_.end(), [](const TextLine& l) {
      return lower_case(std::string(trimmed(l.text))) == "endheader";
    });
    if (end != lines_.end()) {
      header_ = read_pose_header({lines_.begin(), end}, errors_);
      const std::size_t names = static_cast<std::size_t>(end - lines_.begin()) + 1;
      separator_ = separator_of_storage(names);
      return names;
    }
    const std::string extension = lower_case(std::filesystem::path(file_.path).extension().string());
    if (lower_case(std::string(first.text)).starts_with("pathfiletype"))
      errors_.add({first.number, 1}, Code::broken_file, {}, {},
                  "is a table of markers (TRC), not of joint coordinates: OpenSim's inverse kinematics writes a .mot");
    else if (extension == ".sto" || extension == ".mot")
      errors_.add({first.number, 1}, Code::broken_file, {}, {},
                  "a storage file has a line \"endheader\", which is missing");
    separator_ = separator_of(first.text, lines_.size() > 1 ? lines_[1].text : std::string_view());
    return 0;
  }

  /// Blanks and tabs, unless the names have blanks inside.
  char separator_of_storage(std::size_t names) const {
    if (names + 1 >= lines_.size()) return ' ';
    Cells words, cells, row;
    split_blanks(lines_[names].text, words);
    split_blanks(lines_[names + 1].text, row);
    split_separated(lines_[names].text, '\t', cells);
    drop_empty_end(cells, 0);
    return cells.size() > 1 && words.size() != row.size() && cells.size() == row.size() ? '\t' : ' ';
  }

  void read_rows(std::size_t names) {
    std::size_t first = names + 1;
    Cells& cells = file_.names.cells;
    file_.names = split(lines_[names]);
    if (all_numbers(cells) && !is_count(cells)) {
      for (std::size_t c = 0; c < cells.size(); ++c) cells[c].text = fmt::format("{}", c + 1);
      first = names;
    } else if (first < lines_.size()) {
      Cells row;
      split_separated(lines_[first].text, separator_, row);
      drop_empty_end(cells, row.size());
    }
    for (std::size_t k = first; k < lines_.size(); ++k) {
      PoseFile::Row row = split(lines_[k]);
      drop_empty_end(row.cells, cells.size());
      if (all_empty(row.cells)) continue;  // spreadsheets leave such rows
      if (k > names && file_.rows.empty() && names_units(row.cells)) continue;
      if (doubled_by_commas(row)) return;
      add_row(std::move(row));
    }
  }

  /// Names 1, 2, 3, ...
  static bool is_count(const Cells& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (cells[c].text != fmt::format("{}", c + 1)) return false;
    return cells.size() > 1;
  }

  /// A row of units: each cell one of those that columns may have, or of a time, or empty.
  bool names_units(const Cells& cells) {
    Cells& names = file_.names.cells;
    if (cells.size() != names.size()) return false;
    bool any = false;
    for (const TextCell& cell : cells) {
      const std::string word = bare_unit(cell.text);
      const bool unit = column_unit(word) != nullptr;
      if (!unit && !word.empty() && word != "s" && word != "-" && word != "1" && word != "N") return false;
      any = any || unit;
    }
    if (!any) return false;
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (const std::string word = bare_unit(cells[c].text); column_unit(word) != nullptr)
        names[c].text += " [" + word + "]";
    return true;
  }

  PoseFile::Row split(const TextLine& line) {
    PoseFile::Row row{line.number, {}};
    if (!split_separated(line.text, separator_, row.cells))
      errors_.add({line.number, row.cells.empty() ? 1 : row.cells.back().column}, Code::broken_file, {}, {},
                  "has a quote that is not closed");
    return row;
  }

  /// A comma between cells and another in each number: said once.
  bool doubled_by_commas(const PoseFile::Row& row) {
    const std::size_t found = row.cells.size(), wanted = file_.names.cells.size();
    if (separator_ != ',' || found <= wanted || found > 2 * wanted || !all_numbers(row.cells)) return false;
    errors_.add({row.line, row.cells[wanted].column}, Code::wrong_form, {}, {},
                fmt::format("has {} cells where there are {} columns, as where numbers have decimal commas: write the "
                            "table with decimal points, or with ; between its cells",
                            found, wanted));
    return true;
  }

  void add_row(PoseFile::Row row) {
    const std::size_t found = row.cells.size(), wanted = file_.names.cells.size();
    if (found != wanted)
      errors_.add({row.line, found > wanted      ? row.cells[wanted].column
                             : row.cells.empty() ? 1
                                                 : row.cells.back().column},
                  Code::broken_file, {}, {}, fmt::format("has {} cells where there are {} columns", found, wanted));
    file_.rows.push_back(std::move(row));
  }

  void check_promise(const std::optional<PoseHeader::Promise>& promise, std::size_t found, const char* what) {
    if (promise && promise->count != found)
      errors_.add(promise->where, Code::broken_file, promise->key, fmt::format("{}", promise->count),
                  fmt::format("the file holds {} {}: copy or export it again", found, what));
  }

  /// Where the comma does not stand between cells, and no number has a point, it can only be decimal.
  void read_decimal_commas() {
    if (separator_ == ',') return;
    std::vector<TextCell*> commas;
    for (PoseFile::Row& row : file_.rows)
      for (TextCell& cell : row.cells) {
        if (cell.text.find('.') != std::string::npos && is_number(cell.text)) return;
        if (has_decimal_comma(cell.text)) commas.push_back(&cell);
      }
    for (TextCell* cell : commas) cell->text[cell->text.find(',')] = '.';
  }

  std::vector<TextLine> lines_;
  LongErrors errors_;
  Diagnostics& out_;
  PoseFile file_;
  PoseHeader header_;
  char separator_ = ',';
};

}  // namespace

std::string PoseFile::no_number(const std::string& word) const {
  return has_decimal_comma(word) ? "is no number: write the table with decimal points instead of commas"
                                 : "is no number";
}

void refuse_repeated_names(const PoseFile& file, const std::vector<std::size_t>& columns, Diagnostics& out) {
  std::map<std::string, std::vector<std::size_t>> all;
  for (std::size_t c = 0; c < file.names.cells.size(); ++c) all[file.names.cells[c].text].push_back(c);
  for (const auto& [name, places] : all) {
    const auto used = [&](std::size_t c) { return std::find(columns.begin(), columns.end(), c) != columns.end(); };
    if (std::none_of(places.begin(), places.end(), used) || (places.size() < 2 && !name.empty())) continue;
    const FilePlace where{file.path, {file.names.line, file.names.cells[places.back()].column}};
    if (name.empty())
      out.add(error_at(where, Code::missing_key, {}, {}, "a column has no name"));
    else
      out.add(error_at(where, Code::duplicate, "column", '"' + name + '"',
                       fmt::format("is the name of the column at {} as well: rename the one that is not meant",
                                   file.names.cells[places.front()].column)));
  }
}

std::optional<PoseFile> parse_pose_file(const std::string& text, const std::string& path, Diagnostics& out) {
  if (const auto fault = fault_of_encoding(text)) {
    out.error(fault->code, path, fault->text);
    return std::nullopt;
  }
  if (trimmed(text).find_first_not_of("\r\n \t") == std::string_view::npos) {
    out.error(Code::broken_file, path, "is empty: poses are expected, in columns with names");
    return std::nullopt;
  }
  return PoseFileReader(text, path, out).read();
}

std::optional<PoseFile> read_pose_file(const std::string& path, Diagnostics& out) {
  std::error_code failed;
  const auto refuse = [&](Code code, const std::string& rule) {
    out.error(code, path, rule);
    return std::nullopt;
  };
  if (!std::filesystem::exists(path, failed)) return refuse(Code::no_such_file, "there is no such file");
  if (!std::filesystem::is_regular_file(path, failed)) return refuse(Code::cannot_read, "is no regular file");
  if (std::filesystem::file_size(path, failed) > kMaxPoseFileBytes)
    return refuse(Code::too_large, "is larger than 1 GB");
  std::ifstream in(path, std::ios::binary);
  if (!in) return refuse(Code::cannot_read, "cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) return refuse(Code::cannot_read, "cannot be read to its end");
  return parse_pose_file(text, path, out);
}

}  // namespace genu
