#include "genu/core/file_text.h"

#include <sys/stat.h>

#include <cstdio>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(FileText, ReadsWhatAFileHoldsAndNothingWithoutEnd) {
  const test::TemporaryFolder folder;
  Diagnostics none;
  EXPECT_EQ(text_of_file(folder.write("a", std::string("x\0y", 3)), none), std::string("x\0y", 3));
  EXPECT_TRUE(none.items().empty());
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& [path, code] :
       {std::pair(folder / "none", Code::no_such_file), std::pair(folder / ".", Code::is_folder),
        std::pair(folder / "pipe", Code::cannot_read), std::pair(std::string("/dev/zero"), Code::cannot_read)}) {
    Diagnostics out;
    EXPECT_FALSE(text_of_file(path, out)) << path;
    ASSERT_EQ(out.items().size(), 1U) << path;
    EXPECT_EQ(out.items()[0].code, code) << to_string(out.items()[0]);
    EXPECT_EQ(out.items()[0].file, path);
  }
}

std::string echoed_by_a_shell(const std::string& word) {
  std::string out;
  FILE* shell = ::popen(("printf %s " + shell_word(word)).c_str(), "r");
  for (int c = 0; shell != nullptr && (c = std::fgetc(shell)) != EOF;) out += static_cast<char>(c);
  if (shell != nullptr) ::pclose(shell);
  return out;
}

TEST(ShellWord, AShellReadsTheSameWord) {
  EXPECT_EQ(shell_word("out/knee.toml"), "out/knee.toml");
  EXPECT_EQ(shell_word("-x"), "./-x");  // else it would be an option
  for (const char* word : {"my knee", "it's", "a#b", "$HOME", "*", "", "a;b", "tab\there", "\"q\"", "#x", "~", "a\nb"})
    EXPECT_EQ(echoed_by_a_shell(word), word);
}

TEST(CsvWord, IsQuotedWhereItHasToBe) {
  EXPECT_EQ(csv_word("plain word"), "plain word");
  EXPECT_EQ(csv_word("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_word("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csv_word("two\nlines"), "\"two\nlines\"");
}

}  // namespace
}  // namespace genu
