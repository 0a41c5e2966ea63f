// genu completion bash: what a shell needs to complete commands, options, their words, topics and file names.
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include "command_table.h"
#include "commands.h"
#include "topics.h"

namespace genu::cli {
namespace {

std::string joined_words(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

/// In single quotes of a shell.
std::string quoted_for_shell(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The lines of a case statement: COMMAND:OPTION -> its words, COMMAND: -> its options and the words it begins with.
std::string bash_cases(const CommandFacts& c, const std::vector<std::string>& topics) {
  std::string out;
  std::vector<std::string> begin;
  for (const OptionFacts& o : c.options) {
    if (o.positional)
      begin.insert(begin.end(), o.choices.begin(), o.choices.end());
    else
      begin.insert(begin.end(), o.names.begin(), o.names.end());
    for (const std::string& name : o.names)
      if (!o.positional && o.takes_value)
        out +=
            fmt::format("    {}:{}) words={}; value=1 ;;\n", c.name, name, quoted_for_shell(joined_words(o.choices)));
  }
  if (c.name == "explain") begin.insert(begin.end(), topics.begin(), topics.end());
  return out + fmt::format("    {}:*) words={} ;;\n", c.name, quoted_for_shell(joined_words(begin)));
}

std::string bash_script(const std::vector<CommandFacts>& commands, const std::vector<std::string>& topics) {
  std::vector<std::string> names{"--help", "--version"};
  std::string cases;
  for (const CommandFacts& c : commands) {
    names.push_back(c.name);
    cases += bash_cases(c, topics);
  }
  return fmt::format(
      R"(# Completion of genu for bash: source it, or put it into ~/.local/share/bash-completion/completions/genu
_genu() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words= value=
  COMPREPLY=()
  if (( COMP_CWORD == 1 )); then
    COMPREPLY=($(compgen -W {} -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}:$before" in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  # Files where no word from a list is wanted.
  if [[ $word != -* && ( -z $value || -z $words ) ]]; then
    local IFS=$'\n'
    COMPREPLY+=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _genu genu
)",
      quoted_for_shell(joined_words(names)), cases);
}

std::string fish_script(const std::vector<CommandFacts>& commands, const std::vector<std::string>& topics) {
  std::string out =
      "# Completion of genu for fish: put it into ~/.config/fish/completions/genu.fish\n"
      "complete -c genu -n __fish_use_subcommand -f -l help -d 'what genu can do'\n"
      "complete -c genu -n __fish_use_subcommand -f -l version -d 'which build this is'\n";
  for (const CommandFacts& c : commands) {
    out += fmt::format("complete -c genu -n __fish_use_subcommand -f -a {} -d {}\n", c.name,
                       quoted_for_shell(first_line(c.description)));
    const std::string here = fmt::format("complete -c genu -n '__fish_seen_subcommand_from {}'", c.name);
    for (const OptionFacts& o : c.options) {
      const std::string words = quoted_for_shell(joined_words(o.choices));
      if (o.positional && !o.choices.empty()) out += fmt::format("{} -a {}\n", here, words);
      for (const std::string& name : o.names)
        if (name.rfind("--", 0) == 0)
          out += fmt::format("{} -l {}{} -d {}\n", here, name.substr(2),
                             !o.takes_value      ? std::string()
                             : o.choices.empty() ? std::string(" -r")
                                                 : " -x -a " + words,
                             quoted_for_shell(first_line(o.description)));
    }
    if (c.name == "explain") out += fmt::format("{} -a {}\n", here, quoted_for_shell(joined_words(topics)));
  }
  return out;
}

}  // namespace

std::string completion_script(const std::string& shell, const std::vector<CommandFacts>& commands,
                              const std::vector<std::string>& topics) {
  if (shell == "bash") return bash_script(commands, topics);
  if (shell == "zsh")
    return "#compdef genu\n# Completion of genu for zsh: put it into a folder of $fpath as _genu, or source it.\n"
           "autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && bashcompinit\n" +
           bash_script(commands, topics);
  if (shell == "fish") return fish_script(commands, topics);
  return {};
}

void add_completion(CLI::App& command, int& exit_code) {
  auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "which shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command.footer("Example: source <(genu completion bash)");
  command.callback([&command, shell, &exit_code] {
    std::vector<std::string> topics;
    for (const Topic& t : topics_of(help_pages()).sections) topics.push_back(t.name);
    fmt::print("{}", completion_script(*shell, command_table(*command.get_parent()), topics));
    exit_code = kOk;
  });
}

}  // namespace genu::cli
