// What a reader met in a mesh file that is not as its format has it, and read all the same. Each kind becomes a
// warning.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "genu/mesh/polygon_cut.h"

namespace genu {

/// "word" cut short and with what cannot be printed left out: for messages.
inline std::string in_quotes(std::string_view word) {
  std::string out = "\"";
  for (const char c : word.substr(0, 24)) out += c >= ' ' && c < 127 ? c : '?';
  return out + (word.size() > 24 ? "...\"" : "\"");
}

class MeshNotes {
 public:
  /// The file has `found`; `done` says what the reader did. Repeats are counted. `line`: 0 where there are no lines.
  void add(std::string_view found, std::string_view done, std::size_t line = 0, std::size_t times = 1);

  /// A number with a decimal comma, and one with a decimal point.
  void comma(std::string_view word, std::size_t line);
  void point() { point_ = true; }

  /// What is wrong where both stand in one file: a comma may part thousands there. Else empty.
  [[nodiscard]] std::string problem() const;

  /// "has FOUND in line 7 and 11 others: DONE", in the order in which they were met.
  std::vector<std::string> texts() const;

 private:
  struct Note {
    std::string found, done;
    std::size_t line = 0, times = 0;
  };
  std::vector<Note> notes_;
  std::string comma_;  ///< the first number with one
  std::size_t comma_line_ = 0;
  bool point_ = false;
};

/// cut_concave() with a note of what it could not cut.
void cut_polygons(Mesh& mesh, const std::vector<Fan>& fans, MeshNotes& notes);

}  // namespace genu
