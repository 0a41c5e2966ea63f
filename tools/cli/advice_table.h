// What to do about each kind of mistake.
#pragma once

#include <string>

#include "genu/core/diagnostic_code.h"

namespace genu::cli {

/// Empty where the advice depends on the place that the error names.
std::string advice_on_code(Code code);

}  // namespace genu::cli
