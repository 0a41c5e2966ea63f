// How far a long piece of work has come, on standard error.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "genu/core/timer.h"
#include "print_error.h"

namespace genu::cli {

/// ", 25 %, 3 s, about 9 s left": the time left is that of what is done, once there is some.
inline std::string progress_text(int done, int asked, double seconds) {
  std::string text;
  if (asked > 0) text += fmt::format(", {} %", std::min(100, static_cast<int>(100.0 * done / asked)));
  text += fmt::format(", {:.0f} s", seconds);
  if (done <= 0 || done >= asked) return text;
  const double left = seconds * (asked - done) / done;
  constexpr double kMinute = 60, kHour = 3600;
  if (left < 2 * kMinute) return text + fmt::format(", about {:.0f} s left", left);
  if (left < 2 * kHour) return text + fmt::format(", about {:.0f} min left", left / kMinute);
  return text + fmt::format(", about {:.0f} h left", left / kHour);
}

/// A line that is rewritten in a terminal, or a new one every few seconds elsewhere; nothing in the first second.
class Progress {
 public:
  void operator()(int done, int asked, const char* what) {
    const double now = timer_.seconds();
    const bool terminal = isatty(STDERR_FILENO) != 0;
    if (now < 1 || now - last_ < (terminal ? 0.1 : 5.0)) return;
    last_ = now;
    const std::string line = fmt::format("{:>6} of {} {}{}", done, asked, what, progress_text(done, asked, now));
    print_error("{}{}{}", terminal ? "\r" : "", line, terminal ? "\x1b[K" : "\n");
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
