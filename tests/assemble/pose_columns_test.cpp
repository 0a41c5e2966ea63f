// Which column is which coordinate, and in which unit: by all four rules, and what is refused.
#include "genu/assemble/pose_columns.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/assemble/given_poses.h"
#include "genu/assemble/opensim_names.h"
#include "support/scene_model.h"
#include "support/text.h"

namespace genu {
namespace {

/// Two joints, one of them revolute, and a load over time where `more` has one.
Scene scene_with(const std::string& more = "") {
  Diagnostics out;
  const auto scene = parse_scene(test::bone_on_ground() + R"([body.patella]
[joint.knee_r]
type = "free"
parent = "bone"
child = "patella"
rotations = ["flexion -z", "adduction x", "rotation y"]
translations = ["tx", "y", "z"]
[body.door]
[joint.hinge]
type = "revolute"
parent = "ground"
child = "door"
axis = [0, 0, 1]
origin = [0, 0, 7]
[load.push]
body = "bone"
force = [1, 0, 0]
)" + more + "[[step]]\nincrements = 1\n",
                                 "scene.toml", out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  return scene.value_or(Scene());
}

/// A file whose columns give joint j and the hinge, and what `more` says.
struct Table {
  std::string names = "j.a,j.b,j.c,j.x,j.y,j.z,hinge_angle_r", row = "1,2,3,4,5,6,7";
  Table& with(const std::string& more_names, const std::string& more_row) {
    names += "," + more_names;
    row += "," + more_row;
    return *this;
  }
};
const std::string kKnee = "knee_flex_r,knee_add_r,knee_rot_r,knee_tx_r,knee_ty_r,knee_tz_r",
                  kKneeRow = "11,12,13,14,15,16";

struct Result {
  std::optional<PoseColumns> columns;
  std::optional<GivenPoses> poses;
  std::string said;
};

Result match(const SceneTables& scene, const std::string& text, const PoseColumnOptions& options = {},
             const std::string& path = "p.csv") {
  Diagnostics out;
  Result r;
  if (const auto file = parse_pose_file(text, path, out)) {
    r.columns = match_columns(scene, *file, options, out);
    if (r.columns) r.poses = read_given_poses(scene, *file, *r.columns, out);
  }
  for (const Diagnostic& d : out.items()) r.said += to_string(d) + "\n";
  return r;
}

Result match(const Table& table, const PoseColumnOptions& options = {}, const std::string& more = "") {
  return match(scene_with(more), table.names + "\n" + table.row + "\n", options);
}

/// The one pose of a table that has to be good.
JointValues values_of(const Result& r, std::size_t joint) {
  EXPECT_TRUE(r.poses) << r.said;
  return r.poses ? r.poses->poses.at(0).coordinates.at(joint) : JointValues{};
}

TEST(PoseColumns, ByNameByOpenSimsHabitInRadAndM) {
  const Result r = match(Table().with(kKnee, kKneeRow).with("knee_flex_r_other", "1"));
  EXPECT_EQ(values_of(r, 0), (JointValues{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(values_of(r, 1), (JointValues{11, 12, 13, 14, 15, 16}));
  // The hinge holds all but its angle.
  EXPECT_EQ(values_of(r, 2), (JointValues{7, 0, 0, 0, 0, 7e-3}));
  ASSERT_EQ(r.columns->ignored.size(), 1u);
  EXPECT_EQ(r.columns->ignored[0], 13u);
  EXPECT_TRUE(std::isnan(r.poses->poses[0].time));
}

TEST(PoseColumns, OwnColumnsHaveTheirUnits) {
  const Result r =
      match({"j.a_deg,j.b_deg,j.c_deg,j.x_mm,j.y_mm,j.z_mm,hinge.angle_deg," + kKnee + ",time_s,push.factor",
             "180,90,45,1,2,3,180," + kKneeRow + ",0.5,3"});
  EXPECT_EQ(values_of(r, 0), (JointValues{M_PI, M_PI / 2, M_PI / 4, 1e-3, 2e-3, 3e-3}));
  EXPECT_EQ(values_of(r, 2)[0], M_PI);
  EXPECT_EQ(r.poses->poses[0].time, 0.5);
  EXPECT_EQ(r.poses->poses[0].load_factors, std::vector<double>{3});
}

TEST(PoseColumns, UnitsOfTheOthers) {
  const Result r = match(Table().with(kKnee, kKneeRow), {"", "mm, deg"});
  EXPECT_EQ(values_of(r, 1)[0], 11 * M_PI / 180);
  EXPECT_EQ(values_of(r, 1)[3], 14e-3);
  std::string storage = Table().with(kKnee, kKneeRow).names + "\n" + Table().with(kKnee, kKneeRow).row + "\n";
  for (char& c : storage)
    if (c == ',') c = '\t';
  const Result degrees = match(scene_with(), "inDegrees=yes\nendheader\n" + storage, {}, "p.mot");
  EXPECT_EQ(values_of(degrees, 1)[0], 11 * M_PI / 180);
  EXPECT_EQ(values_of(degrees, 1)[3], 14);
  EXPECT_EQ(values_of(match(scene_with(), "inDegrees=no\nendheader\n" + storage, {}, "p.mot"), 1)[0], 11);
}

TEST(PoseColumns, UnitsInNamesAreHeeded) {
  for (const char* name :
       {"knee_flex_r (deg)", "knee_flex_r[deg]", "knee_flex_r_deg", "knee_flex_r [Degrees]",
        "/jointset/knee_r/knee_flex_r/value (deg)", "knee_r.flexion (deg)", "knee_r.flexion [deg]"}) {
    const Result r = match(Table().with(std::string(name) + kKnee.substr(11), "180" + kKneeRow.substr(2)));
    EXPECT_DOUBLE_EQ(values_of(r, 1)[0], M_PI) << name << r.said;
  }
  for (const auto& [name, value] :
       {std::pair{"knee_tx_r (mm)", 14e-3}, {"knee_tx_r_m", 14.}, {"knee_tx_r [cm]", 0.14}}) {
    const Result r = match(Table().with(test::with_first(kKnee, "knee_tx_r", name), kKneeRow), {"", "mm"});
    EXPECT_DOUBLE_EQ(values_of(r, 1)[3], value) << name << r.said;
  }
  const Result picked = match(Table().with(kKnee, kKneeRow).with("q (deg)", "180"), {"knee_r.flexion=q", "rad"});
  EXPECT_DOUBLE_EQ(values_of(picked, 1)[0], M_PI) << picked.said;
  const Result odd = match(Table().with(kKnee, kKneeRow).with("q (grad)", "1"), {"knee_r.flexion=q (grad)", ""});
  EXPECT_NE(odd.said.find("q (grad): is read in rad: (grad) is no unit that is known"), std::string::npos) << odd.said;
}

TEST(PoseColumns, UnitsThatAHeaderSays) {
  std::string table = Table().with(kKnee, kKneeRow).names + "\n" + Table().with(kKnee, kKneeRow).row + "\n";
  std::replace(table.begin(), table.end(), ',', '\t');
  const auto flexion = [&](const std::string& header, const std::string& units = "") {
    return match(scene_with(), header + "endheader\n" + table, {"", units}, "p.mot");
  };
  for (const char* header : {"inDegrees=yes\n", "INDEGREES = Yes \n", "inDegrees yes\n", "Angles are in degrees.\n",
                             "inDegrees=yes\nAngles are in degrees.\n"}) {
    EXPECT_DOUBLE_EQ(values_of(flexion(header), 1)[0], 11 * M_PI / 180) << header;
    EXPECT_EQ(flexion(header, "m").said, "") << header;
  }
  for (const char* header : {"inDegrees=no\n", "Angles are in radians.\n", ""})
    EXPECT_EQ(values_of(flexion(header), 1)[0], 11) << header;
  const Result simm = flexion("name a.mot\ndatacolumns 13\ndatarows 1\notherdata 1\nrange 0.0 1.0\n");
  EXPECT_DOUBLE_EQ(values_of(simm, 1)[0], 11 * M_PI / 180);
  EXPECT_NE(simm.said.find("warning: the header is that of a SIMM motion"), std::string::npos) << simm.said;
  EXPECT_EQ(values_of(flexion("datacolumns 13\n", "rad"), 1)[0], 11);
  const char* both = "inDegrees=no\nAngles are in degrees.\n";
  EXPECT_NE(flexion(both).said.find("p.mot:1:1: inDegrees=no and \"Angles are in degrees.\" say the opposite"),
            std::string::npos);
  EXPECT_DOUBLE_EQ(values_of(flexion(both, "deg"), 1)[0], 11 * M_PI / 180);
}

TEST(PoseColumns, AsTheUserSays) {
  const Result r = match(Table().with(kKnee, kKneeRow).with("q,/s/t_mm,clock", "180,20,9"),
                         {"knee_r.flexion = q[deg], knee_r.tx=t_mm, time=clock", ""});
  EXPECT_EQ(values_of(r, 1), (JointValues{M_PI, 12, 13, 20e-3, 15, 16}));
  EXPECT_EQ(r.poses->poses[0].time, 9);
  EXPECT_EQ(r.columns->coordinates[6].how, "--columns");
  EXPECT_EQ(r.columns->coordinates[9].unit_name, "mm");
}

TEST(PoseColumns, NamesOfOpenSim) {
  const Scene scene = scene_with();
  const auto is = [&](const std::string& name, const CoordinateRef& c) {
    const auto found = opensim_coordinates(scene, name);
    return found.size() == 1 && found[0] == c;
  };
  EXPECT_TRUE(is("knee_flex_r", {1, 0}));
  EXPECT_TRUE(is("Knee_Flexion_R", {1, 0}));
  EXPECT_TRUE(is("/jointset/knee_r/knee_add_r/value", {1, 1}));
  EXPECT_TRUE(is("knee_r_rot", {1, 2}));
  EXPECT_TRUE(is("knee_tx_r", {1, 3}));
  EXPECT_TRUE(is("knee_ty_r", {1, 4}));
  EXPECT_TRUE(is("hinge_angle", {2, 0}));
  EXPECT_TRUE(is("j_tx_l", {0, 3}));
  for (const char* none : {"/jointset/knee_r/knee_add_r/speed", "knee_fl_r", "knee_flex_l", "knee_tw_r", "hinge_tx_r",
                           "flex", "_r", "", "knee_", "/", "/value"})
    EXPECT_TRUE(opensim_coordinates(scene, none).empty()) << none;
}

struct WrongColumns {
  Table table;
  PoseColumnOptions options;
  const char* said;
};

TEST(PoseColumns, RefusesWithAWayOut) {
  const Table good = Table().with(kKnee, kKneeRow);
  const WrongColumns cases[] = {
      {Table(), {}, "p.csv:1:1: no column gives \"knee_r.flexion\", \"knee_r.adduction\""},
      {Table(), {}, "or say --columns \"knee_r.flexion=COLUMN[rad]\"; the columns here: \"j.a\""},
      {Table(good).with("/x/knee_flex_r", "1"), {}, "and /x/knee_flex_r may both be it: say which by --columns"},
      {good, {"knee_r.flex=q", ""}, "did you mean \"knee_r.flexion\"?"},
      {good, {"hinge.y=j.a", ""}, "is no coordinate that a column can give"},
      {good, {"knee_r.flexion=knee_flx_r", ""}, "is no column of p.csv; did you mean \"knee_flex_r\"?"},
      {good, {"knee_r.flexion=j.a[mm]", ""}, "the unit of an angle is [deg] or [rad]"},
      {good, {"knee_r.tx=j.x[deg]", ""}, "the unit of a length is [mm], [cm] or [m]"},
      {Table(good).with("j.a", "1"), {}, "column = \"j.a\": is the name of the column at 1 as well"},
      {Table().with("knee_flex_r (mm)", "1"), {}, "is taken for knee_r.flexion, and mm is no unit of an angle"},
      {Table(good).with("/a/q/value,/b/q/value", "1,2"), {"j.a=q", ""}, "may be \"/a/q/value\" or \"/b/q/value\""},
      {good, {"time=j.x[s]", ""}, "time has no unit"},
      {good, {"knee_r.tx", ""}, "must be QUANTITY=COLUMN"},
      {good, {"knee_r.tx=j.x,knee_r.tx=j.y", ""}, "is given twice"},
      {good, {"time=j.x,time=j.y", ""}, "is given twice"},
      {good, {"", "inch"}, "--units = \"inch\": must be"},
      {good, {"", "mm,m"}, "--units = \"mm,m\": must be"},
      {Table(good).with("ang_mm", "1"), {"knee_r.flexion=ang_mm", ""}, "and mm is no unit of an angle"},
      {Table(good).with("x_deg", "1"), {"knee_r.tx=x_deg", ""}, "and deg is no unit of a length"},
  };
  for (const WrongColumns& wrong : cases) {
    const Result r = match(wrong.table, wrong.options);
    EXPECT_FALSE(r.columns) << wrong.said;
    EXPECT_NE(r.said.find(wrong.said), std::string::npos) << "wanted " << wrong.said << "\nsaid " << r.said;
  }
}

TEST(PoseColumns, SidesOfOneJointNeedAWord) {
  const PlacedScene scene = test::scene_model(test::bone_on_ground()).scene;
  const std::string names = "j_tx_r,j_tx_l,j_ty_r,j_tz_r,j.a,j.b,j.c", row = "1,2,3,4,5,6,7";
  const Result both = match(scene, names + "\n" + row + "\n");
  EXPECT_NE(both.said.find("p.csv:1:1: j.x: j_tx_r and j_tx_l may both be it"), std::string::npos) << both.said;
  const Result said = match(scene, names + "\n" + row + "\n", {"j.x=j_tx_l", ""});
  EXPECT_EQ(values_of(said, 0)[3], 2);
}

TEST(GivenPoses, RefusesBadNumbersWithTheirPlaces) {
  const std::string names = Table().with(kKnee, kKneeRow).names + ",time\n", rest = ",2,3,4,5,6,7," + kKneeRow + ",";
  const std::pair<std::string, const char*> cases[] = {
      {"x1" + rest + "0\n", "p.csv:2:1: j.a = \"x1\": is no number"},
      {"1" + rest + "\n", "p.csv:2:33: time = \"\": is empty"},
      {"nan" + rest + "0\n", "p.csv:2:1: j.a = \"nan\": must be a finite number"},
      {"1e6" + rest + "0\n", "j.a = \"1e6\": is too large for a joint"},
      {"1" + rest + "1\n1" + rest + "0.5\n", "p.csv:3:33: time = 0.5: must be > 1"},
  };
  for (const auto& [rows, said] : cases) {
    const Result r = match(scene_with(), names + rows);
    EXPECT_FALSE(r.poses) << said;
    EXPECT_NE(r.said.find(said), std::string::npos) << "wanted " << said << "\nsaid " << r.said;
  }
}

TEST(GivenPoses, EqualTimesAreTakenWithAWarning) {
  const std::string names = Table().with(kKnee, "").names + ",time\n", rest = "1,2,3,4,5,6,7," + kKneeRow + ",";
  const Result r = match(scene_with(), names + rest + "0\n" + rest + "0\n" + rest + "1\n", {"", "deg,mm"});
  ASSERT_TRUE(r.poses) << r.said;
  EXPECT_EQ(r.poses->poses.size(), 3u);
  EXPECT_EQ(r.said, "p.csv:3:33: warning: time = 0: is the time of the row in line 2, too: both are taken\n");
}

TEST(GivenPoses, UnitsThatAreProbablyOthersAreSaid) {
  const Result r = match(Table().with(kKnee, "-30,0.1,6,0.1,1.9,42"));
  ASSERT_TRUE(r.poses) << r.said;
  EXPECT_NE(
      r.said.find("p.csv:2:15: warning: knee_flex_r = -30: is read in rad (OpenSim's habit, unit: SI), which makes "
                  "4.77 turns: was deg meant? Then say --units deg, or --columns "
                  "\"knee_r.flexion=knee_flex_r[deg]\""),
      std::string::npos)
      << r.said;
  EXPECT_NE(r.said.find("knee_tz_r = 42: is read in m (OpenSim's habit, unit: SI), which makes 4.2e+04 mm: was mm"),
            std::string::npos)
      << r.said;
  EXPECT_EQ(r.said.find("knee_rot_r"), std::string::npos) << "6 rad are less than a turn";
  EXPECT_EQ(r.said.find("knee_ty_r"), std::string::npos) << r.said;
  EXPECT_EQ(match(Table().with(kKnee, "-30,0.1,6,0.1,1.9,42"), {"", "deg,m"}).said, "") << "said by the user";
  const Result turned = match(Table().with(kKnee, "-400,0.1,6,0.1,1.9,1"), {"", "deg,m"});
  EXPECT_NE(turned.said.find("knee_flex_r = -400: is read in deg (OpenSim's habit, unit: --units), which makes 1.11 "
                             "turns: check that it is the right column"),
            std::string::npos)
      << turned.said;
}

TEST(GivenPoses, ADecimalCommaIsSaidOnce) {
  const std::string names = Table().names + "\n";
  std::string table = names + "1,2,3,4,5,6,7\n";
  std::replace(table.begin(), table.end(), ',', ';');
  const PlacedScene scene = test::scene_model(test::bone_on_ground()).scene;
  const Result r = match(scene, table + "1.5;1,5;2,5;3;3;3;3\n1,5;1,5;2,5;3;3;3;3\n");
  EXPECT_EQ(r.said, "p.csv:3:5: j.b = \"1,5\": is no number: write the table with decimal points instead of commas\n");
}

TEST(GivenPoses, TimeIsNeededWhereLoadsChangeOverIt) {
  const Table good = Table().with(kKnee, kKneeRow);
  const std::string moved =
      "[load.swing]\nbody = \"bone\"\nforce = [1, 0, 0]\nscale = { table = [[0, 0], [1, 1]], over = \"time\" }\n";
  const Result without = match(good, {}, moved);
  EXPECT_FALSE(without.poses);
  EXPECT_NE(without.said.find("has no column time, over which load.swing changes"), std::string::npos) << without.said;
  EXPECT_TRUE(match(Table(good).with("time", "0"), {}, moved).poses);
}

TEST(GivenPoses, RowsOfARunThatHoldNoPoseAreLeftOut) {
  const std::string names = "step,increment,status," + Table().with(kKnee, kKneeRow).names + "\n",
                    row = Table().with(kKnee, kKneeRow).row + "\n", empty = "1,,,,,,,,,,,,\n";
  const Result r =
      match(scene_with(), names + "1,0,ok," + row + "1,1,no_equilibrium," + empty + "2,5,undetermined," + row);
  ASSERT_TRUE(r.poses) << r.said;
  EXPECT_EQ(r.poses->left_out, 1u);
  ASSERT_EQ(r.poses->poses.size(), 2u);
  EXPECT_EQ(r.poses->poses[1].step, 2);
  EXPECT_EQ(r.poses->poses[1].increment, 5);
  EXPECT_FALSE(match(scene_with(), names + "1,1,no_equilibrium," + empty).poses);
}

}  // namespace
}  // namespace genu
