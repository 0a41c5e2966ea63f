#include "genu/core/atomic_output.h"
#include "genu/core/file_list.h"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

const std::string kOld = "{\"genu\": \"old\"}", kNew = "{\"genu\": \"new\"}";

namespace fs = std::filesystem;
using Names = std::set<std::string>;

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Names names_in(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

class AtomicOutput : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "genu-atomic-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    dir_ = fs::canonical(name);
  }
  void TearDown() override { fs::remove_all(dir_); }

  // An earlier result of genu, with a file that the next one will not have.
  fs::path earlier_result() {
    fs::path out = dir_ / "out";
    StagedFolder folder("results");
    EXPECT_EQ(text_of(folder.open(out)), "");
    fs::create_directory(folder.path() / "maps");
    write(folder.path() / "summary.json", kOld);
    write(folder.path() / "maps/only_old.csv", "old");
    EXPECT_EQ(folder.commit(), "");
    return out;
  }

  fs::path dir_;
};

TEST_F(AtomicOutput, ANewFolderAppearsWithCommitAndNotBefore) {
  const fs::path out = dir_ / "a" / "b" / "out";
  StagedFolder folder("results");
  ASSERT_EQ(text_of(folder.open(out)), "");
  write(folder.path() / "summary.json", kNew);
  EXPECT_FALSE(fs::exists(out));
  ASSERT_EQ(folder.commit(), "");
  EXPECT_EQ(read(out / "summary.json"), kNew);
  EXPECT_EQ(names_in(out.parent_path()), Names{"out"});
  EXPECT_TRUE(folder.path().empty());
}

TEST_F(AtomicOutput, AnEarlierResultIsReplacedAsAWhole) {
  const fs::path out = earlier_result();
  StagedFolder folder("results");
  ASSERT_EQ(text_of(folder.open(out.string() + "/")), "");  // a trailing slash names the same folder
  write(folder.path() / "summary.json", kNew);
  EXPECT_EQ(read(out / "summary.json"), kOld);
  ASSERT_EQ(folder.commit(), "");
  EXPECT_EQ(names_in(out), (Names{kFileList, "summary.json"}));
  EXPECT_EQ(read(out / "summary.json"), kNew);
  EXPECT_EQ(names_in(dir_), Names{"out"});
}

TEST_F(AtomicOutput, WithoutCommitNothingChangesAndNothingIsLeft) {
  const fs::path out = earlier_result();
  {
    StagedFolder folder("results");
    ASSERT_EQ(text_of(folder.open(out)), "");
    write(folder.path() / "summary.json", kNew);
    EXPECT_EQ(names_in(dir_).size(), 2U);
  }
  EXPECT_EQ(read(out / "summary.json"), kOld);
  EXPECT_EQ(names_in(out), (Names{kFileList, "summary.json", "maps"}));
  EXPECT_EQ(names_in(dir_), Names{"out"});
}

TEST_F(AtomicOutput, AnEmptyFolderAndALinkToAResultMayBeReplaced) {
  fs::create_directory(dir_ / "empty");
  StagedFolder first("results");
  ASSERT_EQ(text_of(first.open(dir_ / "empty")), "");
  ASSERT_EQ(first.commit(), "");

  const fs::path out = earlier_result();
  fs::create_directory_symlink(out, dir_ / "link");
  StagedFolder second("results");
  ASSERT_EQ(text_of(second.open(dir_ / "link")), "");
  write(second.path() / "summary.json", kNew);
  ASSERT_EQ(second.commit(), "");
  EXPECT_TRUE(fs::is_symlink(dir_ / "link"));
  EXPECT_EQ(read(out / "summary.json"), kNew);
  EXPECT_EQ(names_in(dir_), (Names{"empty", "link", "out"}));
}

TEST_F(AtomicOutput, WhatIsNoResultOfGenuIsRefusedAndKept) {
  fs::create_directory(dir_ / "thesis");
  write(dir_ / "thesis" / "chapter1.tex", "years of work");
  write(dir_ / "file", "a file");
  const fs::path cwd = fs::current_path();
  for (const fs::path& target :
       {dir_ / "thesis", dir_ / "file", dir_ / "file" / "below", fs::path("/"), fs::path("//"), fs::path("."),
        fs::path(".."), fs::path(""), cwd, cwd / "x" / "..", cwd.parent_path() / "."}) {
    StagedFolder folder("results");
    EXPECT_TRUE(folder.open(target)) << target;
    EXPECT_TRUE(folder.path().empty()) << target;
    EXPECT_NE(folder.commit(), "") << target;
  }
  EXPECT_EQ(read(dir_ / "thesis" / "chapter1.tex"), "years of work");
  EXPECT_EQ(names_in(dir_), (Names{"file", "thesis"}));
}

TEST_F(AtomicOutput, WhatOthersPutBesideAResultIsKept) {
  const fs::path out = earlier_result();
  write(out / "notes.txt", "mine");
  fs::create_directories(out / "maps/mine/empty");
  write(out / "maps/mine/curve.svg", "mine too");
  fs::create_symlink("notes.txt", out / "link");
  StagedFolder folder("results");
  ASSERT_EQ(text_of(folder.open(out)), "");
  write(folder.path() / "summary.json", kNew);
  ASSERT_EQ(folder.commit(), "");
  EXPECT_EQ(read(out / "summary.json"), kNew);
  EXPECT_EQ(read(out / "link"), "mine");
  EXPECT_EQ(read(out / "maps/mine/curve.svg"), "mine too");
  EXPECT_TRUE(fs::is_directory(out / "maps/mine/empty"));
  EXPECT_FALSE(fs::exists(out / "maps/only_old.csv"));
  EXPECT_EQ(names_in(dir_), Names{"out"});

  // What genu is to write now under the name of another's file is not written at all.
  StagedFolder clash("results");
  ASSERT_EQ(text_of(clash.open(out)), "");
  write(clash.path() / "notes.txt", "genu's");
  EXPECT_NE(clash.commit().find("notes.txt: was not written by genu"), std::string::npos);
  EXPECT_EQ(read(out / "notes.txt"), "mine");
}

TEST_F(AtomicOutput, ResultsOfAnotherKindAndThoseMadeReadOnlyAreNotReplaced) {
  const fs::path out = earlier_result();
  StagedFolder other("converted results");
  EXPECT_NE(text_of(other.open(out)).find("holds genu's results"), std::string::npos);
  StagedFolder unlisted("");
  EXPECT_TRUE(unlisted.open(out));
  if (::geteuid() != 0) {  // root writes everywhere
    fs::permissions(out / "maps", fs::perms::owner_read | fs::perms::owner_exec);
    StagedFolder same("results");
    EXPECT_NE(text_of(same.open(out)).find("maps: is read-only"), std::string::npos);
    fs::permissions(out / "maps", fs::perms::owner_all);
  }
  // A folder that is to be edited never is.
  StagedFolder scene("");
  ASSERT_EQ(text_of(scene.open(dir_ / "scene")), "");
  write(scene.path() / "knee.toml", "format = 1");
  ASSERT_EQ(scene.commit(), "");
  StagedFolder results("results");
  EXPECT_TRUE(results.open(dir_ / "scene"));
}

TEST_F(AtomicOutput, WhatAppearsDuringTheRunIsKept) {
  const fs::path out = dir_ / "out";
  {
    StagedFolder folder("results");
    ASSERT_EQ(text_of(folder.open(out)), "");
    fs::create_directory(out);
    write(out / "notes.txt", "mine");
    EXPECT_NE(folder.commit(), "");
  }
  EXPECT_EQ(read(out / "notes.txt"), "mine");
  EXPECT_EQ(names_in(dir_), Names{"out"});
}

TEST_F(AtomicOutput, AnUnwritablePlaceIsSaidBeforeAnythingIsComputed) {
  StagedFolder folder("results");  // not even root writes into /proc
  const std::string error = text_of(folder.open("/proc/genu/out"));
  EXPECT_NE(error.find("/proc/genu"), std::string::npos) << error;
  EXPECT_NE(write_file_atomically("/proc/genu.txt", "x"), "");
  EXPECT_NE(write_file_atomically(dir_ / "missing" / "file", "x"), "");
}

TEST_F(AtomicOutput, AFileIsReplacedWholeAndOnlyAFile) {
  const fs::path file = dir_ / "results.csv";
  const std::string bytes("a,b\r\n1,\0 2\n", 11);
  EXPECT_EQ(write_file_atomically(file, "longer content that was there before"), "");
  EXPECT_EQ(write_file_atomically(file, bytes), "");
  EXPECT_EQ(read(file), bytes);
  EXPECT_NE(write_file_atomically(dir_, "x"), "");
  EXPECT_NE(write_file_atomically("/dev/null", "x"), "");
  EXPECT_NE(write_file_atomically("", "x"), "");
  fs::create_symlink(file, dir_ / "link");
  EXPECT_NE(write_file_atomically(dir_ / "link", "x"), "") << "a link is somebody's, and so is what it names";
  EXPECT_EQ(read(file), bytes);
  fs::remove(dir_ / "link");
  EXPECT_EQ(names_in(dir_), Names{"results.csv"});
}

TEST_F(AtomicOutput, AFolderHoldsWhatLiesInItAtAnyDepth) {
  fs::create_directories(dir_ / "a" / "b");
  write(dir_ / "a" / "b" / "mesh.stl", "x");
  write(dir_ / "other.stl", "x");
  fs::create_symlink(dir_ / "a" / "b" / "mesh.stl", dir_ / "link.stl");
  EXPECT_TRUE(folder_holds(dir_ / "a", dir_ / "a" / "b" / "mesh.stl"));
  EXPECT_TRUE(folder_holds((dir_ / "a").string() + "/", dir_ / "a" / "b" / ".." / "b" / "mesh.stl"));
  EXPECT_TRUE(folder_holds(dir_ / "a", dir_ / "link.stl"));
  EXPECT_FALSE(folder_holds(dir_ / "a" / "b", dir_ / "other.stl"));
  EXPECT_FALSE(folder_holds(dir_ / "a", dir_ / "a" / "none.stl"));
  EXPECT_FALSE(folder_holds(dir_ / "ab", dir_ / "a" / "b" / "mesh.stl"));
}

// A limit on the size of files fails a write half way, as a full disk does.
TEST_F(AtomicOutput, AWriteThatFailsHalfWayKeepsTheOldFile) {
  const fs::path file = dir_ / "results.csv";
  ASSERT_EQ(write_file_atomically(file, "old"), "");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  const std::string error = write_file_atomically(file, std::string(1'000'000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(error.find("cannot be written"), std::string::npos) << error;
  EXPECT_EQ(read(file), "old");
  EXPECT_EQ(names_in(dir_), Names{"results.csv"});
}

TEST_F(AtomicOutput, AStagedFileIsThereOnceItIsCommitted) {
  const fs::path file = dir_ / "rows.csv";
  {
    StagedFile dropped(file);
    dropped.write("never");
  }
  EXPECT_TRUE(names_in(dir_).empty());
  StagedFile first(file, Durable::yes), second(file);  // of two writers of one file
  const std::string much(3'000'000, 'x');
  first.write(much);
  first.write("end");
  second.write("other");
  EXPECT_FALSE(fs::exists(file));
  EXPECT_EQ(first.commit(), "");
  EXPECT_EQ(read(file), much + "end");
  EXPECT_EQ(second.commit(), "");
  EXPECT_EQ(read(file), "other");
  EXPECT_NE(second.commit(), "");
  EXPECT_EQ(names_in(dir_), Names{"rows.csv"});
  EXPECT_NE(StagedFile(dir_).commit().find("is not a file that can be replaced"), std::string::npos);
}

TEST(WhyNotReplaced, OnlyWhatIsMarkedOrEmptyIsReplaced) {
  const fs::path folder = fs::path(testing::TempDir()) / "genu-why-not-replaced";
  fs::create_directories(folder);
  EXPECT_FALSE(why_not_replaced(folder / "new.json", "\"mark\":"));
  for (const auto& [text, replaced] :
       {std::pair{"", true}, std::pair{"{\"mark\": 1}", true}, std::pair{"format = 1", false}}) {
    write(folder / "file", text);
    EXPECT_EQ(!why_not_replaced(folder / "file", "\"mark\":"), replaced) << text;
  }
  EXPECT_TRUE(why_not_replaced(folder, "\"mark\":")) << "a folder";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace genu
