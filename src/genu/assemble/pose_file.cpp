#include "genu/assemble/pose_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "genu/assemble/plain_text.h"
#include "genu/assemble/tolerances.h"

namespace genu {
namespace {

struct Line {
  int number = 0;  // from 1
  std::string_view text;
};

/// Lines without their ends; those of blanks alone are passed over.
std::vector<Line> lines_of(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (!trimmed(line).empty()) lines.push_back({number, line});
  }
  return lines;
}

/// Cells between separators; false where a quote is not closed.
bool split_separated(std::string_view line, char separator, std::vector<PoseFile::Cell>& cells) {
  std::size_t at = 0;
  while (true) {
    PoseFile::Cell cell{{}, static_cast<int>(at) + 1};
    if (at < line.size() && line[at] == '"') {
      for (++at; at < line.size(); ++at) {
        if (line[at] != '"')
          cell.text += line[at];
        else if (at + 1 < line.size() && line[at + 1] == '"')
          cell.text += line[at++];
        else
          break;
      }
      if (at++ == line.size()) return false;
      at = std::min(line.find(separator, at), line.size());
    } else {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      const std::string_view raw = line.substr(at, end - at), word = trimmed(raw);
      cell.text = word;
      if (!word.empty()) cell.column += static_cast<int>(word.data() - raw.data());
      at = end;
    }
    cells.push_back(std::move(cell));
    if (at >= line.size()) return true;
    ++at;
  }
}

void split_blanks(std::string_view line, std::vector<PoseFile::Cell>& cells) {
  for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    cells.push_back({std::string(line.substr(at, end - at)), static_cast<int>(at) + 1});
    at = line.find_first_not_of(" \t", end);
  }
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
    file_.names = split(lines_[names]);
    for (std::size_t k = names + 1; k < lines_.size(); ++k) add_row(split(lines_[k]));
    check_names();
    check_promise(promised_rows_, "nRows", file_.rows.size(), "rows");
    check_promise(promised_columns_, "nColumns", file_.names.cells.size(), "columns");
    if (errors_.count() > 0) return std::nullopt;
    if (file_.rows.empty()) return nothing("holds no pose below its column names");
    return std::move(file_);
  }

 private:
  std::optional<PoseFile> nothing(const std::string& rule) {
    out_.error(Code::broken_file, file_.path, rule);
    return std::nullopt;
  }

  /// Index of the line of names.
  std::size_t find_names() {
    const std::string extension = lower_case(std::filesystem::path(file_.path).extension().string());
    const auto end = std::find_if(lines_.begin(), lines_.end(), [](const Line& l) {
      return lower_case(std::string(trimmed(l.text))) == "endheader";
    });
    storage_ = end != lines_.end();
    if (!storage_) {
      if ((extension == ".sto" || extension == ".mot") && !lines_.empty())
        errors_.add({lines_.front().number, 1}, Code::broken_file, {}, {},
                    "a storage file has a line \"endheader\", which is missing");
      if (!lines_.empty()) separator_ = separator_of(lines_.front().text);
      return 0;
    }
    for (auto line = lines_.begin(); line != end; ++line) read_header(*line);
    return static_cast<std::size_t>(end - lines_.begin()) + 1;
  }

  void read_header(const Line& line) {
    const std::size_t equals = line.text.find('=');
    if (equals == std::string_view::npos) return;
    const std::string key = lower_case(std::string(trimmed(line.text.substr(0, equals))));
    const std::string value = lower_case(std::string(trimmed(line.text.substr(equals + 1))));
    const int column = static_cast<int>(equals) + 2;
    if (key == "indegrees") {
      if (value != "yes" && value != "no")
        errors_.add({line.number, column}, Code::unknown_name, "inDegrees", value, "must be yes or no");
      file_.in_degrees = value == "yes";
    }
    if (key == "nrows") read_promise(line.number, column, "nRows", value, promised_rows_);
    if (key == "ncolumns") read_promise(line.number, column, "nColumns", value, promised_columns_);
    if (key == "datatype" && value != "double")
      errors_.add({line.number, column}, Code::unknown_name, "DataType", value, "must be double: one number a cell");
  }

  /// A number of rows or columns that a storage's header gives.
  struct Promise {
    std::size_t count = 0;
    int line = 0, column = 0;
  };

  void read_promise(int line, int column, const char* key, const std::string& value, std::optional<Promise>& out) {
    constexpr std::size_t kMostDigits = 9;
    if (value.empty() || value.size() > kMostDigits || value.find_first_not_of("0123456789") != std::string::npos)
      errors_.add({line, column}, Code::wrong_form, key, value, "must be a whole number >= 0");
    else
      out = {static_cast<std::size_t>(std::stol(value)), line, column};
  }

  void check_promise(const std::optional<Promise>& promise, const char* key, std::size_t found, const char* what) {
    if (promise && promise->count != found)
      errors_.add({promise->line, promise->column}, Code::broken_file, key, fmt::format("{}", promise->count),
                  fmt::format("the file holds {} {}: copy or export it again", found, what));
  }

  static char separator_of(std::string_view names) {
    for (const char c : {',', ';', '\t'})
      if (names.find(c) != std::string_view::npos) return c;
    return ',';
  }

  PoseFile::Row split(const Line& line) {
    PoseFile::Row row{line.number, {}};
    if (storage_)
      split_blanks(line.text, row.cells);
    else if (!split_separated(line.text, separator_, row.cells))
      errors_.add({line.number, row.cells.empty() ? 1 : row.cells.back().column}, Code::broken_file, {}, {},
                  "has a quote that is not closed");
    return row;
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

  void check_names() {
    std::map<std::string, int> seen;
    for (const PoseFile::Cell& name : file_.names.cells) {
      if (name.text.empty())
        errors_.add({file_.names.line, name.column}, Code::missing_key, {}, {}, "a column has no name");
      const auto [first, fresh] = seen.emplace(name.text, name.column);
      if (!fresh && !name.text.empty())
        errors_.add({file_.names.line, name.column}, Code::duplicate, "column", '"' + name.text + '"',
                    fmt::format("is the name of the column at {} as well", first->second));
    }
  }

  std::vector<Line> lines_;
  LongErrors errors_;
  Diagnostics& out_;
  PoseFile file_;
  bool storage_ = false;
  char separator_ = ',';
  std::optional<Promise> promised_rows_, promised_columns_;
};

}  // namespace

LongErrors::~LongErrors() {
  if (count_ > kProblemsListed)
    out_->error(Code::broken_file, path_, fmt::format("{} more errors like these", count_ - kProblemsListed));
}

void LongErrors::add(SourceLocation where, Code code, const std::string& key, const std::string& found,
                     const std::string& rule) {
  if (++count_ > kProblemsListed) return;
  out_->add(error_at({path_, where}, code, key, found, rule));
}

std::optional<PoseFile> parse_pose_file(const std::string& text, const std::string& path, Diagnostics& out) {
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
