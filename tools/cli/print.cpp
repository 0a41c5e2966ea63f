#include <cstdio>

#include <fmt/format.h>

#include "advice.h"
#include "colour.h"
#include "commands.h"
#include "genu/core/diagnostics.h"
#include "print_error.h"

namespace genu::cli {

void print(const Diagnostics& diagnostics, bool computed) {
  for (const Diagnostic& d : diagnostics.items()) {
    const bool error = d.severity == Diagnostic::Severity::error;
    print_error("{}\n", painted(to_string(d), error ? Colour::red : Colour::yellow, STDERR_FILENO));
    if (error) advice().error(d);
  }
  if (const std::size_t errors = diagnostics.count(Diagnostic::Severity::error); errors > 0)
    print_error("{} error{}; {}\n", errors, errors == 1 ? "" : "s",
                computed ? "the results could not be saved" : "nothing was computed");
}

int refuse(const Diagnostics& problems) {
  for (const Diagnostic& d : problems.items()) {
    if (d.severity != Diagnostic::Severity::error) continue;
    print_error("{}\n", painted(to_string(d), Colour::red, STDERR_FILENO));
    advice().error(d);
  }
  return kRefused;
}

int refuse(Code code, const std::string& rule) {
  Diagnostics problems;
  problems.error(code, {}, rule);
  return refuse(problems);
}

void print_advice(int exit_code) {
  if (exit_code == kOk) return;
  for (const std::string& line : advice().lines(exit_code)) print_error("what to do: {}\n", line);
}

}  // namespace genu::cli
