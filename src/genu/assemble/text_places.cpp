#include "genu/assemble/text_places.h"

#include <algorithm>
#include <utility>

namespace genu {

TextPlaces::TextPlaces(std::string text) : text_(std::move(text)) {
  starts_.push_back(0);
  for (std::size_t k = 0; k < text_.size(); ++k)
    if (text_[k] == '\n') starts_.push_back(k + 1);
}

std::size_t TextPlaces::offset(const SourceLocation& where) const {
  std::size_t k = starts_[static_cast<std::size_t>(where.line) - 1];
  for (int column = 1; column < where.column && k < text_.size(); ++column) {
    ++k;
    while (k < text_.size() && (static_cast<unsigned char>(text_[k]) & 0xC0) == 0x80) ++k;
  }
  return k;
}

void TextPlaces::add(Span span) {
  const auto same = [&](const Span& s) { return s.first == span.first; };
  if (std::none_of(spans_.begin(), spans_.end(), same)) spans_.push_back(std::move(span));
}

void TextPlaces::value(const SourceLocation& where, const std::string& with) {
  const std::size_t first = offset(where);
  add({first, text_.find_first_of(" \t\r\n,]}#", first), with});
}

bool TextPlaces::word(const SourceLocation& where, const std::string& name, const std::string& with) {
  const std::size_t first = offset(where) + 1;
  if (text_.compare(first, name.size(), name) != 0) return false;
  const char quote = text_[first - 1];
  if ((quote != '"' && quote != '\'') || text_[first + name.size()] != quote) return false;
  if (with.find_first_of("\"'\\\n") != std::string::npos) return false;
  add({first, first + name.size(), with});
  return true;
}

std::size_t TextPlaces::end_of_text(std::size_t first) const {
  const char quote = text_[first];
  for (std::size_t k = first + 1; k < text_.size() && text_[k] != '\n'; ++k) {
    if (text_[k] == quote) return k + 1;
    if (text_[k] == '\\' && quote == '"') ++k;
  }
  return std::string::npos;
}

bool TextPlaces::text_or_list(const SourceLocation& where, const std::string& with) {
  const std::size_t first = offset(where);
  const auto is_quote = [&](std::size_t k) { return k < text_.size() && (text_[k] == '"' || text_[k] == '\''); };
  const bool list = first < text_.size() && text_[first] == '[';
  if (!list && (!is_quote(first) || (is_quote(first + 1) && is_quote(first + 2)))) return false;
  std::size_t k = list ? first + 1 : end_of_text(first);
  for (int depth = list ? 1 : 0; depth > 0 && k < text_.size();) {
    if (is_quote(k)) {
      k = end_of_text(k);
      continue;
    }
    if (text_[k] == '#') k = std::min(text_.find('\n', k), text_.size() - 1);
    depth += text_[k] == '[' ? 1 : text_[k] == ']' ? -1 : 0;
    ++k;
    if (depth > 0 && k >= text_.size()) return false;
  }
  if (k == std::string::npos) return false;
  add({first, k, with});
  return true;
}

bool TextPlaces::line_below(const SourceLocation& where, const std::string& line) {
  const auto k = static_cast<std::size_t>(where.line);
  const std::size_t first = text_.find_first_not_of(" \t", starts_[k - 1]);
  if (first == std::string::npos || text_[first] != '[') return false;
  if (k < starts_.size())
    add({starts_[k], starts_[k], line + "\n"});
  else
    add({text_.size(), text_.size(), "\n" + line + "\n"});
  return true;
}

std::string TextPlaces::text() {
  std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) { return a.first > b.first; });
  for (const Span& s : spans_) text_.replace(s.first, std::min(s.last, text_.size()) - s.first, s.with);
  return std::move(text_);
}

}  // namespace genu
