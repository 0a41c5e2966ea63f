// A program started, waited for, and stopped when it takes too long.
#pragma once

#include <string>
#include <vector>

namespace genu::population {

struct ProcessEnd {
  int exit_code = -1;
  int signal = 0;  ///< it died of
  bool too_long = false;
};

/// What it prints goes into the file `output`.
ProcessEnd run_process(const std::vector<std::string>& words, const std::string& output, double seconds);

}  // namespace genu::population
