// The judge accepts what the solver finds, and rejects it with any one number of it changed.
#include "genu/judge/judge.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrupted.h"
#include "support/data.h"
#include "support/places.h"
#include "support/published_knee.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using test::Corrupted;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

std::string knee_file(const std::string& name) { return genu::test::source_folder() + "/meshes/" + name; }

const Corrupted& dortmans() {
  static const Corrupted run = Corrupted::of(knee_file("dortmans1984/scene.toml"));
  return run;
}

constexpr std::size_t kRow = 30;

TEST(Judge, AcceptsTheKneesInClosedForm) {
  EXPECT_THAT(dortmans().rejections(), IsEmpty()) << to_text(dortmans().judge());
  EXPECT_EQ(dortmans().judge().judged, 71u);
  for (const char* knee : {"dortmans1984/scene-moment.toml", "leskovar2019/scene.toml"}) {
    const Corrupted run = Corrupted::of(knee_file(knee));
    EXPECT_THAT(run.rejections(), IsEmpty()) << knee << "\n" << to_text(run.judge());
  }
}

TEST(Judge, RejectsAPoseThatIsOffByAHundredNanometres) {
  Corrupted run = dortmans();
  EXPECT_THAT(run.add(kRow, "knee.x_mm", 1e-4).rejections(), Contains("balance of forces"));
  Corrupted turned = dortmans();
  EXPECT_THAT(turned.add(kRow, "knee.rotation_deg", 1e-6).rejections(), Not(IsEmpty()));
}

TEST(Judge, RejectsAContactForceThatIsOffByAMicronewton) {
  Corrupted run = dortmans();
  run.add(kRow, "medial.force_N", 1e-6);
  const judge::Judgement found = run.judge();
  EXPECT_EQ(found.rejected(), 1u);
  EXPECT_THAT(run.rejections(), Contains("balance of forces"));
}

TEST(Judge, RejectsAWrongLigament) {
  for (const char* column : {"LC.force_N", "LC.length_mm", "LC.strain"}) {
    Corrupted run = dortmans();
    EXPECT_THAT(run.add(kRow, column, 1e-7).rejections(), Not(IsEmpty())) << column;
  }
}

TEST(Judge, RejectsAReactionOfTheWrongSign) {
  Corrupted run = dortmans();
  run.cell(kRow, "knee.flexion.reaction_Nm") = fmt::format("{:.17g}", -run.number(kRow, "knee.flexion.reaction_Nm"));
  EXPECT_THAT(run.rejections(), Contains("balance of moments"));
}

TEST(Judge, RejectsSwappedColumns) {
  Corrupted run = dortmans();
  for (std::size_t row = 0; row < run.rows(); ++row) std::swap(run.cell(row, "knee.x_mm"), run.cell(row, "knee.y_mm"));
  EXPECT_EQ(run.judge().rejected(), run.rows());
  Corrupted points = dortmans();
  std::swap(points.cell(kRow, "medial.femur_medial.x_mm"), points.cell(kRow, "medial.femur_medial.z_mm"));
  EXPECT_THAT(points.rejections(), Contains("contact points on surfaces"));
}

TEST(Judge, RejectsAPrescribedValueThatWasNotAskedFor) {
  Corrupted run = dortmans();
  EXPECT_THAT(run.add(kRow, "knee.flexion_deg", 1e-6).rejections(), Contains("prescribed values"));
}

TEST(Judge, RejectsRowsOutOfTheirOrderAndResidualsThatSolveNothing) {
  constexpr const char* kCheck = "rows follow the steps";
  Corrupted swapped = dortmans();
  EXPECT_THAT(swapped.swap_rows(3, 4).rejections(), Contains(kCheck));
  for (const char* step : {"7", "0", "1.5", ""}) {
    Corrupted run = dortmans();
    run.cell(kRow, "step") = step;
    EXPECT_THAT(run.rejections(), Contains(kCheck)) << step;
  }
  for (const char* increment : {"30.5", "71", "-1", ""}) {
    Corrupted run = dortmans();
    run.cell(kRow, "increment") = increment;
    EXPECT_THAT(run.rejections(), Contains(kCheck)) << increment;
  }
  for (const char* residual : {"1e9", "1e-7", "-1e-3", ""}) {
    Corrupted run = dortmans();
    run.cell(kRow, "residual") = residual;
    EXPECT_THAT(run.rejections(), Contains("residuals")) << residual;
  }
}

TEST(Judge, RejectsWhatIsNoCountAndWhatStandsWhereNothingShould) {
  for (const char* iterations : {"-3", "2.5", ""}) {
    Corrupted run = dortmans();
    run.cell(kRow, "newton.iterations") = iterations;
    EXPECT_THAT(run.rejections(), Contains("iterations")) << iterations;
  }
  Corrupted torn = dortmans();
  torn.cell(kRow, "medial.femur_medial.y_mm") = "";
  EXPECT_THAT(torn.rejections(), Contains("contact points"));
}

/// A body with a surface `round` above a floor, between springs that hold its origin 13 mm above it.
Corrupted held_above(const std::string& round) {
  const test::TemporaryFolder folder;
  return Corrupted::of(folder.write("scene.toml", R"(format = 1
units = { length = "mm", angle = "deg" }
[body.floor]
fixed = true
[body.ball]
[joint.j]
type = "free"
parent = "floor"
child = "ball"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
start = { z = 13 }
[surface.flat]
body = "floor"
shape = "plane"
[contact.foot]
surfaces = ["round", "flat"]
model = "rigid"
[ligament.up]
from = { body = "ball", point = [0, 0, 0] }
to = { body = "floor", point = [0, 0, 33] }
law = "spring"
stiffness = 5
slack_length = 10
[ligament.down]
from = { body = "ball", point = [0, 0, 0] }
to = { body = "floor", point = [0, 0, -7] }
law = "spring"
stiffness = 5
slack_length = 10
[[step]]
prescribe = { "j.a" = 0, "j.b" = 0, "j.c" = 0 }
)" + ("[surface.round]\nbody = \"ball\"\n" + round)));
}

TEST(Judge, RejectsAGapThatNothingElseTellsOf) {
  // No contact: its cells are empty but for the gap.
  const Corrupted run = held_above("shape = \"sphere\"\nradius = 10\n");
  EXPECT_THAT(run.rejections(), IsEmpty()) << to_text(run.judge());
  for (const double gap : {-5.0, -1e-3, 1.0, 4.0}) {
    Corrupted changed = run;
    ASSERT_EQ(changed.cell(0, "foot.force_N"), "0");
    EXPECT_NEAR(changed.number(0, "foot.gap_mm"), 3, 1e-9);
    changed.cell(0, "foot.gap_mm") = fmt::format("{:.17g}", gap);
    EXPECT_THAT(changed.rejections(), Not(IsEmpty())) << gap;
  }
  Corrupted filled = run;
  filled.cell(0, "foot.round.x_mm") = "1";
  EXPECT_THAT(filled.rejections(), Contains("contact points"));
}

TEST(Judge, AGapAtARimIsKnownAsWellAsTheRimIsSampledHoweverNearlyTheNormalsOppose) {
  const std::string dish =
      "shape = \"polynomial\"\norigin = [0, 0, -10]\nz_axis = [0, 0, -1]\n"
      "terms = [[2, 0, -0.02], [0, 1, 0.0308], [0, 2, -0.02]]\npatch = { x = [0.03, 8], y = [-5, 4.3] }\n";
  Corrupted run = held_above(dish);
  EXPECT_THAT(run.rejections(), IsEmpty()) << to_text(run.judge());
  EXPECT_NEAR(run.number(0, "foot.gap_mm"), 3 - 0.0308 * 0.0308 / 0.08, 1e-3) << run.number(0, "foot.gap_mm");
  run.cell(0, "foot.gap_mm") = "3.2";
  EXPECT_THAT(run.rejections(), Contains("smallest gap is the smallest"));
}

TEST(Judge, RejectsContactsThatPull) {
  // Both forces of a balanced pose turned round, and the load that asks for it: nothing but their sign is wrong.
  Corrupted run = dortmans();
  run.cell(kRow, "medial.force_N") = fmt::format("{:.17g}", -run.number(kRow, "medial.force_N"));
  EXPECT_THAT(run.rejections(), Contains("contact forces press"));
}

TEST(Judge, RejectsOverlapElsewhere) {
  // A ball on the tibia where the femur comes by, said to be 1 mm away: forces and contacts are all as they were.
  Corrupted run = dortmans();
  EXPECT_THAT(run.rejections(), IsEmpty());
  SurfaceDef ball;
  ball.name = "ball";
  ball.body = run.scene().surfaces[1].body;
  ball.shape = SurfaceDef::Shape::sphere;
  ball.radius = 0.004;
  ball.placement.p = Vec3(-0.023, 0.001, 0.0038);
  run.scene().surfaces.push_back(ball);
  run.scene().surfaces[1] = ball;
  run.scene().surfaces[1].name = "tibia_medial";
  EXPECT_THAT(run.rejections(), Contains("no overlap anywhere"));
}

TEST(Judge, SaysWhatItDoesNotJudge) {
  Corrupted run = dortmans();
  run.cell(3, "status") = "no_equilibrium";
  const judge::Judgement found = run.judge();
  EXPECT_EQ(found.judged, run.rows() - 1);
  ASSERT_EQ(found.not_ok.size(), 1u);
  EXPECT_EQ(found.not_ok[0], (std::pair<std::size_t, std::string>(3, "no_equilibrium")));
  EXPECT_THAT(found.not_judged, Contains(::testing::HasSubstr("stability")));
  EXPECT_THAT(to_text(found), ::testing::HasSubstr("row 4, whose status is \"no_equilibrium\""));
}

TEST(Judge, RejectsAMotionThatDoesNotFollowFromItsForces) {
  const Corrupted good = Corrupted::of(knee_file("leskovar2019/scene.toml"));
  constexpr std::size_t kLater = 500;
  Corrupted moved = good;
  EXPECT_THAT(moved.add(kLater, "j1.angle_deg", 1e-3).rejections(), Not(IsEmpty()));
  Corrupted faster = good;
  EXPECT_THAT(faster.add(kLater, "j1.angle_velocity_deg_s", 1e-2).rejections(), Not(IsEmpty()));
  Corrupted held = good;
  EXPECT_THAT(held.add(kLater, "j1.reaction.force_x_N", 1e-3).rejections(), Contains("balance of forces"));
}

TEST(Judge, JudgesMeasuredCartilageByItsOwnRays) {
  GENU_NEEDS_DATA("lenhart2015");
  Diagnostics out;
  const std::string scene = testing::TempDir() + "judged_cartilage.toml";
  std::ofstream(scene) << test::published_scene(test::data_path("lenhart2015/ACLC01-R-femur-cart.stl"));
  Corrupted run = Corrupted::of(scene);
  EXPECT_THAT(run.rejections(), IsEmpty()) << to_text(run.judge());
  for (const char* column :
       {"tf.force_x_N", "tf.moment_y_Nm", "tf.area_mm2", "tf.max_pressure_MPa", "tf.max_depth_mm"}) {
    Corrupted changed = run;
    changed.add(1, column, 1e-3);
    EXPECT_THAT(changed.rejections(), Not(IsEmpty())) << column;
  }
}

TEST(Judge, IsTheSameOnEveryRun) { EXPECT_EQ(to_json(dortmans().judge()), to_json(dortmans().judge())); }

}  // namespace
}  // namespace genu
