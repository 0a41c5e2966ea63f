#include <cstdio>

#include <fmt/format.h>

#include "commands.h"
#include "genu/core/diagnostics.h"

namespace genu::cli {

void print(const Diagnostics& diagnostics, bool computed) {
  for (const Diagnostic& d : diagnostics.items()) fmt::print(stderr, "{}\n", to_string(d));
  if (const std::size_t errors = diagnostics.count(Diagnostic::Severity::error); errors > 0)
    fmt::print(stderr, "{} error{}; {}\n", errors, errors == 1 ? "" : "s",
               computed ? "the results could not be kept" : "nothing was computed");
}

}  // namespace genu::cli
