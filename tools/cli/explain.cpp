// genu explain knee.toml: the system a scene asks for, before anything is solved.
// genu explain ligaments: what the pages in docs/ say of a word: a section, a key, a column, a status.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "changes.h"
#include "command_table.h"
#include "commands.h"
#include "genu/appraise/explain.h"
#include "genu/assemble/changed_scene.h"
#include "genu/scene/words.h"
#include "genu/study/run_scene.h"
#include "topics.h"

namespace genu::cli {
namespace {

bool means_a_file(const std::string& word) {
  std::error_code ignored;
  return word.ends_with(".toml") || word.find('/') != std::string::npos ||
         std::filesystem::is_regular_file(word, ignored);
}

int explain_scene(const SceneSource& source) {
  Diagnostics diagnostics;
  const auto scene = read_changed_scene(source, diagnostics);
  print(diagnostics);
  if (scene) fmt::print("{}", explain(*scene));
  return scene ? kExitOk : kExitRefused;
}

/// What a command does, and the page of its name where there is one.
void explain_command(const CommandFacts& command, const Topics& topics) {
  fmt::print("{} is a command: {}\n\n`genu {} --help` says what it takes.\n", command.name, command.description,
             command.name);
  const bool page = std::any_of(topics.sections.begin(), topics.sections.end(),
                                [&](const Topic& t) { return t.level == 1 && t.name == command.name; });
  if (page) fmt::print("\n{}", explain_topic(topics, command.name));
}

int explain_word(const CLI::App& app, const std::string& word) {
  const Topics topics = topics_of(help_pages());
  for (const CommandFacts& c : command_table(app))
    if (c.name == word) {
      explain_command(c, topics);
      return kOk;
    }
  if (word.empty()) {
    fmt::print("{}", topic_list(topics));
    return kOk;
  }
  std::string text = explain_topic(topics, word);
  if (text.empty()) {  // a heading that is a file's name
    std::string dashed = word;
    std::replace(dashed.begin(), dashed.end(), '.', '-');
    text = explain_topic(topics, dashed);
  }
  const std::string others = sections_with(topics, word);
  if (text.empty() && !others.empty()) {
    fmt::print("No topic is called {}. The pages in docs/ that speak of it:\n\n{}", with_quotes(printable(word)),
               others);
    return kOk;
  }
  if (text.empty())
    return refuse(Code::unknown_name, fmt::format("{} is no topic and no scene file{}", with_quotes(word),
                                                  did_you_mean(word, known_topics(topics))));
  fmt::print("{}", text);
  if (!others.empty()) fmt::print("\nMore about {}:\n{}", printable(word), others);
  return kOk;
}

}  // namespace

void add_explain(CLI::App& command, int& exit_code) {
  auto word = std::make_shared<std::string>();
  auto changes = std::make_shared<SceneChanges>();
  command.add_option(
      "SCENE_OR_TOPIC", *word,
      "scene file (TOML), or a section, key, column, status, event or term; the list where it is left out");
  add_changes(command, *changes);
  command.footer(
      "Examples: genu explain knee.toml\n          genu explain ligaments\n          genu explain over_edge");
  command.callback([&command, word, changes, &exit_code] {
    if (means_a_file(*word))
      exit_code = explain_scene({*word, *changes});
    else if (!changes->without.empty() || !changes->set.empty())
      exit_code = refuse(Code::usage, fmt::format("--without and --set change a scene, and {} is no scene file",
                                                  word->empty() ? "nothing" : with_quotes(printable(*word))));
    else
      exit_code = explain_word(*command.get_parent(), *word);
  });
}

}  // namespace genu::cli
