// Reads the tables [vary] and [correlation] of a study.
#pragma once

#include "genu/scene/section.h"
#include "genu/sweep/sweep_def.h"

namespace genu {

/// Entries NAME = { normal = 1, sd = 0.1, relative = true }, ...
void read_vary(ReadContext& context, const Item& table, SweepDef& sweep);

/// factors = [...], matrix = [[...], ...]
void read_correlation(ReadContext& context, const Item& table, SweepDef& sweep);

/// An array of texts; one text counts as such an array.
std::vector<std::pair<std::string, SourceLocation>> read_texts(ReadContext& context, const Item& item);

}  // namespace genu
