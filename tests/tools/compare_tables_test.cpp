// tools/compare-tables: what tools/compare-builds holds two builds to. It has to find a difference, and to tell
// rounding from it.
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

constexpr char kTable[] = "pose,status,force_N,moment_Nm,residual\n0,ok,100,1e-12,1e-17\n1,ok,-400.5,0,2e-16\n";

/// The exit code for `kTable` beside `other`; one line has to be said.
int compare(const std::string& other) {
  const test::TemporaryFolder folder;
  const std::string one = folder.write("one.csv", kTable), two = folder.write("two.csv", other), said = folder / "said";
  const std::string command =
      genu::test::source_folder() + "/tools/compare-tables knee " + one + " " + two + " >" + said + " 2>&1";
  const int status = std::system(command.c_str());
  const std::string line = test::read_file(said);
  EXPECT_EQ(line.rfind("knee", 0), 0u) << line;
  EXPECT_EQ(line.find('\n') + 1, line.size()) << line;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string with(const std::string& piece, const std::string& by) {
  std::string text = kTable;
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return text.replace(at, piece.size(), by);
}

TEST(CompareTables, TakeRoundingForTheSame) {
  EXPECT_EQ(compare(kTable), 0);
  EXPECT_EQ(compare(with("100,", "100.000001,")), 0);  // 1e-6 of 400
  EXPECT_EQ(compare(with("1e-12,", "-2.5e-10,")), 0);  // 0 but for rounding
  EXPECT_EQ(compare(with("2e-16", "7e-14")), 0);       // a residual is no result
}

TEST(CompareTables, FindWhatDiffers) {
  EXPECT_EQ(compare(with("100,", "100.00001,")), 1);
  EXPECT_EQ(compare(with("1e-12,", "3e-9,")), 1);
  EXPECT_EQ(compare(with("1,ok", "1,undetermined")), 1);
  EXPECT_EQ(compare(with("-400.5", "")), 1);
  EXPECT_EQ(compare(with("-400.5", "nan")), 1);
  EXPECT_EQ(compare(with("1,ok,-400.5,0,2e-16\n", "")), 1);
  EXPECT_EQ(compare(with(",residual\n", "\n")), 1);
  EXPECT_EQ(compare(with("2e-16\n", "2e-16,7\n")), 1);
  EXPECT_EQ(compare(""), 1);
}

}  // namespace
}  // namespace genu
