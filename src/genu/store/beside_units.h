// Units of measured values beside those of results.csv.
#pragma once

#include <optional>
#include <string>

#include "genu/assemble/pose_header.h"

namespace genu {

/// What values in `unit` are multiplied by to be in the unit at the end of `column`, a column of results.csv; nothing
/// where the two have not the same dimension or `unit` is none. Of lengths, angles, times, forces, moments, pressures,
/// areas and energies; a column without a unit takes 1 and %.
std::optional<double> unit_factor(const std::string& column, const std::string& unit);

/// The units that unit_factor() takes for a column: "N, kN".
std::string units_of(const std::string& column);

/// The unit that a file's own column name says, in brackets or after its last underscore: "kN" of "pull [kN]" and
/// "pull_kN". Empty where it says none that `column` may have.
std::string unit_in_name(const std::string& name, const std::string& column);

/// The unit of values that nobody gives one, as genu evaluate has it: of angles what the header says, else rad; of
/// lengths m; of other quantities that of `column`.
std::string unit_unsaid(const std::string& column, const AngleUnit& angles);

}  // namespace genu
