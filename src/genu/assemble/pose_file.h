// A table of poses as a file has it: words in named columns, each with its place. Two formats:
//   CSV        a row of names, then rows of cells, separated by commas (or semicolons, or tabs); RFC 4180 quotes
//   .sto .mot  OpenSim's storage: header lines up to `endheader`, among them inDegrees=yes|no; names and numbers
//              separated by tabs or spaces
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu {

struct PoseFile {
  struct Cell {
    std::string text;
    int column = 1;  ///< where it begins in its line, from 1
  };
  struct Row {
    int line = 0;  ///< from 1
    std::vector<Cell> cells;
  };
  std::string path;
  Row names;                       ///< no two alike, none empty
  std::vector<Row> rows;           ///< at least one, each as long as `names`
  std::optional<bool> in_degrees;  ///< what a storage's header says
};

/// Reads the file; what is wrong with it is added to `out` with line and column, and the result is empty.
[[nodiscard]] std::optional<PoseFile> read_pose_file(const std::string& path, Diagnostics& out);

/// The same from the text of a file; `path` stands in messages, and its extension tells the format.
[[nodiscard]] std::optional<PoseFile> parse_pose_file(const std::string& text, const std::string& path,
                                                      Diagnostics& out);

/// Errors of a long file: the first ones as they are, then how many more there are.
class LongErrors {
 public:
  LongErrors(std::string path, Diagnostics& out) : path_(std::move(path)), out_(&out) {}
  ~LongErrors();
  LongErrors(const LongErrors&) = delete;
  LongErrors& operator=(const LongErrors&) = delete;

  void add(SourceLocation where, Code code, const std::string& key, const std::string& found, const std::string& rule);
  std::size_t count() const { return count_; }

 private:
  static constexpr std::size_t kProblemsListed = 20;
  std::string path_;
  Diagnostics* out_;
  std::size_t count_ = 0;
};

}  // namespace genu
