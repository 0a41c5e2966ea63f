// What holds for whatever bytes a reader is given. A broken promise ends the program, which libFuzzer takes for a
// finding and keeps the input of.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include <tbb/global_control.h>

#include "genu/core/diagnostics.h"

namespace genu::fuzz {

/// Inputs are small: a loop would wait longer for another thread than it takes.
inline const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);

inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", what.c_str());
  std::abort();
}

/// Every message says something, on one line that cannot drive a terminal, and has a place that exists.
inline void require_clear(const Diagnostics& out) {
  for (const Diagnostic& d : out.items()) {
    const std::string text = to_string(d);
    require(!d.rule.empty(), "a message says what is wrong: " + text);
    require(d.line >= 0 && d.column >= 0, "lines and columns count from 1: " + text);
    for (const char c : text)
      require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "a message has no control characters: " + text);
  }
}

/// A reader gives a result, or says why not; never both, never neither.
inline void require_result_or_reason(bool result, const Diagnostics& out) {
  require_clear(out);
  require(result != out.has_errors(), result ? "a result comes without errors" : "no result comes with a reason");
}

}  // namespace genu::fuzz
