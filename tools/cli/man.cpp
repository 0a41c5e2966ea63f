// genu man: the manual page genu(1), from what the program says of itself.
#include <memory>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "command_table.h"
#include "commands.h"

namespace genu::cli {
namespace {

/// Text escaped for roff.
std::string roff(const std::string& text) {
  std::string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    begins = c == '\n';
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

/// Lines that keep their places.
std::string example(const std::string& text) { return ".PP\n.nf\n" + roff(text) + "\n.fi\n"; }

std::string option_text(const OptionFacts& o) {
  std::string head;
  for (const std::string& name : o.names) head += (head.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
  std::string words;
  for (const std::string& word : o.choices) words += (words.empty() ? "" : "|") + word;
  if (!o.positional && o.takes_value) head += words.empty() ? " \\fIVALUE\\fR" : " " + roff(words);
  std::string said = o.description;
  if (o.positional && !words.empty()) said += ": " + words;
  if (o.required) said += " (needed)";
  if (!o.preset.empty()) said += " (" + o.preset + " where it is not given)";
  return ".TP\n" + head + "\n" + roff(said) + "\n";
}

std::string command_text(const CommandFacts& c) {
  std::string usage = "\\fBgenu " + roff(c.name) + "\\fR";
  for (const OptionFacts& o : c.options)
    if (o.positional) usage += " \\fI" + roff(o.names.front()) + "\\fR";
  std::string out = ".SS " + usage + " [options]\n" + roff(c.description) + "\n";
  for (const OptionFacts& o : c.options)
    if (o.names.front() != "-h") out += option_text(o);
  if (!c.footer.empty()) out += example(c.footer);
  return out;
}

}  // namespace

std::string manual_page(const std::vector<CommandFacts>& commands, const std::string& version) {
  std::string out = fmt::format(
      ".TH GENU 1 \"\" \"{}\" \"User commands\"\n.SH NAME\ngenu \\- equilibrium and motion of articular joints\n"
      ".SH SYNOPSIS\n.B genu\n.I COMMAND\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n",
      roff(version.substr(0, version.find('\n'))));
  out += roff(
      "genu finds the poses in which surfaces, ligaments and loads of a joint balance, and says of each whether it is "
      "stable and what it was checked against. A scene is one TOML file beside its meshes.\n");
  out += example(
      "genu new knee                        a commented scene to start from\n"
      "genu run knee/knee.toml --out out    solve it\n"
      "genu explain                         what each key, column and status means");
  out += ".SH COMMANDS\n";
  for (const CommandFacts& c : commands) out += command_text(c);
  out += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] :
       {std::pair("0", "all is well"), std::pair("1", "anything else, such as a full disk"),
        std::pair("2", "the input is refused; nothing is computed"),
        std::pair("3", "computed, but not everything is ok")})
    out += fmt::format(".TP\n.B {}\n{}\n", code, roff(meaning));
  return out + "Every other exit code than 0 ends with a hint on standard error.\n";
}

void add_man(CLI::App& command, int& exit_code) {
  auto markdown = std::make_shared<bool>(false);
  command.add_flag("--markdown", *markdown, "write docs/commands.md instead");
  command.footer("Example: genu man > ~/.local/share/man/man1/genu.1");
  command.callback([&command, markdown, &exit_code] {
    const std::vector<CommandFacts> commands = command_table(*command.get_parent());
    fmt::print("{}", *markdown ? commands_page(commands) : manual_page(commands, version_text()));
    exit_code = kOk;
  });
}

}  // namespace genu::cli
