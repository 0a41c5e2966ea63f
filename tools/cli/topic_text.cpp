#include <algorithm>
#include <sstream>

#include "topic_text.h"
#include "topics.h"

namespace genu::cli {
namespace {

constexpr std::size_t kWidth = 100;

/// Words of `text` in lines of at most kWidth, each begun with `indent` spaces; the first with `first` instead.
std::string wrapped(const std::string& text, const std::string& first, std::size_t indent) {
  std::istringstream words(text);
  std::string out, line = first;
  bool empty = true;
  for (std::string word; words >> word;) {
    if (!empty && line.size() + 1 + word.size() > kWidth) {
      out += line + "\n";
      line = std::string(indent, ' ');
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return out + line + "\n";
}

bool is_table_line(const std::string& line) { return line.rfind('|', 0) == 0; }

}  // namespace

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  bool code = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '`') code = !code;
    if (line[i] == '|' && !code) {
      const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
      cells.push_back(from == std::string::npos ? std::string() : cell.substr(from, to - from + 1));
      cell.clear();
    } else {
      cell += line[i];
    }
  }
  return cells;
}

bool is_rule_line(const std::string& line) {
  return is_table_line(line) && line.find_first_not_of("|-: ") == std::string::npos;
}

std::string plain_words(const std::string& markdown) {
  std::string out;
  for (std::size_t i = 0; i < markdown.size(); ++i) {
    const std::size_t close = markdown[i] == '[' ? markdown.find("](", i) : std::string::npos;
    const std::size_t end = close == std::string::npos ? close : markdown.find(')', close);
    if (end != std::string::npos && markdown.find_first_of("[\n", i + 1) > close) {
      out += plain_words(markdown.substr(i + 1, close - i - 1));
      i = end;
    } else if (markdown.compare(i, 2, "**") == 0) {
      ++i;
    } else if (markdown[i] != '`') {
      out += markdown[i];
    }
  }
  return out;
}

std::string row_text(const std::vector<std::string>& heads, const std::vector<std::string>& cells) {
  const std::string name = "  " + plain_words(cells.empty() ? std::string() : cells.front());
  std::string said;
  for (std::size_t c = 1; c < cells.size(); ++c) {
    if (cells[c].empty()) continue;
    const bool named = c > 1 && c < heads.size() && !heads[c].empty();
    said += (said.empty() ? "" : "; ") + (named ? plain_words(heads[c]) + ": " : std::string()) + plain_words(cells[c]);
  }
  constexpr std::size_t kColumn = 24;
  if (name.size() + 2 > kColumn) return name + "\n" + wrapped(said, std::string(kColumn, ' '), kColumn);
  return wrapped(said, name + std::string(kColumn - name.size(), ' '), kColumn);
}

std::string plain_text_of(const std::string& markdown) {
  std::istringstream lines(markdown);
  std::string out, paragraph;
  std::vector<std::string> heads;
  bool code = false;
  const auto flush = [&] {
    const bool item = paragraph.rfind("- ", 0) == 0;
    if (!paragraph.empty()) out += wrapped(plain_words(paragraph), "", item ? 2 : 0);
    paragraph.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) {
      flush();
      code = !code;
    } else if (code) {
      out += "    " + line + "\n";
    } else if (is_table_line(line)) {
      flush();
      if (is_rule_line(line)) continue;
      if (heads.empty())
        heads = cells_of(line);
      else
        out += row_text(heads, cells_of(line));
    } else if (line.rfind("<!--", 0) != 0 && line.rfind("![", 0) != 0) {
      heads.clear();
      const bool starts = line.empty() || line.front() == '#' || line.rfind("- ", 0) == 0 || line.rfind("    ", 0) == 0;
      if (starts) flush();
      if (line.empty())
        out += "\n";
      else if (line.front() == '#')
        out += plain_words(line.substr(line.find_first_not_of("# "))) + "\n";
      else if (line.rfind("    ", 0) == 0)
        out += line + "\n";
      else
        paragraph += (paragraph.empty() ? "" : " ") + line;
    }
  }
  flush();
  return out;
}

}  // namespace genu::cli
