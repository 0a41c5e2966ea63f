#include "genu/assemble/table_text.h"

#include <algorithm>
#include <array>

#include "genu/assemble/plain_text.h"
#include "genu/mesh_files/text_words.h"

namespace genu {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool begins_with(std::string_view text, std::string_view begin) { return text.substr(0, begin.size()) == begin; }

std::string_view between(std::string_view line, std::size_t begin, std::size_t end) {
  return line.substr(begin, end - begin);
}

/// From behind the quote that begins a cell; to behind the one that ends it. False where none does.
bool read_quoted(std::string_view line, std::size_t& at, std::string& text) {
  for (; at < line.size(); ++at) {
    if (line[at] != '"')
      text += line[at];
    else if (at + 1 < line.size() && line[at + 1] == '"')
      text += line[at++];
    else
      break;
  }
  return at++ < line.size();
}

std::size_t cells_between(std::string_view line, char separator) {
  std::vector<TextCell> cells;
  if (!split_separated(line, separator, cells)) return 0;
  while (!cells.empty() && cells.back().text.empty()) cells.pop_back();
  return cells.size();
}

}  // namespace

std::optional<Fault> fault_of_encoding(std::string_view bytes) {
  constexpr std::size_t kLooked = 64;
  const std::string_view head = bytes.substr(0, kLooked);
  const auto zeros = std::count(head.begin(), head.end(), '\0');
  const bool marked = begins_with(head, "\xFF\xFE") || begins_with(head, "\xFE\xFF");
  const bool every_other =
      head.size() > 3 && (head[0] == '\0') != (head[1] == '\0') && (head[2] == '\0') != (head[3] == '\0');
  if (marked || (every_other && 3 * zeros > static_cast<std::ptrdiff_t>(head.size())))
    return Fault{Code::not_utf8, "is text in UTF-16: save it as UTF-8 (in spreadsheets \"CSV UTF-8\")"};
  if (begins_with(head, "PK\x03\x04"))
    return Fault{Code::broken_file, "is a zip archive, such as a spreadsheet (.xlsx, .ods): export its table as CSV"};
  if (bytes.find('\0') != std::string_view::npos)
    return Fault{Code::broken_file, "is a binary file: a table in text is expected, CSV or OpenSim's .sto or .mot"};
  return {};
}

std::vector<TextLine> lines_of(std::string_view text) {
  if (begins_with(text, kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<TextLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    const std::size_t over = begins_with(text.substr(end), "\r\n") ? 2 : 1;
    text.remove_prefix(std::min(end + over, text.size()));
    if (!trimmed(line).empty()) lines.push_back({number, line});
  }
  return lines;
}

bool split_separated(std::string_view line, char separator, std::vector<TextCell>& cells) {
  if (separator == ' ') {
    split_blanks(line, cells);
    return true;
  }
  std::size_t at = 0;
  while (true) {
    TextCell cell{{}, static_cast<int>(at) + 1};
    if (at < line.size() && line[at] == '"') {
      if (!read_quoted(line, ++at, cell.text)) return false;
      at = std::min(line.find(separator, at), line.size());
    } else {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      const std::string_view raw = between(line, at, end), word = trimmed(raw);
      cell.text = word;
      if (!word.empty()) cell.column += static_cast<int>(word.data() - raw.data());
      at = end;
    }
    cells.push_back(std::move(cell));
    if (at >= line.size()) return true;
    ++at;
  }
}

void split_blanks(std::string_view line, std::vector<TextCell>& cells) {
  for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    cells.push_back({std::string(between(line, at, end)), static_cast<int>(at) + 1});
    at = line.find_first_not_of(" \t", end);
  }
}

char separator_of(std::string_view names, std::string_view first_row) {
  constexpr std::array kSeparators = {'\t', ';', ',', ' '};  // rows with decimal commas have commas, too
  for (const char c : kSeparators) {
    const std::size_t count = cells_between(names, c);
    if (count > 1 && count == cells_between(first_row, c)) return c;
  }
  for (const char c : {',', ';', '\t'})
    if (names.find(c) != std::string_view::npos) return c;
  return ',';
}

bool is_number(std::string_view word) {
  double value = 0;
  return TextWords::number(word, value);
}

bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || word.find('.') != std::string_view::npos) return false;
  std::string text(word);
  text[comma] = '.';
  return is_number(text);
}

}  // namespace genu
