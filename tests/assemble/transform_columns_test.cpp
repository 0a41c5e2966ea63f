// Columns that are the transform of a joint, by name and by place, and the coordinates that follow.
#include "genu/assemble/transform_columns.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/assemble/given_poses.h"
#include "genu/model/joint_coordinates.h"
#include "genu/scene/reader.h"
#include "support/scene_model.h"

namespace genu {
namespace {

const Scene& scene() {
  static const Scene read = [] {
    Diagnostics out;
    auto scene = parse_scene(test::bone_on_ground() + "[[step]]\nincrements = 1\n", "scene.toml", out);
    for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
    return scene.value_or(Scene());
  }();
  return read;
}

const JointValues kValues = {0.4, -0.3, 1.2, 0.01, -0.02, 0.03};

/// 16 numbers of the matrix of these coordinates, lengths in mm.
std::string row_of(const JointValues& values) {
  const Pose X = JointCoordinates(scene().joints[0]).pose_from(values);
  std::string row;
  for (int i = 0; i < 3; ++i) row += fmt::format("{},{},{},{},", X.R(i, 0), X.R(i, 1), X.R(i, 2), 1e3 * X.p[i]);
  return row + "0,0,0,1";
}

std::string names_like(const std::string& before, const std::string& between, int first = 1) {
  std::string names;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      names += fmt::format("{}{}{}{}{}", i + j > 0 ? "," : "", before, i + first, between, j + first);
  return names;
}

struct Result {
  std::optional<GivenPoses> poses;
  std::string said;
};

Result read(const std::string& text, const PoseColumnOptions& options) {
  Diagnostics out;
  Result r;
  if (const auto file = parse_pose_file(text, "p.csv", out))
    if (const auto columns = match_columns(scene(), *file, options, out))
      r.poses = read_given_poses(scene(), *file, *columns, out);
  for (const Diagnostic& d : out.items()) r.said += to_string(d) + "\n";
  return r;
}

PoseColumnOptions transforms(const std::string& option) {
  PoseColumnOptions options;
  options.transforms = option;
  return options;
}

void expect_values(const Result& r, const JointValues& values, const std::string& what) {
  ASSERT_TRUE(r.poses) << what << "\n" << r.said;
  EXPECT_EQ(r.said, "") << what;
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(r.poses->poses.at(0).coordinates.at(0)[i], values[i], 1e-12) << what << " " << i;
}

TEST(TransformColumns, KnownPosesComeBackAsTheirCoordinates) {
  for (const JointValues& values : {kValues, JointValues{}, JointValues{-2.5, 0.9, -0.1, 0, 0.04, 0}})
    expect_values(read("time," + names_like("T", "") + "\n0," + row_of(values) + "\n", transforms("j=T[mm]")), values,
                  "T");
}

TEST(TransformColumns, ByNamesOfManyKinds) {
  const std::string row = "\n" + row_of(kValues) + "\n";
  std::string count, from_0;
  for (int k = 0; k < 16; ++k)
    count += fmt::format("{}T{}", k > 0 ? "," : "", k + 1), from_0 += fmt::format("{}T_{}", k > 0 ? "," : "", k);
  for (const std::string& names : {names_like("T", ""), names_like("T_", "_"), names_like("T.", ""),
                                   names_like("T", "", 0), names_like("Tm", ""), count, from_0})
    expect_values(read(names + row, transforms("j=T[mm]")), kValues, names);
  const std::string apart = "T_r11,T_r12,T_r13,T_tx,T_r21,T_r22,T_r23,T_ty,T_r31,T_r32,T_r33,T_tz,a,b,c,d";
  expect_values(read(apart + row, transforms("bone=T [mm]")), kValues, "the child's name");
  for (const char* mine : {"j", "bone"})
    expect_values(read(names_like(mine, "") + row, transforms("j[mm]")), kValues, mine);
}

TEST(TransformColumns, ByPlacesAndWithoutNames) {
  const std::string row = row_of(kValues), twelve = row.substr(0, row.size() - 8);
  expect_values(read("0.5," + row + "\n0.6," + row + "\n", transforms("j=2-17[mm]")), kValues, "no names");
  expect_values(read(twelve + "\n" + twelve + "\n", transforms("j[mm]")), kValues, "all columns");
  expect_values(read("time,a,b,c,d,e,f,g,h,i,k,l,m\n0," + twelve + "\n", transforms("j[mm]")), kValues, "but the time");
}

TEST(TransformColumns, UnitsOfTheTranslation) {
  const std::string table = names_like("T", "") + "\n" + row_of(kValues) + "\n";
  PoseColumnOptions in_mm = transforms("j=T");
  in_mm.units = "mm";
  expect_values(read(table, in_mm), kValues, "--units");
  const Result metres = read(table, transforms("j=T"));
  ASSERT_TRUE(metres.poses);
  EXPECT_DOUBLE_EQ(metres.poses->poses[0].coordinates[0][3], 10);
  EXPECT_NE(
      metres.said.find("p.csv:2:1: warning: transform of j: moves by 37.4 m, as no unit of its translation is said: "
                       "was mm meant?"),
      std::string::npos)
      << metres.said;
}

TEST(TransformColumns, RefusesWithTheRow) {
  const std::string names = names_like("T", "") + "\n", good = row_of(kValues) + "\n";
  const std::string stretched = "2,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n", mirrored = "-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n",
                    by_column = "1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1\n";
  const auto said = [&](const std::string& text, const std::string& option) {
    return read(text, transforms(option)).said;
  };
  EXPECT_NE(said(names + good + stretched, "j=T[mm]").find("p.csv:3:1: transform of j in row 2: is no rotation"),
            std::string::npos);
  EXPECT_NE(said(names + mirrored, "j=T[mm]").find("in row 1: mirrors (determinant -1)"), std::string::npos);
  EXPECT_NE(said(names + by_column, "j=T[mm]").find("written column by column"), std::string::npos);
  EXPECT_NE(said(names + good, "k=T").find("--transforms = \"k\": is no joint of the scene"), std::string::npos);
  EXPECT_NE(said(names + good, "j=T[deg]").find("the unit of the translation is [mm], [cm] or [m]"), std::string::npos);
  EXPECT_NE(said(names + good, "j=Q").find("must name 12 or 16 of the 16 columns"), std::string::npos);
  EXPECT_NE(said(names + good, "j=2-17").find("must name 12 or 16 of the 16 columns"), std::string::npos);
  EXPECT_NE(said(names + good, "j=T,j=T").find("is given twice"), std::string::npos);
  PoseColumnOptions both = transforms("j=T[mm]");
  both.columns = "j.a=T11";
  EXPECT_NE(read(names + good, both).said.find("--columns = \"j.a\": is given by --transforms already"),
            std::string::npos);
}

}  // namespace
}  // namespace genu
