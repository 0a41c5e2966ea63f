// What genu writes for shells and for man, read by these themselves.
#include <gtest/gtest.h>

#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

bool there_is(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::string output_of(const TemporaryFolder& folder, const std::string& command, int* exit_code = nullptr) {
  const int status = std::system((command + " >" + (folder / "said") + " 2>&1").c_str());
  if (exit_code != nullptr) *exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return read_file(folder / "said");
}

/// What bash offers after the words typed, the last of which may be begun.
std::string offered(const TemporaryFolder& folder, const std::string& words) {
  folder.write("ask.sh",
               "source \"$1\"; shift\ncd \"$1\"; shift\nCOMP_WORDS=(genu \"$@\")\nCOMP_CWORD=$#\n_genu\n"
               "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  return "\n" + output_of(folder, "bash " + (folder / "ask.sh") + " " + (folder / "genu.bash") + " " + (folder / "") +
                                      " " + words);
}

TEST(CliCompletion, BashCompletes) {
  const TemporaryFolder folder;
  folder.write("genu.bash", genu("completion bash").out);
  folder.write("knee one.toml", "");
  const auto offers = [&](const std::string& words, const std::string& word) {
    const std::string said = offered(folder, words);
    return contains(said, "\n" + word + "\n");
  };
  EXPECT_TRUE(offers("ru", "run"));
  EXPECT_FALSE(offers("ru", "mesh"));
  for (const char* command : {"new", "run", "check", "explain", "mesh-check", "hard-cases", "completion", "man"})
    EXPECT_TRUE(offers("''", command)) << command;
  EXPECT_TRUE(offers("run a.toml --er", "--error-bars"));
  EXPECT_FALSE(offers("check --er", "--error-bars"));
  EXPECT_TRUE(offers("run k", "knee one.toml"));
  EXPECT_TRUE(offers("run a.toml --out k", "knee one.toml"));
  EXPECT_TRUE(offers("mesh-check a.stl --units m", "mm"));
  EXPECT_FALSE(offers("mesh-check a.stl --units k", "knee one.toml"));
  EXPECT_TRUE(offers("new knee --kind st", "stl"));
  EXPECT_TRUE(offers("convert out/knee --to o", "opensim"));
  EXPECT_TRUE(offers("explain liga", "ligaments"));
  EXPECT_TRUE(offers("completion z", "zsh"));
}

/// The shells that are there read their scripts without a word of complaint; fish is asked to complete as well.
TEST(CliCompletion, OtherShellsReadTheirs) {
  const TemporaryFolder folder;
  int code = -1;
  folder.write("_genu", genu("completion zsh").out);
  folder.write("genu.fish", genu("completion fish").out);
  bool any = false;
  if (there_is("zsh")) {
    any = true;
    EXPECT_EQ(output_of(folder, "HOME=" + (folder / "") + " zsh -f " + (folder / "_genu"), &code), "");
    EXPECT_EQ(code, 0);
  }
  if (there_is("fish")) {
    any = true;
    const std::string said = output_of(folder, "HOME=" + (folder / "") + " fish -c 'source " + (folder / "genu.fish") +
                                                   "; complete -C \"genu new a --kind st\"; complete -C \"genu ru\"'");
    EXPECT_TRUE(contains(said, "stl")) << said;
    EXPECT_TRUE(contains(said, "run\t")) << said;
  }
  if (!any) GTEST_SKIP() << "neither zsh nor fish is here";
}

TEST(CliManual, NamesEveryCommandAndRoffHasNothingToSay) {
  const TemporaryFolder folder;
  const std::string page = genu("man").out;
  const std::string file = folder.write("genu.1", page);
  for (const char* part : {".TH GENU 1", "genu run", "\\-\\-error\\-bars", "EXIT STATUS", "genu mesh\\-check"})
    EXPECT_TRUE(contains(page, part)) << part;
  if (!there_is("groff")) GTEST_SKIP() << "groff is not here";
  int code = -1;
  const std::string said = output_of(folder, "groff -man -ww -z -Tutf8 " + file, &code);
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said, "");
}

}  // namespace
}  // namespace genu::test
