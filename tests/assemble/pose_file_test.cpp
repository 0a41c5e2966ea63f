// Tables of poses as files have them, and every way in which they can be wrong, with its place.
#include "genu/assemble/pose_file.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace genu {
namespace {

struct Read {
  std::optional<PoseFile> file;
  std::string said;
};

Read read(const std::string& text, const std::string& path = "poses.csv") {
  Diagnostics out;
  Read read{parse_pose_file(text, path, out), {}};
  for (const Diagnostic& d : out.items()) read.said += to_string(d) + "\n";
  return read;
}

std::vector<std::string> words(const PoseFile::Row& row) {
  std::vector<std::string> out;
  for (const PoseFile::Cell& cell : row.cells) out.push_back(cell.text);
  return out;
}

using Words = std::vector<std::string>;

TEST(PoseFile, CsvCellsWithTheirPlaces) {
  const Read r = read(
      "\xEF\xBB\xBF"
      "time_s, knee.flexion ,\"a \"\"b\"\", c\"\r\n0,1.5,x\r\n\r\n1, -2,\"\"\r\n");
  ASSERT_TRUE(r.file) << r.said;
  EXPECT_EQ(words(r.file->names), (Words{"time_s", "knee.flexion", "a \"b\", c"}));
  ASSERT_EQ(r.file->rows.size(), 2u);
  EXPECT_EQ(words(r.file->rows[0]), (Words{"0", "1.5", "x"}));
  EXPECT_EQ(words(r.file->rows[1]), (Words{"1", "-2", ""}));
  EXPECT_EQ(r.file->rows[1].line, 4);
  EXPECT_EQ(r.file->rows[1].cells[1].column, 4);
  EXPECT_FALSE(r.file->angles.degrees);
}

TEST(PoseFile, SeparatorsOfCsv) {
  EXPECT_EQ(words(read("a;b\n1;2\n").file->rows[0]), (Words{"1", "2"}));
  EXPECT_EQ(words(read("a\tb\n1\t\n").file->rows[0]), (Words{"1", ""}));
  EXPECT_EQ(words(read("a\n1").file->rows[0]), (Words{"1"}));
}

TEST(PoseFile, StorageOfOpenSim) {
  const Read r = read(
      "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\ntime\t/jointset/k/a/value  b\n"
      "   0.0\t1 2\n   1.0\t3 4\n",
      "follow.mot");
  ASSERT_TRUE(r.file) << r.said;
  EXPECT_EQ(words(r.file->names), (Words{"time", "/jointset/k/a/value", "b"}));
  EXPECT_EQ(words(r.file->rows[1]), (Words{"1.0", "3", "4"}));
  EXPECT_EQ(r.file->rows[1].line, 9);
  EXPECT_EQ(r.file->rows[0].cells[0].column, 4);
  EXPECT_EQ(r.file->angles.degrees, true);
  EXPECT_EQ(read("inDegrees=no\nendheader\na\n1\n", "x.sto").file->angles.degrees, false);
  EXPECT_EQ(read("endheader\na\n1\n", "x.sto").file->angles.degrees, std::nullopt);
}

struct WrongFile {
  const char* path;
  std::string_view text;
  const char* said;
};

TEST(PoseFile, RefusesWithThePlace) {
  const WrongFile cases[] = {
      {"p.csv", "", "p.csv: is empty"},
      {"p.csv", " \r\n\n", "p.csv: is empty"},
      {"p.csv", "a,b\n", "p.csv: holds no pose"},
      {"p.csv", "a,b\n1,2\n1\n", "p.csv:3:1: has 1 cells where there are 2 columns"},
      {"p.csv", "a,b\n1,2,3\n", "p.csv:2:5: has 3 cells"},
      {"p.csv", "time,a\n0,0000,-5,000\n0,1,-6,0\n", "p.csv:2:8: has 4 cells where there are 2 columns, as where"},
      {"p.csv", "time,a\n0,-5\n0,1,-6,2\n0,2,-7,2\n", "p.csv:3:5: has 4 cells where there are 2 columns, as where"},
      {"p.csv",
       std::string_view("\xFF\xFE"
                        "a\0,\0b\0",
                        8),
       "p.csv: is text in UTF-16"},
      {"p.csv", "PK\x03\x04 rest", "p.csv: is a zip archive, such as a spreadsheet"},
      {"p.trc", "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\n60\n", "p.trc:1:1: is a table of markers (TRC)"},
      {"p.mot", "name a\ndatacolumns 3\ndatarows 1\nendheader\na b\n1 2\n",
       "p.mot:2:13: datacolumns = 3: the file holds 2 columns"},
      {"p.csv", "a,\"b\n1,2\n", "p.csv:1:1: has a quote that is not closed"},
      {"p.sto", "inDegrees=maybe\nendheader\na\n1\n", "p.sto:1:11: inDegrees = maybe: must be yes or no"},
      {"p.sto", "DataType=Vec3\nendheader\na\n1\n", "p.sto:1:10: DataType = vec3"},
      {"p.sto", "nRows=3\nendheader\na\n1\n2\n", "p.sto:1:7: nRows = 3: the file holds 2 rows"},
      {"p.sto", "nRows=2\nnColumns=3\nendheader\na b\n1 2\n3 4\n",
       "p.sto:2:10: nColumns = 3: the file holds 2 columns"},
      {"p.sto", "nRows=7\nnColumns=3\nendheader\na b\n1 2\n", "p.sto:1:7: nRows = 7: the file holds 1 rows"},
      {"p.sto", "nRows=7\nnColumns=3\nendheader\na b\n1 2\n", "p.sto:2:10: nColumns = 3"},
      {"p.sto", "nRows=two\nendheader\na\n1\n", "p.sto:1:7: nRows = two: must be a whole number"},
      {"p.sto", "nColumns=-1\nendheader\na\n1\n", "p.sto:1:10: nColumns = -1: must be a whole number"},
      {"p.sto", "endheader\na b\n1\t\t\n", "p.sto:3:1: has 1 cells where there are 2 columns"},
      {"p.sto", "a b\n1 2\n", "p.sto:1:1: a storage file has a line \"endheader\""},
      {"p.sto", "endheader\n", "holds no row of column names"},
  };
  for (const WrongFile& wrong : cases) {
    const Read r = read(std::string(wrong.text), wrong.path);
    EXPECT_FALSE(r.file) << wrong.text;
    EXPECT_NE(r.said.find(wrong.said), std::string::npos) << wrong.text << "\nsaid " << r.said;
  }
}

TEST(PoseFile, DecimalCommasWhereTheyCanBeNothingElse) {
  EXPECT_EQ(words(read("time;a\n0,1000;-5,25\n").file->rows[0]), (Words{"0.1000", "-5.25"}));
  EXPECT_EQ(words(read("time\ta\n0,1\t1,5e-3\n").file->rows[0]), (Words{"0.1", "1.5e-3"}));
  EXPECT_EQ(words(read("endheader\ntime a\n0,1 -2,5\n", "p.sto").file->rows[0]), (Words{"0.1", "-2.5"}));
  // With points as well, 1,234 may be one thousand.
  const Read both = read("time;a\n0.1;1,234\n");
  EXPECT_EQ(words(both.file->rows[0]), (Words{"0.1", "1,234"}));
  EXPECT_NE(both.file->no_number("1,234").find("decimal points instead of commas"), std::string::npos);
  EXPECT_EQ(both.file->no_number("x"), "is no number");
}

TEST(PoseFile, ARowOfUnitsJoinsTheNames) {
  const Read r = read("time;a;b\ns;deg;(mm)\n0;1;2\n");
  EXPECT_EQ(words(r.file->names), (Words{"time", "a [deg]", "b [mm]"}));
  ASSERT_EQ(r.file->rows.size(), 1u);
  EXPECT_EQ(r.file->rows[0].line, 3);
}

TEST(PoseFile, WithoutNamesColumnsAreCounted) {
  const Read r = read("0.5,1,2\n0.6,3,4\n");
  EXPECT_EQ(words(r.file->names), (Words{"1", "2", "3"}));
  EXPECT_EQ(r.file->rows.size(), 2u);
  EXPECT_EQ(read("1,2,3\n4,5,6\n").file->rows.size(), 1u) << "names that count are names";
}

TEST(PoseFile, EmptyCellsAtTheEndAndColumnsNobodyUsesDoNoHarm) {
  EXPECT_EQ(words(read("a,b\n1,2,\n").file->rows[0]), (Words{"1", "2"}));
  EXPECT_EQ(words(read("a,b,\n1,2\n").file->names), (Words{"a", "b"}));
  EXPECT_EQ(read("a;b\n1;2\n;\n;;;\n").file->rows.size(), 1u) << "rows without a word";
  const Read r = read("a,b,,a\n1,2,3,4\n");
  ASSERT_TRUE(r.file) << r.said;
  Diagnostics out;
  refuse_repeated_names(*r.file, {1}, out);
  EXPECT_TRUE(out.items().empty());
  refuse_repeated_names(*r.file, {0, 2}, out);
  ASSERT_EQ(out.items().size(), 2u);
  EXPECT_EQ(to_string(out.items()[0]), "poses.csv:1:5: a column has no name");
  EXPECT_EQ(to_string(out.items()[1]),
            "poses.csv:1:6: column = \"a\": is the name of the column at 1 as well: rename the one that is not meant");
}

TEST(PoseFile, ManyErrorsAreCounted) {
  std::string text = "a,b\n";
  for (int k = 0; k < 30; ++k) text += "1\n";
  const Read r = read(text);
  EXPECT_NE(r.said.find("poses.csv:21:1"), std::string::npos) << r.said;
  EXPECT_EQ(r.said.find("poses.csv:22:1"), std::string::npos) << r.said;
  EXPECT_NE(r.said.find("10 more errors like these"), std::string::npos) << r.said;
}

TEST(PoseFile, FilesThatAreNone) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  EXPECT_FALSE(read_pose_file(folder / "none.csv", out));
  EXPECT_FALSE(read_pose_file(folder / "", out));
  EXPECT_EQ(out.count(Diagnostic::Severity::error), 2u);
  EXPECT_TRUE(read_pose_file(folder.write("good.csv", "a\n1\n"), out));
}

}  // namespace
}  // namespace genu
