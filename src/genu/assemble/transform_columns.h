// Which columns of a table are the transform of a joint: 16 numbers row by row of the 4x4 matrix of the child's pose in
// the parent, or 12, without the last row. As the user says: "JOINT=COLUMNS[UNIT]", where COLUMNS are
//   2-17       places of columns, from 1
//   T          the beginning of names: T11 ... T44, T_1_1, T[0,0], T1 ... T16; or T_r11 ... T_r33 with T_tx, T_ty, T_tz
//   (none)     names that begin with the joint or its child; else all columns but the time
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/column_names.h"
#include "genu/core/diagnostics.h"
#include "genu/scene/scene.h"

namespace genu {

struct TransformColumns {
  int joint = 0;
  std::vector<std::size_t> columns;  ///< 12 or 16, row by row
  double unit = 1;                   ///< m per unit of the translation
  std::string unit_name, how;
  bool assumed = false;  ///< the unit: neither the user nor the file says it
};

/// The unit of lengths that do not say their own.
struct OtherUnit {
  const ColumnUnit* unit;
  std::string why;
  bool assumed;
};

/// Reads the option; what is wrong with it is added to `out`, and left out of the result.
std::vector<TransformColumns> match_transforms(const SceneTables& scene, const ColumnNames& names,
                                               const std::string& option, const OtherUnit& length, Diagnostics& out);

}  // namespace genu
