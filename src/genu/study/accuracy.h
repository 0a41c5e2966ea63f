// What accuracy costs in time: a scene solved under many settings (accuracy_settings.h), each with its error and its
// time.
//
// Errors are the largest differences over all rows from the same path in closed form, where meshes are cut from closed
// forms; otherwise from the finest solution, together with what that is itself off by, which Richardson's
// extrapolation estimates from how the differences of coarser meshes grow with their edges (L. F. Richardson 1911).
// Times are medians over rounds in which every setting is solved once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/study/accuracy_report.h"
#include "genu/study/run_scene.h"

namespace genu {

/// The largest difference of any column over the rows that both tables have solved; `stretch` rows of `other` for one
/// of `reference`. NaN without such a row.
double largest_difference(const ResultTable& reference, const ResultTable& other,
                          const std::vector<std::string>& columns, double stretch);

/// Error of the finest of four meshes whose edges are as 1 : f2 : f3 : f4, from the differences of the others from it;
/// sets error, its uncertainty and the order.
void extrapolate(const std::vector<double>& factors, const std::vector<double>& differences, AccuracyGroup& out);

/// Reads, solves under every setting, writes the scene's own results with accuracy.csv, accuracy.svg and, with targets,
/// chosen/scene.toml with the meshes it needs into `folder` (where one is given). Returns the exit code.
[[nodiscard]] int run_accuracy(const std::string& path, const std::optional<std::string>& folder,
                               const AccuracyChoice& choice, const RunOptions& options, Diagnostics& out,
                               AccuracyReport& report, Solution& own);

}  // namespace genu
