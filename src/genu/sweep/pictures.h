// Charts of a sweep as SVG.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "genu/sweep/summary_tables.h"

namespace genu {

/// Columns that are kept at three or more values of the main coordinate: they have bands.
std::vector<std::string> columns_with_bands(const SweepTable& sweep);
/// Percentiles 5 to 95, 25 to 75 and 50 over the main coordinate, of every case of a scene.
std::string bands_picture(const SweepTable& sweep, const SweepTables& tables, const std::string& scene,
                          const std::string& column);

/// Kept numbers with a chart of their own: those without bands, and of those with bands the one that spreads most.
std::vector<std::size_t> pictured_numbers(const SweepTable& sweep, const SweepTables& tables);
/// The factors with most influence on a kept number: rank correlations; Sobol indices with Saltelli's scheme; with one
/// factor at a time the number's range.
std::string tornado_picture(const SweepTable& sweep, const SweepTables& tables, std::size_t c, std::size_t kept);

}  // namespace genu
