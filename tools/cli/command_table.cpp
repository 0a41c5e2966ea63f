#include "command_table.h"

#include <sstream>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace genu::cli {
namespace {

/// "TEXT:{mm,m}": the words in braces.
std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> words;
  const std::size_t from = type.find('{'), to = type.find('}');
  if (from == std::string::npos || to == std::string::npos) return words;
  std::istringstream list(type.substr(from + 1, to - from - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  facts.positional = option.get_positional();
  if (facts.positional) {
    facts.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  }
  facts.description = option.get_description();
  facts.preset = option.get_default_str();
  facts.choices = choices_of(option.get_type_name());
  facts.takes_value = option.get_items_expected_max() > 0;
  facts.required = option.get_required();
  return facts;
}

}  // namespace

std::vector<CommandFacts> command_table(const CLI::App& app) {
  std::vector<CommandFacts> table;
  for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandFacts command{c->get_name(), c->get_description(), c->get_footer(), {}};
    for (const CLI::Option* o : c->get_options([](const CLI::Option*) { return true; }))
      command.options.push_back(facts_of(*o));
    table.push_back(std::move(command));
  }
  return table;
}

}  // namespace genu::cli
