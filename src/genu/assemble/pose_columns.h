// Which column of a table of poses is which coordinate of a scene, and in which unit.
//
// In this order; the first rule that finds a column for a coordinate is taken:
//   1. as the user says: "knee.flexion=knee_flex_r[rad], time=t"
//   2. a column of genu's own results: knee.flexion_deg
//   3. a coordinate's name: knee.flexion, with or without a unit (column_units.h)
//   4. OpenSim's habit: the last part of the path (before /value), JOINT_QUANTITY or JOINT_QUANTITY_SIDE: knee_flex_r
//   is
//      the rotation of joint `knee` (or `knee_r`) whose name begins with "flex", knee_tx_r its translation `x` or `tx`
// The unit is what the user says for the column, else that of the column's name, else that of `units`, else that of the
// file's header, else rad or m.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/pose_file.h"
#include "genu/assemble/transform_columns.h"
#include "genu/scene/scene.h"

namespace genu {

struct PoseColumnOptions {
  std::string columns;  ///< "QUANTITY=COLUMN[UNIT], ..." : a coordinate, or `time`; [UNIT] may be left out
  std::string units;    ///< "deg,mm": of columns that do not say their own; left out: as the file says, else rad and m
  std::string transforms = {};  ///< "JOINT=COLUMNS[UNIT], ...": a matrix for each row (transform_columns.h)
};

struct PoseColumns {
  struct Match {
    CoordinateRef coordinate;
    std::size_t column = 0;
    double unit = 1;  ///< SI per unit of the column
    std::string unit_name;
    std::string how;       ///< in words
    bool assumed = false;  ///< the unit: neither the user nor the file says it
  };
  struct Factor {
    int load = 0;
    std::size_t column = 0;
  };
  std::vector<Match> coordinates;  ///< one for each coordinate that neither a joint nor a transform gives
  std::vector<TransformColumns> transforms;
  std::vector<Factor> factors;  ///< LOAD.factor
  std::optional<std::size_t> time, step, increment, status;
  std::vector<std::size_t> ignored;
  bool own_results() const { return step && increment && status; }  ///< the results of an earlier run
};

/// Empty, with every reason in `out`, where a coordinate has no column or several, or the options are wrong.
[[nodiscard]] std::optional<PoseColumns> match_columns(const SceneTables& scene, const PoseFile& file,
                                                       const PoseColumnOptions& options, Diagnostics& out);

}  // namespace genu
