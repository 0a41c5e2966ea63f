// A measured laxity table as the target of a calibration: a CSV file with columns flexion_deg, test, load_N or load_Nm,
// and displacement_mm or displacement_deg, as `genu laxity` writes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/types.h"
#include "genu/study/laxity_loads.h"

namespace genu {

inline constexpr const char* kDisplacementColumns[] = {"displacement_mm", "displacement_deg"};

struct LaxityTarget {
  struct Curve {
    double flexion = 0;  ///< rad
    LaxityTest::Kind kind = LaxityTest::Kind::drawer;
    /// N or N m, each once: outward from 0 in the positive direction, then outward in the negative one. 0 is left out.
    std::vector<double> loads;
  };
  struct Value {
    std::size_t curve = 0;
    double load = 0;         ///< N or N m; 0: the neutral pose
    std::size_t column = 0;  ///< index into `columns`
    double value = 0;        ///< in the column's unit
  };
  std::vector<std::string> columns;  ///< displacement_mm, displacement_deg, or others of results.csv
  std::vector<Curve> curves;         ///< by flexion, then by test
  std::vector<Value> values;         ///< row by row

  /// Adds what is measured at a load; a curve that is new is added too.
  void add(double flexion, LaxityTest::Kind kind, double load, const std::string& column, double value);
  /// Orders curves and loads; call it once, after the last add().
  void arrange();
};

/// Whether the file's first row names the columns of a laxity table.
bool is_laxity_table(const std::string& path);

/// Reads displacements, and the columns of results.csv that match one of `patterns`; with patterns that do not match
/// displacement_mm or displacement_deg no displacements. Errors in `out`, with their places: a row without a known test
/// or load, a cell that is no number, a table of two scenes, columns that are none of `known`.
[[nodiscard]] std::optional<LaxityTarget> read_laxity_target(const std::string& path,
                                                             const std::vector<std::string>& patterns,
                                                             const std::vector<std::string>& known, Diagnostics& out);

}  // namespace genu
