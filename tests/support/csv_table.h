// A CSV file that genu has written, as a table.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "genu/assemble/pose_file.h"
#include "genu/calibrate/finite_number.h"
#include "genu/results/result_table.h"
#include "support/scenes.h"

namespace genu::test {

/// Cells that are numbers are numbers, empty cells are empty.
inline ResultTable read_table(const std::string& path) {
  Diagnostics out;
  ResultTable table;
  const auto file = read_pose_file(path, out);
  EXPECT_TRUE(file) << messages(out);
  if (!file) return table;
  for (const auto& name : file->names.cells) table.add_column(name.text);
  for (const PoseFile::Row& row : file->rows) {
    table.add_row();
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const std::string& text = row.cells[c].text;
      if (const auto number = finite_number(text))
        table.set(c, *number);
      else if (!text.empty())
        table.set(c, text);
    }
  }
  return table;
}

}  // namespace genu::test
