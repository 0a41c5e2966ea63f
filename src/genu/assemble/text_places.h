// Pieces of a TOML text to be replaced, found by line and column; everything else stays as its author wrote it.
#pragma once

#include <string>
#include <vector>

#include "genu/core/source_location.h"

namespace genu {

class TextPlaces {
 public:
  explicit TextPlaces(std::string text);

  /// Replaces a number, true or false. Of two calls for one place the first holds.
  void value(const SourceLocation& where, const std::string& with);
  /// Replaces a name in quotes of one character. False where it is not written so.
  bool word(const SourceLocation& where, const std::string& name, const std::string& with);
  /// Replaces a text in quotes or an array, whatever is in it, by `with`. False where none begins there, or it has no
  /// end: texts of several lines are none.
  bool text_or_list(const SourceLocation& where, const std::string& with);
  /// Adds a line below the header [TABLE] at `where`. False where that line is no header of its own.
  bool line_below(const SourceLocation& where, const std::string& line);

  /// The text with the replacements made.
  std::string text();

 private:
  struct Span {
    std::size_t first, last;
    std::string with;
  };
  /// Of a place as TOML counts columns: in characters, of which UTF-8 may need several bytes.
  std::size_t offset(const SourceLocation& where) const;
  void add(Span span);
  /// Behind the text in quotes that begins at `first`; npos where it does not end on its line.
  std::size_t end_of_text(std::size_t first) const;

  std::string text_;
  std::vector<std::size_t> starts_;
  std::vector<Span> spans_;
};

}  // namespace genu
