// The columns of a table by the names that users have for them: whole, without a unit, or the last part of a path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/column_units.h"
#include "genu/assemble/pose_file.h"

namespace genu {

class ColumnNames {
 public:
  explicit ColumnNames(const PoseFile::Row& names);

  std::size_t size() const { return names_.size(); }
  const std::string& operator[](std::size_t c) const { return names_[c]; }
  const std::vector<std::string>& all() const { return names_; }
  const ColumnLabel& label(std::size_t c, bool angle) const { return (angle ? angles_ : lengths_)[c]; }

  /// The first column of this name.
  std::optional<std::size_t> exact(const std::string& text) const;

  /// The columns that `text` may mean: by their whole names, else without their units, else by the last parts of
  /// their paths.
  std::vector<std::size_t> called(const std::string& text, bool angle) const;

  /// The column of times in s: time_s, time, or "time (s)", in any case.
  std::optional<std::size_t> time() const;

  /// `; did you mean "knee_flex_r"?`, or empty.
  std::string near(const std::string& text) const;

 private:
  std::vector<std::string> names_;
  std::vector<ColumnLabel> angles_, lengths_;
};

}  // namespace genu
