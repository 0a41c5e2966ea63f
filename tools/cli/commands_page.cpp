// docs/commands.md: every command with its options, from the same table as completion and the manual page.
#include <string>

#include <fmt/format.h>

#include "command_table.h"
#include "registry.h"

namespace genu::cli {
namespace {

/// Markdown takes * and < as they are in `code` alone.
std::string escaped(const std::string& text) {
  std::string out;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (!code && (c == '*' || c == '<' || c == '|' || c == '_')) out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::string option_line(const OptionFacts& o) {
  std::string head = joined(o.names, ", ");
  if (!o.positional && o.takes_value) head += o.choices.empty() ? " VALUE" : " " + joined(o.choices, "|");
  std::string text = escaped(o.description);
  if (o.positional && !o.choices.empty()) text += ": " + joined(o.choices, ", ");
  if (o.required) text += " (required)";
  if (!o.preset.empty()) text += fmt::format(" (default {})", o.preset);
  return fmt::format("- `{}`: {}\n", head, text);
}

std::string command_section(const CommandFacts& c, const Command& entry) {
  std::string out = fmt::format("\n## {}\n\n`genu {}`: {}.\n\n", c.name, usage_of(entry), escaped(entry.purpose));
  for (const OptionFacts& o : c.options)
    if (o.names.front() != "-h") out += option_line(o);
  if (!c.footer.empty()) out += "\n```text\n" + c.footer + "\n```\n";
  return out;
}

}  // namespace

std::string commands_page(const std::vector<CommandFacts>& commands) {
  const std::vector<Command> entries = registry();
  std::string out =
      "# Commands\n\nAfter this page you know every command of genu and its options. `genu man --markdown` writes the "
      "page;\na test compares the two.\n\n```text\n" +
      command_list(entries) + "```\n";
  for (std::size_t i = 0; i < commands.size(); ++i) out += command_section(commands[i], entries.at(i));
  return out;
}

}  // namespace genu::cli
