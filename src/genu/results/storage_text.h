// OpenSim's storage (.sto, .mot) as text: a header, names, and a row of numbers for each time.
#pragma once

#include <string>

#include "genu/results/result_table.h"

namespace genu {

/// A line of the header: which files are genu's to replace.
inline constexpr const char* kStorageMark = "Written by genu convert.";

/// `table`: column `time` first, all others numbers. `title` is the first line. A cell without a number is
/// "nan". `rotations`: the table has angles, and they are in degrees; the header says so.
std::string storage_text(const ResultTable& table, const std::string& title, bool rotations);

}  // namespace genu
