// genu --version: which build this is, what it was made of, and under which licences.
#include <string>

#include <fmt/format.h>

#include "commands.h"
#include "genu_commit.h"

namespace genu::cli {

std::string version_text() {
  const std::string commit = GENU_COMMIT;
  std::string libraries = "  ";
  for (const char c : std::string(GENU_LIBRARIES)) libraries += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return fmt::format(
      "genu {}, {}\nbuild: {}, {}{}\ngenu's own sources are Apache-2.0; report.html holds three.js (MIT)\n"
      "libraries:\n{}",
      GENU_VERSION, GENU_LICENCE, GENU_BUILD_TYPE, GENU_COMPILER, commit.empty() ? "" : ", commit " + commit,
      libraries);
}

}  // namespace genu::cli
