// Units and names of what OpenSim reads, on numbers that are known.
#include "genu/results/opensim_tables.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "results/report_case.h"

namespace genu {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The small case with a joint, a rigid contact in its first row, and columns of a ligament and a layer.
struct OpenSimCase {
  test::ReportCase base;
  ReportRun run;

  OpenSimCase() {
    JointDef joint;
    joint.name = "knee";
    joint.rotations[0].name = "flexion";
    joint.translations = {"x", "y", "z"};
    base.scene.joints.push_back(joint);
    SurfaceDef surface;
    surface.name = "plateau";
    surface.body = 1;
    base.scene.surfaces.push_back(surface);
    base.scene.layers.resize(1);
    base.scene.layers[0].pair.name = "tf";
    base.scene.layers[0].pair.surface_b = 0;
    for (const char* name : {"knee.flexion_deg", "knee.flexion.reaction_Nm", "ACL1.force_N", "ACL1.length_mm",
                             "ACL1.strain", "tf.force_x_N", "tf.area_mm2", "tf.max_pressure_MPa", "tf.plateau.x_mm"})
      base.poses.add_column(name);
    base.poses.set("knee.flexion_deg", 30.0);
    base.poses.set("knee.flexion.reaction_Nm", -2.0);
    base.poses.set("knee.x_mm", 5.0);
    base.poses.set("ACL1.force_N", 40.0);
    base.poses.set("ACL1.length_mm", 32.5);
    base.poses.set("tf.force_x_N", 7.0);
    base.poses.set("tf.area_mm2", 120.0);
    base.poses.set("tf.max_pressure_MPa", 1.5);
    base.poses.set("tf.plateau.x_mm", 12.0);
    run = base.run();
    const Vec3 nowhere = Vec3::Constant(kNone);
    run.contacts.push_back({"medial", "plateau", 0, 1, {nowhere, Vec3(0, 0.01, 0)}, {nowhere, Vec3(0, 0, -100)}});
  }
};

TEST(OpenSimTables, AnglesAreDegreesAndLengthsMetres) {
  const OpenSimCase c;
  const ResultTable t = opensim_motion(c.run, {{{0, 0}, "knee_flex_r"}, {{0, 3}, "knee_tx_r"}}, {1}, {0.25});
  EXPECT_EQ(t.columns(), (std::vector<std::string>{"time", "knee_flex_r", "knee_tx_r"}));
  ASSERT_EQ(t.rows(), 1u);
  EXPECT_EQ(t.number(0, "time"), 0.25);
  EXPECT_EQ(t.number(0, "knee_flex_r"), 30);
  EXPECT_DOUBLE_EQ(t.number(0, "knee_tx_r"), 0.005);
}

TEST(OpenSimTables, ForcesAreInSI) {
  const OpenSimCase c;
  const ResultTable t = opensim_forces(c.run, {{{0, 0}, "knee_flex_r"}}, {0, 1}, {0, 1});
  EXPECT_EQ(t.number(1, "ACL1.force_total"), 40);
  EXPECT_DOUBLE_EQ(t.number(1, "ACL1.length"), 0.0325);
  EXPECT_FALSE(t.has_column("ACL1.strain")) << "a column without any number is left out";
  EXPECT_EQ(t.number(1, "tf.contact_force_x"), 7);
  EXPECT_DOUBLE_EQ(t.number(1, "tf.contact_area"), 120e-6);
  EXPECT_DOUBLE_EQ(t.number(1, "tf.pressure_max"), 1.5e6);
  EXPECT_DOUBLE_EQ(t.number(1, "tf.center_of_pressure_x"), 0.012);
  EXPECT_EQ(t.number(1, "knee_flex_r_moment"), -2);
  EXPECT_FALSE(t.has_column("ACL1.length_mm"));
}

TEST(OpenSimTables, ARigidContactHasItsMomentAboutTheBodysOwnOrigin) {
  const OpenSimCase c;
  const ResultTable t = opensim_forces(c.run, {}, {0, 1}, {0, 1});
  EXPECT_EQ(t.number(0, "medial.contact_force_z"), 0) << "open";
  EXPECT_TRUE(std::isnan(t.number(0, "medial.center_of_pressure_x")));
  EXPECT_EQ(t.number(1, "medial.contact_force_z"), -100);
  // The pose's origin stands at (0.5, 0, 0) of the file's: the place is (0.5, 0.01, 0), and its cross product
  // with (0, 0, -100) is (-1, 50, 0).
  EXPECT_DOUBLE_EQ(t.number(1, "medial.center_of_pressure_x"), 0.5);
  EXPECT_DOUBLE_EQ(t.number(1, "medial.contact_moment_x"), -1);
  EXPECT_DOUBLE_EQ(t.number(1, "medial.contact_moment_y"), 50);
  EXPECT_DOUBLE_EQ(t.number(1, "medial.contact_moment_z"), 0);
}

}  // namespace
}  // namespace genu
