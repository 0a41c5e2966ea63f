// What to do next, said last by every command that does not end with exit code 0.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"

namespace genu::cli {

/// What a command has met, gathered while it runs.
class Advice {
 public:
  void command(std::string name) { command_ = std::move(name); }
  const std::string& command() const { return command_; }
  void error(const Diagnostic& problem) { errors_.push_back(problem); }
  /// The status of the pose at which results end, as in results.csv.
  void status(std::string name) { status_ = std::move(name); }
  /// What to do after exit code 3 of a command, where nothing more specific is known.
  void hint(const std::string& name, std::string line) { hints_[name] = std::move(line); }
  const std::map<std::string, std::string>& hints() const { return hints_; }
  /// What the command itself knows to be next.
  void next(std::string line) { next_ = std::move(line); }

  /// Lines for the user, one at least: for what was met where it is known, else for the command.
  std::vector<std::string> lines(int exit_code) const;

 private:
  std::string command_, status_, next_;
  std::map<std::string, std::string> hints_;  ///< by command
  std::vector<Diagnostic> errors_;
};

/// The one of this process.
Advice& advice();

/// What to do about one error; `command` is what was asked for.
std::string advice_on(const Diagnostic& problem, const std::string& command);

/// What to do about a pose of this status; empty for `ok` and for words that are no status.
std::string advice_on_status(const std::string& status);

}  // namespace genu::cli
