// How far a long piece of work has come, on standard error.
#pragma once

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

#include "genu/core/timer.h"
#include "print_error.h"

namespace genu::cli {

/// A line that is rewritten in a terminal, or a new one every few seconds elsewhere; nothing in the first second.
class Progress {
 public:
  void operator()(int done, int asked, const char* what) {
    const double now = timer_.seconds();
    const bool terminal = isatty(STDERR_FILENO) != 0;
    if (now < 1 || now - last_ < (terminal ? 0.1 : 5.0)) return;
    last_ = now;
    print_error("{}{:>6} of {} {}, {:.0f} s{}", terminal ? "\r" : "", done, asked, what, now, terminal ? "" : "\n");
    std::fflush(stderr);
    open_ = terminal;
  }
  void finish() const {
    if (open_) print_error("\n");
  }

 private:
  Timer timer_;
  double last_ = 0;
  bool open_ = false;
};

}  // namespace genu::cli
