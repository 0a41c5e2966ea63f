#include "registry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "commands.h"
#include "genu/core/disk_cache.h"

namespace genu::cli {

std::string command_list(const std::vector<Command>& commands) {
  std::size_t width = 0;
  for (const Command& c : commands) width = std::max(width, usage_of(c).size());
  std::string out, group;
  for (const Command& c : commands) {
    if (c.group != group) out += fmt::format("{}{}\n", out.empty() ? "" : "\n", c.group);
    group = c.group;
    out += fmt::format("  {:<{}}  {}\n", usage_of(c), width, c.purpose);
  }
  return out;
}

namespace {

/// Whether a command builds no surfaces, or none that would be kept.
bool builds_nothing(const std::string& command) {
  const std::set<std::string> names = {"import", "compare", "mesh-check", "segment", "completion", "man"};
  return names.contains(command);
}

/// A range lets nan pass, which compares with nothing.
void refuse_nan(CLI::App& command) {
  for (CLI::Option* option : command.get_options())
    if (option->get_type_name().find("FLOAT") != std::string::npos)
      option->check([](const std::string& text) {
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? std::string("nan is no number") : std::string();
      });
}

}  // namespace

void add_commands(CLI::App& app, int& exit_code) {
  using Add = void (*)(CLI::App&, int&);
  constexpr Add kAdd[] = {
#define GENU_COMMAND(name, group, synopsis, purpose) add_##name,
#include "registry.def"
#undef GENU_COMMAND
  };
  const std::vector<Command> commands = registry();
  for (std::size_t i = 0; i < commands.size(); ++i) {
    CLI::App* command = app.add_subcommand(commands[i].name, commands[i].purpose);
    command->group("");  // the list of `genu --help` is command_list()
    kAdd[i](*command, exit_code);
    refuse_nan(*command);
    if (builds_nothing(commands[i].name)) continue;
    command->add_flag_callback(
        "--no-cache", [] { use_user_cache(false); },
        "build all surfaces anew, and keep none for later runs (docs/results.md)");
  }
}

}  // namespace genu::cli
