// Reads a study file (TOML), or says everything that is wrong with it at once.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/core/input_files.h"
#include "genu/sweep/sweep_def.h"

namespace genu {

/// The study at `path`. Names of parameters and columns are those of its scenes, and are looked up later
/// (sweep_factors.h, kept_numbers.h).
[[nodiscard]] std::optional<SweepDef> read_sweep(const std::string& path, InputFiles& files, Diagnostics& out);

}  // namespace genu
