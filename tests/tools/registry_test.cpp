// The registry of commands (tools/cli/registry.def) and all that reads it: help, completion, manual page,
// documentation.
#include "cli/registry.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

std::size_t count_of(const std::string& text, const std::string& piece) {
  std::size_t count = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++count;
  return count;
}

TEST(CliRegistry, HasEachNameOnceAndGroupsTogether) {
  std::set<std::string> names, groups;
  std::string group;
  for (const cli::Command& c : cli::registry()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    if (c.group != group) {
      EXPECT_TRUE(groups.insert(c.group).second) << c.group << " comes twice";
    }
    group = c.group;
    EXPECT_FALSE(c.purpose.empty() || c.purpose.ends_with(".")) << c.name;
    EXPECT_LE(c.purpose.size(), 60u) << c.name;
  }
}

TEST(CliRegistry, HelpListsEveryCommandOnce) {
  const std::string help = genu("--help").out;
  for (const cli::Command& c : cli::registry()) {
    EXPECT_EQ(count_of(help, "\n  " + cli::usage_of(c) + "  "), 1u) << c.name << "\n" << help;
    EXPECT_EQ(count_of(help, c.purpose), 1u) << c.name << "\n" << help;
  }
}

TEST(CliRegistry, EveryCommandHasHelpCompletionManualAndTopic) {
  const std::string bash = genu("completion bash").out, fish = genu("completion fish").out, page = genu("man").out;
  for (const cli::Command& c : cli::registry()) {
    const Outcome help = genu(c.name + " --help");
    EXPECT_EQ(help.exit_code, 0) << c.name << help.err;
    EXPECT_TRUE(contains(help.out, c.purpose)) << help.out;
    EXPECT_TRUE(contains(bash, "    " + c.name + ":*)")) << c.name;
    EXPECT_TRUE(contains(fish, " -a " + c.name + " -d ")) << c.name;
    std::string name = c.name;
    if (const std::size_t dash = name.find('-'); dash != std::string::npos) name.insert(dash, "\\");
    EXPECT_TRUE(contains(page, "genu " + name + "\\fR")) << c.name;
    EXPECT_TRUE(contains(genu("explain " + c.name).out, c.purpose)) << c.name;
  }
}

/// To write it again: build/bin/genu man --markdown > docs/commands.md
TEST(CliRegistry, TheDocumentationIsUpToDate) {
  EXPECT_EQ(read_file(source_folder() + "/docs/commands.md"), genu("man --markdown").out);
}

}  // namespace
}  // namespace genu::test
