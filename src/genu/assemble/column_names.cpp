#include "genu/assemble/column_names.h"

#include <algorithm>

#include "genu/assemble/plain_text.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

/// "/jointset/knee_r/knee_flex_r" of "/jointset/knee_r/knee_flex_r/value"
std::string without_value(const std::string& path) {
  constexpr const char* kValue = "/value";
  return path.ends_with(kValue) ? path.substr(0, path.size() - std::string(kValue).size()) : path;
}

/// Whether a path is `text`, or ends with it behind a slash; /value at the end of either does not count.
bool ends_with_path(const std::string& path, const std::string& text) {
  const std::string whole = without_value(path), end = without_value(text);
  return whole == end || whole.ends_with(end.starts_with('/') ? end : "/" + end);
}

bool is_time(const std::string& name) {
  const std::string small = lower_case(name);
  for (const char* unit : {"", "(s)", "[s]", " (s)", " [s]", "(sec)", " (sec)", "[sec]", " [sec]", "_s"})
    if (small == std::string("time") + unit) return true;
  return false;
}

}  // namespace

ColumnNames::ColumnNames(const PoseFile::Row& names) {
  for (const PoseFile::Cell& cell : names.cells) {
    names_.push_back(cell.text);
    angles_.push_back(column_label(cell.text, true));
    lengths_.push_back(column_label(cell.text, false));
  }
}

std::optional<std::size_t> ColumnNames::exact(const std::string& text) const {
  const auto it = std::find(names_.begin(), names_.end(), text);
  return it == names_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(it - names_.begin()));
}

std::vector<std::size_t> ColumnNames::called(const std::string& text, bool angle) const {
  if (text.empty()) return {};
  if (const auto c = exact(text)) return {*c};
  std::vector<std::size_t> by_path, by_word;
  for (std::size_t c = 0; c < size(); ++c) {
    const ColumnLabel& l = label(c, angle);
    if (!l.word.empty() && ends_with_path(l.path, text)) by_path.push_back(c);
    if (l.word == text) by_word.push_back(c);
  }
  return by_path.empty() ? by_word : by_path;
}

std::optional<std::size_t> ColumnNames::time() const {
  if (const auto c = exact("time_s")) return c;
  const auto it = std::find_if(names_.begin(), names_.end(), is_time);
  return it == names_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(it - names_.begin()));
}

std::string ColumnNames::near(const std::string& text) const {
  std::vector<std::string> known = names_;
  for (const ColumnLabel& l : angles_) known.push_back(l.word);
  for (const ColumnLabel& l : lengths_) known.push_back(l.word);
  return did_you_mean(text, known);
}

}  // namespace genu
