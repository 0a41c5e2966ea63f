// Reads a model file of OpenSim 4 (.osim), or says what is wrong with it.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/osim/model.h"

namespace genu::osim {

/// Returns nothing where the file cannot be read, is no model of OpenSim 4, or has values that are no numbers where
/// numbers belong; then `out` has every error with line and column. Elements that genu does not know are kept as items.
[[nodiscard]] std::optional<Model> read_model(const std::string& path, Diagnostics& out);

/// The same from a text; `path` names it in messages.
[[nodiscard]] std::optional<Model> parse_model(const std::string& text, const std::string& path, Diagnostics& out);

}  // namespace genu::osim
