// A table of poses as a file has it: words in named columns, each with its place. Two formats:
//   CSV        a row of names, then rows of cells, separated by commas (or semicolons, tabs or blanks); RFC 4180
//   quotes.
//              Without names (all cells of the first row are numbers) columns are called 1, 2, 3, ... A row of units
//              below the names joins them: "angle [deg]".
//   .sto .mot  OpenSim's storage: header lines up to `endheader` (pose_header.h); names and numbers separated by tabs
//              or spaces
// Numbers with decimal commas get points, unless the file has points as well.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/pose_header.h"

namespace genu {

struct PoseFile {
  using Cell = TextCell;
  struct Row {
    int line = 0;  ///< from 1
    std::vector<Cell> cells;
  };
  std::string path;
  Row names;              ///< those of columns that nobody uses may be alike or empty
  std::vector<Row> rows;  ///< at least one, each as long as `names`
  AngleUnit angles;       ///< what a header says

  /// Why a word is no number, for messages.
  std::string no_number(const std::string& word) const;
};

/// Reads the file; what is wrong with it is added to `out` with line and column, and the result is empty.
[[nodiscard]] std::optional<PoseFile> read_pose_file(const std::string& path, Diagnostics& out);

/// The same from the text of a file; `path` stands in messages, and its extension tells the format.
[[nodiscard]] std::optional<PoseFile> parse_pose_file(const std::string& text, const std::string& path,
                                                      Diagnostics& out);

/// Adds an error for each of these columns whose name is empty, or that of another column of the file.
void refuse_repeated_names(const PoseFile& file, const std::vector<std::size_t>& columns, Diagnostics& out);

}  // namespace genu
