// The commands of `genu` as data (registry.def): what main.cpp adds to the program and prints in `genu --help`.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace genu::cli {

/// A command. Its options are with add_NAME(), in a file of its own.
struct Command {
  std::string name;      ///< "mesh-check"
  std::string group;     ///< the heading in `genu --help`
  std::string synopsis;  ///< what follows the name: "SCENE --out DIR"
  std::string purpose;   ///< one line, without a full stop
};

/// The registry, in the order of `genu --help`: group by group.
inline std::vector<Command> registry() {
  std::vector<Command> commands = {
#define GENU_COMMAND(name, group, synopsis, purpose) {#name, group, synopsis, purpose},
#include "registry.def"
#undef GENU_COMMAND
  };
  for (Command& command : commands)
    for (char& c : command.name)
      if (c == '_') c = '-';
  return commands;
}

/// "run SCENE --out DIR"
inline std::string usage_of(const Command& command) {
  return command.synopsis.empty() ? command.name : command.name + " " + command.synopsis;
}

/// The commands of the registry as `genu --help` lists them, under their groups.
std::string command_list(const std::vector<Command>& commands);

/// Adds every command of the registry to the program, with its options. Each sets `exit_code` when it has run.
void add_commands(CLI::App& app, int& exit_code);

}  // namespace genu::cli
