// The subcommands of `genu`, one file each. Each adds itself to the program and sets `exit_code` when it has run:
// 0 all well, 2 the input is refused, 3 computed but not everything is ok, 1 anything else.
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
}

namespace genu::cli {

/// What commands exit with.
inline constexpr int kOk = 0, kFailed = 1, kRefused = 2, kNotAllOk = 3;

void add_accuracy(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_fit(CLI::App& app, int& exit_code);
void add_judge(CLI::App& app, int& exit_code);
void add_hard_cases(CLI::App& app, int& exit_code);
void add_man(CLI::App& app, int& exit_code);
void add_mesh(CLI::App& app, int& exit_code);
void add_mesh_check(CLI::App& app, int& exit_code);
void add_new(CLI::App& app, int& exit_code);
void add_reproduce(CLI::App& app, int& exit_code);
void add_sensitivity(CLI::App& app, int& exit_code);

/// What `genu --version` says.
std::string version_text();

/// Every error and warning on standard error, then how many there were; `computed` where that came after the work.
void print(const Diagnostics& diagnostics, bool computed = false);

/// The errors alone on standard error, one or all of them. Always kRefused.
int refuse(const Diagnostics& problems);
int refuse(const std::string& rule);

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
