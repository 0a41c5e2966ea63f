// The commands of `genu`, one file each. Each sets `exit_code` when it has run: 0 all well, 2 the input is refused,
// 3 computed but not everything is ok, 1 anything else.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
}  // namespace CLI
namespace genu {
class Diagnostics;
enum class Code;
}  // namespace genu

namespace genu::cli {

/// What commands exit with. Of a run (assemble/solution.h): kDoubtful is solved, with jumps or doubts.
inline constexpr int kOk = 0, kFailed = 1, kRefused = 2, kNotAllOk = 3, kDoubtful = 4;

// add_NAME() for each command of the registry: options, help text with an example, and the work.
#define GENU_COMMAND(name, group, synopsis, purpose) void add_##name(CLI::App& command, int& exit_code);
#include "registry.def"
#undef GENU_COMMAND

/// What `genu --version` says.
std::string version_text();

/// Every error and warning on standard error, then how many there were; `computed` where that came after the work.
void print(const Diagnostics& diagnostics, bool computed = false);

/// The errors alone on standard error, one or all of them. Always kRefused.
int refuse(const Diagnostics& problems);
int refuse(Code code, const std::string& rule);

/// Last of all, on standard error: what to do next, where a command does not end well.
void print_advice(int exit_code);

/// Refuses what is no number from `low` to `high`; CLI11's own checks let nan pass.
CLI::Validator number_within(double low, double high);

/// Refuses the empty text, which a script may give where it means a name.
CLI::Validator not_empty();

/// From here on Ctrl-C, or being asked to end (SIGTERM), stops the work at the next pose and keeps what was found: says
/// whether it was pressed.
std::function<bool()> stop_on_interrupt();

/// "a.csv, b.csv, ": to be followed by more.
inline std::string listed(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += file + ", ";
  return text;
}

}  // namespace genu::cli
