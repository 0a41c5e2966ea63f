// The text of a table of numbers: its encoding, lines, cells and decimal commas.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu {

struct TextLine {
  int number = 0;  ///< from 1
  std::string_view text;
};

struct TextCell {
  std::string text;
  int column = 1;  ///< where it begins in its line, from 1
};

/// Why the bytes are no text in UTF-8 or ASCII: text in UTF-16, a spreadsheet, another binary file. Empty: they are.
std::optional<Fault> fault_of_encoding(std::string_view bytes);

/// Lines without their ends (LF, CR LF or CR) and without a byte order mark; those of blanks alone are passed over.
std::vector<TextLine> lines_of(std::string_view text);

/// Cells between separators, with quotes as in RFC 4180; false where a quote is not closed.
bool split_separated(std::string_view line, char separator, std::vector<TextCell>& cells);

/// Words between blanks.
void split_blanks(std::string_view line, std::vector<TextCell>& cells);

/// The character between the cells of these lines: the first of tab ; , that cuts both lines into as many cells; a
/// blank where only blanks do.
char separator_of(std::string_view names, std::string_view first_row);

/// Whether a whole word is a number, "nan" included.
bool is_number(std::string_view word);

/// Whether a word is a number with a comma in the place of the point: -5,25 or 1,5e-3.
bool has_decimal_comma(std::string_view word);

}  // namespace genu
