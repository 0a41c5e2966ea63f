// The lines above the column names of OpenSim's storage files and SIMM's motions.
//   inDegrees=yes           or a sentence: "Angles are in degrees."
//   nRows=4, nColumns=3     SIMM: datarows 4, datacolumns 3
// A SIMM header (datacolumns, datarows, otherdata, range) without a word about angles means degrees.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/column_units.h"
#include "genu/assemble/long_errors.h"
#include "genu/assemble/table_text.h"

namespace genu {

/// What a file says about the unit of its angles.
struct AngleUnit {
  std::optional<bool> degrees;
  std::string why;                     ///< in words: "inDegrees=yes"
  bool assumed = false;                ///< from the kind of file alone
  std::optional<std::string> against;  ///< words in the same file that say the opposite
  int line = 0;
};

/// The unit of angles or of lengths that nobody gives one: as the header says, else rad; m.
const ColumnUnit& unsaid_unit(const AngleUnit& angles, bool angle);

struct PoseHeader {
  /// A number of rows or columns that the header gives.
  struct Promise {
    std::string key;
    std::size_t count = 0;
    SourceLocation where;
  };
  AngleUnit angles;
  std::optional<Promise> rows, columns;
};

PoseHeader read_pose_header(const std::vector<TextLine>& lines, LongErrors& errors);

}  // namespace genu
