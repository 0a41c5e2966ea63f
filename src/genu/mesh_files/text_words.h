// The words of a text file, with the line each stands in.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "genu/mesh_files/mesh_notes.h"

namespace genu {

/// Without the three bytes by which some editors mark UTF-8 (byte-order mark).
inline std::string_view without_mark(std::string_view text) {
  return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

/// Lines end with LF, CR LF or CR. A byte-order mark is passed over.
class TextWords {
 public:
  /// `comment` starts what is passed over up to the line's end; 0: nothing does. The text must outlive this.
  explicit TextWords(std::string_view text, char comment = 0, std::size_t first_line = 1)
      : text_(without_mark(text)), comment_(comment), line_(first_line) {}

  /// The next word; empty at the end of the text.
  std::string_view next() {
    skip(true);
    return word();
  }

  /// The next word of the line of the word that came last; empty where the line has no more. A backslash at the end of
  /// a line joins the next one to it.
  std::string_view next_in_line() {
    skip(false);
    return word();
  }

  std::string_view peek() {
    const std::size_t at = at_, line = line_;
    const std::string_view found = next();
    at_ = at;
    line_ = line;
    return found;
  }

  /// Up to the end of the line, which is left to stand.
  void skip_line() {
    while (at_ < text_.size() && !ends_line(text_[at_])) ++at_;
  }

  /// Of the word that came last.
  std::size_t line() const { return line_; }

  /// All after the word that came last.
  std::string_view rest() const { return text_.substr(at_); }

  /// A word reaches to the very end of the text: nothing tells whether more of it is missing.
  bool open_ended() const { return open_ended_; }

  /// Notes what stands after all that the file promises, and a last number that may be cut.
  void note_end(MeshNotes& notes) {
    if (open_ended_)
      notes.add("no line end after its last number", "if the file was cut there, that number is wrong");
    else if (const std::string_view more = next(); !more.empty())
      notes.add(in_quotes(more) + " after all that its header promises", "it and what follows are left out", line_);
  }

  /// number() of a coordinate. A decimal comma is read as a point, and noted.
  bool decimal(std::string_view word, double& value, MeshNotes& notes) const {
    if (number(word, value)) {
      if (word.find('.') != std::string_view::npos) notes.point();
      return true;
    }
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos || comma + 1 == word.size()) return false;
    std::string with_point(word);
    with_point[comma] = '.';
    if (!number(std::string_view(with_point), value)) return false;
    notes.comma(word, line_);
    return true;
  }

  /// A whole word that is a number ("nan" and "inf" are, as far as this goes); false for anything else.
  template <class T>
  static bool number(std::string_view word, T& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure == std::errc::result_out_of_range && std::is_floating_point_v<T>) {
      value = 0;  // 1e-400; 1e400 is none anybody means
      return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    }
    return failure == std::errc() && end == word.data() + word.size() && !word.empty();
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static bool ends_line(char c) { return c == '\n' || c == '\r'; }

  std::string_view word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    if (at_ > begin && at_ == text_.size()) open_ended_ = true;
    return text_.substr(begin, at_ - begin);
  }

  bool line_ends_at(std::size_t at) const { return at < text_.size() && ends_line(text_[at]); }

  /// Over one end of a line.
  void pass_line_end() {
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
    ++line_;
  }

  void skip(bool over_lines) {
    while (at_ < text_.size()) {
      if (!over_lines && text_[at_] == '\\' && line_ends_at(at_ + 1)) {
        ++at_;
        pass_line_end();
      } else if (ends_line(text_[at_])) {
        if (!over_lines) return;
        pass_line_end();
      } else if (comment_ != 0 && text_[at_] == comment_) {
        skip_line();
      } else if (is_space(text_[at_])) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  char comment_;
  std::size_t at_ = 0, line_;
  bool open_ended_ = false;
};

}  // namespace genu
