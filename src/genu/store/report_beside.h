// Measured or published curves to be drawn beside the computed ones in report.html.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/results/report_run.h"

namespace genu {

/// Reads the columns of a table (CSV, .sto or .mot: assemble/pose_file.h) that a results.csv with the columns `known`
/// has as well: by name, without its unit (knee.adduction), or as `columns` gives it: "knee.flexion_deg=angle[rad],
/// knee.adduction=add". Units are those of beside_units.h. An angle without one is in what the header says, else rad; a
/// length in m, as for genu evaluate, in a CSV with a warning; another quantity in the unit of results.csv. Empty cells
/// and NaN are values that were not measured: how many is a warning. A word that is no number, two columns for one, a
/// name that is none and a file without a column in common are refused in `out`.
[[nodiscard]] std::optional<ReportBeside> read_beside(const std::string& path, const std::string& columns,
                                                      const std::vector<std::string>& known, Diagnostics& out);

}  // namespace genu
