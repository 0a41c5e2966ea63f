#include "genu/sweep/kept_tables.h"

#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

TEST(KeptTables, AreThereAfterAnyEnd) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "t.part";
  const std::string large = "a,b\n" + std::string(100000, 'x') + "\n";
  {
    KeptTables tables(path, "study");
    EXPECT_TRUE(tables.add(7, "a,b\n1,2\n"));
    EXPECT_TRUE(tables.add(3, large));
    EXPECT_EQ(tables.read(7).value_or(""), "a,b\n1,2\n");
    EXPECT_FALSE(tables.has(4));
    EXPECT_FALSE(tables.read(4));
  }
  const std::string whole = test::read_file(path);
  {
    KeptTables again(path, "study");
    EXPECT_EQ(again.read(3).value_or(""), large);
    EXPECT_TRUE(again.add(5, "c\n"));
    EXPECT_EQ(again.read(7).value_or(""), "a,b\n1,2\n");
  }
  EXPECT_EQ(KeptTables(path, "study").read(5).value_or(""), "c\n");
  // Cut off in the second table: the first is there, and what is added behind the rest is too.
  folder.write("t.part", whole.substr(0, whole.size() - 50));
  {
    KeptTables cut(path, "study");
    EXPECT_TRUE(cut.has(7));
    EXPECT_FALSE(cut.has(3));
    EXPECT_TRUE(cut.add(3, large));
  }
  KeptTables last(path, "study");
  EXPECT_EQ(last.read(3).value_or(""), large);
  EXPECT_EQ(last.read(7).value_or(""), "a,b\n1,2\n");
  last.remove();
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(KeptTables, AreThoseOfTheirOwnWorkAlone) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(KeptTables(folder / "t", "study").add(1, "a\n"));
  EXPECT_FALSE(KeptTables(folder / "t", "another study").has(1));
  EXPECT_FALSE(KeptTables(folder / "none/t", "study").problem().empty());
}

TEST(KeptTables, SayThatTheDiskIsFull) {
  const test::TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 100;  // no file may be longer
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  {
    KeptTables tables(folder / "t", "study");
    EXPECT_TRUE(tables.add(1, "a\n"));
    EXPECT_FALSE(tables.add(2, std::string(1000, 'a')));
    EXPECT_TRUE(test::contains(tables.problem(), "cannot be written"));
    EXPECT_FALSE(tables.has(2));
    EXPECT_EQ(tables.read(1).value_or(""), "a\n");
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(KeptTables(folder / "t", "study").read(1).value_or(""), "a\n");
}

}  // namespace
}  // namespace genu
