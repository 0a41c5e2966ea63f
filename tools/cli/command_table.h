// The commands of the program and their options, as data: the source of completion, manual page and docs/commands.md.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace genu::cli {

struct OptionFacts {
  std::vector<std::string> names;    ///< "--out"; of a positional one its name, "SCENE"
  std::string description, preset;   ///< what it is where it is not given
  std::vector<std::string> choices;  ///< words it must be one of
  bool positional = false, takes_value = false, required = false;
};

struct CommandFacts {
  std::string name, description, footer;
  std::vector<OptionFacts> options;
};

/// Every subcommand, in the order in which they were added.
std::vector<CommandFacts> command_table(const CLI::App& app);

/// A script for "bash", "zsh" or "fish"; empty for any other word. `topics`: words after genu explain.
std::string completion_script(const std::string& shell, const std::vector<CommandFacts>& commands,
                              const std::vector<std::string>& topics);

/// The manual page genu(1) as roff.
std::string manual_page(const std::vector<CommandFacts>& commands, const std::string& version);

/// docs/commands.md: the registry's list, then a section for each command.
std::string commands_page(const std::vector<CommandFacts>& commands);

}  // namespace genu::cli
