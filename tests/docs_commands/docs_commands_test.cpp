// Every command in the fenced blocks of README.md and docs/ is run as it stands there, in order, in a copy of the tree;
// where its output is shown, it prints that. What is not run says why (doc_blocks.h), and is listed here.
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>

#include <gtest/gtest.h>

#include "cli/registry.h"
#include "doc_blocks.h"
#include "support/data.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu::test {
namespace {

namespace fs = std::filesystem;

const std::string kSource = genu::test::source_folder();

/// A tree in which the paths of the pages lead where they do for a reader: what may be written to is a copy.
class Tree {
 public:
  Tree() {
    fs::create_directories(root() + "/build/bin");
    for (const char* copied : {"meshes", "docs", "README.md"})
      fs::copy(kSource + "/" + copied, root() + "/" + copied, fs::copy_options::recursive);
    for (const char* linked : {"tests", "tools"}) fs::create_symlink(kSource + "/" + linked, root() + "/" + linked);
    fs::create_symlink(genu::test::program(), root() + "/build/bin/genu");
    fs::create_directory(folder_ / "shared");
    if (fs::exists(data_path("."))) fs::create_symlink(fs::canonical(data_path(".")), folder_ / "shared/data");
  }
  std::string root() const { return folder_ / "genu"; }

  struct Outcome {
    int exit_code;
    std::string said;
  };
  Outcome run(const std::string& command) const {
    folder_.write("command", command);
    const std::string shell = "cd " + root() + " && PATH=" + root() + "/build/bin:$PATH timeout 300 bash " +
                              (folder_ / "command") + " >" + (folder_ / "said") + " 2>&1 </dev/null";
    const int status = std::system(shell.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_ / "said")};
  }

 private:
  TemporaryFolder folder_;
};

/// Words that are the same, or numbers that are nearly; times and sizes of memory may be anything, and so may what
/// "..." stands for.
bool same_line(const std::string& shown, const std::string& printed) {
  std::istringstream a(shown), b(printed);
  std::string x, y, next;
  for (; a >> x;) {
    if (x == "...") return true;
    if (!(b >> y)) return false;
    if (x == y) continue;
    char *end_x = nullptr, *end_y = nullptr;
    const double u = std::strtod(x.c_str(), &end_x), v = std::strtod(y.c_str(), &end_y);
    if (end_x == x.c_str() || end_y == y.c_str()) return false;
    std::string rest = end_x;
    if (rest.empty() && a.peek() != EOF) {
      const auto here = a.tellg();
      if (a >> next) rest = next;
      a.clear();
      a.seekg(here);
    }
    const bool time = rest.rfind("s", 0) == 0 || rest.rfind("ms", 0) == 0 || rest.rfind("MB", 0) == 0;
    if (time || std::string(end_x) != end_y) {
      if (!time) return false;
      continue;
    }
    const double scale = std::max(std::abs(u), std::abs(v));
    if (std::abs(u - v) > 2e-3 * scale && scale > 1e-8) return false;  // smaller ones are rounding
  }
  return !(b >> y);
}

/// The first shown line that was not printed, after those before it; empty where all were.
std::string missing_line(const std::vector<std::string>& shown, const std::string& printed) {
  std::istringstream lines(printed);
  std::string line;
  for (const std::string& wanted : shown) {
    if (wanted.find_first_not_of(" .") == std::string::npos) continue;
    bool found = false;
    while (!found && std::getline(lines, line)) found = same_line(wanted, line);
    if (!found) return wanted;
  }
  return {};
}

std::regex line_with_a_command() {
  std::string names;
  for (const cli::Command& c : cli::registry()) names += (names.empty() ? "" : "|") + c.name;
  return std::regex("^(\\$ )?(build/bin/)?genu (" + names + ") .*");
}

/// A command of genu in a place where no test runs it.
bool looks_like_a_command(const std::string& line) {
  static const std::regex genu = line_with_a_command();
  return std::regex_match(line, genu);
}

bool long_tests() {
#ifdef GENU_LONG_DOCS
  return true;
#else
  return std::getenv("GENU_LONG") != nullptr;
#endif
}

class DocsCommands : public testing::TestWithParam<std::string> {};

TEST_P(DocsCommands, RunAsTheyStand) {
  const Tree tree;
  std::string lacking;
  for (const DocBlock& block : blocks_of(read_file(kSource + "/" + GetParam()))) {
    const auto note = [&](const std::string& key) {
      const auto found = block.said.find(key);
      return found == block.said.end() ? std::string() : found->second;
    };
    const std::string at = GetParam() + ":" + std::to_string(block.line);
    const bool needs = !note("needs").empty() && !fs::exists(data_path(note("needs")));
    const bool waits = !note("long").empty() && !long_tests();
    if (!note("not run").empty() || waits || needs) {
      const std::string why = needs ? "no " + data_path(note("needs")) : waits ? note("long") : note("not run");
      std::printf("not run: %s: %s\n", at.c_str(), why.c_str());
      for (const DocCommand& c : block.commands) std::printf("           %s\n", c.text.c_str());
      if (needs) lacking += "\n" + at + ": " + why;
      continue;
    }
    for (const std::string& line : block.lines) {
      const bool unseen = block.commands.empty() && looks_like_a_command(line);
      EXPECT_FALSE(unseen) << at << ": is run by no test: " << line;
    }
    for (const DocCommand& command : block.commands) {
      const std::string place = GetParam() + ":" + std::to_string(command.line) + ": " + command.text;
      const Tree::Outcome o = tree.run(command.text);
      EXPECT_EQ(o.exit_code, note("exit").empty() ? 0 : std::stoi(note("exit"))) << place << "\n" << o.said;
      EXPECT_EQ(missing_line(command.output, o.said), "") << place << " has printed\n" << o.said;
    }
  }
  if (!lacking.empty()) GTEST_SKIP() << "set GENU_DATA; all but these was run:" << lacking;
}

std::string page_name(const testing::TestParamInfo<std::string>& page) {
  std::string name;
  for (const char c : page.param) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Pages, DocsCommands, testing::ValuesIn(doc_pages(kSource)), page_name);

TEST(DocBlocks, ComparesWhatIsShownWithWhatIsPrinted) {
  EXPECT_TRUE(same_line("force 12.001 N", "force  12.002 N"));
  EXPECT_FALSE(same_line("force 12.0 N", "force 12.2 N"));
  EXPECT_FALSE(same_line("force 12.0 N", "force 12.0 N more"));
  EXPECT_FALSE(same_line("force 12.0 N more", "force 12.0 N"));
  EXPECT_TRUE(same_line("solved in 0.5 s", "solved in 0.9 s"));
  EXPECT_TRUE(same_line("read in 0.51 s; units mm", "read in 0.02 s; units mm"));
  EXPECT_TRUE(same_line("overlap 1e-14 mm", "overlap 3e-15 mm"));
  EXPECT_TRUE(same_line("a b ...", "a b c d"));
  EXPECT_FALSE(same_line("3 of 4", "4 of 4"));
  EXPECT_EQ(missing_line({"b", "a"}, "a\nb\n"), "a");
  EXPECT_EQ(missing_line({"a", "...", "c"}, "a\nb\nc\n"), "");
}

TEST(DocBlocks, ReadsCommandsAndMarks) {
  const auto blocks =
      blocks_of("<!-- exit: 3 -->\n```console\n$ genu a \\\n  b\nsaid\n$ c\n```\n```sh\n# no\nd\n```\n");
  ASSERT_EQ(blocks.size(), 2u);
  ASSERT_EQ(blocks[0].commands.size(), 2u);
  EXPECT_EQ(blocks[0].commands[0].text, "genu a   b");
  EXPECT_EQ(blocks[0].commands[0].output, std::vector<std::string>{"said"});
  EXPECT_EQ(blocks[0].said.at("exit"), "3");
  ASSERT_EQ(blocks[1].commands.size(), 1u);
  EXPECT_EQ(blocks[1].commands[0].text, "d");
  EXPECT_TRUE(blocks[1].said.empty());
  EXPECT_TRUE(looks_like_a_command("build/bin/genu run a.toml --out b"));
  EXPECT_FALSE(looks_like_a_command("genu     rigid, closed form"));
}

}  // namespace
}  // namespace genu::test
