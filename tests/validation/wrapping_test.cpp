// Ligaments and cables that wrap, in whole scenes: closed forms, events, energy, and the judge.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/scene/reader.h"
#include "motion_scene.h"
#include "support/crank_scene.h"
#include "support/data.h"
#include "support/knee_scene.h"
#include "support/scenes.h"
#include "support/solved.h"

namespace genu {
namespace {

using test::table_of;

constexpr double kRadius = 10;  // mm

/// A crank that winds a cord over a rod at its axis.
std::string crank(const std::string& cord, const std::string& step) {
  return test::crank_scene(R"([surface.rod]
body = "frame"
shape = "cylinder"
radius = 10
)" + cord + "[[step]]\n" + step);
}

const std::string kCord = R"([ligament.cord]
from = { body = "frame", point = [-50, 12, 0] }
to = { body = "crank", point = [40, 5, 0] }
wrap = [{ surface = "rod", side = [0, 1, 0] }]
law = "spring"
stiffness = 5
slack_length = 80
)";

/// Length (mm) of a cord in the plane from (-50, 12) over the top of the rod to the crank's end at `angle` (deg).
double cord_length(double angle) {
  const double from_angle = std::atan2(12, -50), from = std::hypot(50, 12);
  const double to_angle = std::atan2(5, 40) + angle * units::kDegree, to = std::hypot(40, 5);
  const double wound = from_angle - std::acos(kRadius / from) - (to_angle + std::acos(kRadius / to));
  if (wound < 0) {
    const Vec3 a = from * Vec3(std::cos(from_angle), std::sin(from_angle), 0);
    return (to * Vec3(std::cos(to_angle), std::sin(to_angle), 0) - a).norm();
  }
  return std::sqrt(from * from - kRadius * kRadius) + std::sqrt(to * to - kRadius * kRadius) + kRadius * wound;
}

TEST(Wrapping, ACrankWindsItsCordOverARod) {
  const ResultTable t = table_of(crank(kCord, "prescribe = { \"hinge.angle\" = [40, -200] }\nincrements = 48\n"));
  ASSERT_EQ(t.rows(), 49u);
  int touching = 0;
  for (std::size_t row = 0; row < t.rows(); ++row) {
    const double angle = t.number(row, "hinge.angle_deg"), length = cord_length(angle);
    EXPECT_NEAR(t.number(row, "cord.length_mm"), length, 1e-10) << angle;
    EXPECT_NEAR(t.number(row, "cord.force_N"), 5 * (length - 80), 1e-9) << angle;
    touching += static_cast<int>(t.number(row, "cord.rod.touches"));
    if (t.number(row, "cord.rod.touches") == 0) continue;
    // Wound, the cord pulls at a lever of one radius.
    EXPECT_NEAR(std::abs(t.number(row, "hinge.angle.reaction_Nm")), 1e-3 * kRadius * t.number(row, "cord.force_N"),
                1e-11)
        << angle;
  }
  EXPECT_GT(touching, 30);
  EXPECT_LT(touching, 49);
}

TEST(Wrapping, TouchingIsAnEventAtTheSamePlaceFromEitherSide) {
  double at[2] = {0, 0};
  for (const bool back : {false, true}) {
    const auto s =
        test::scene_model(crank(kCord, fmt::format("prescribe = {{ \"hinge.angle\" = [{}] }}\nincrements = 7\n",
                                                   back ? "-60, 40" : "40, -60")));
    const test::Followed f = test::follow(s.model, plan_steps(s.scene));
    ASSERT_TRUE(f.result.complete) << f.story();
    test::expect_judged_ok(s, f.points);
    const auto events = f.of(back ? PathEvent::Kind::unwraps : PathEvent::Kind::wraps);
    ASSERT_EQ(events.size(), 1u) << f.story();
    EXPECT_EQ(events[0].what, "cord rod");
    at[back] = events[0].target.prescribed[0].value / units::kDegree;
  }
  EXPECT_NEAR(at[0], at[1], 1e-6);
  const double touch = at[0];
  EXPECT_NEAR(cord_length(touch - 1e-6), cord_length(touch + 1e-6), 1e-5);
}

TEST(Wrapping, EnergyRoundALoopIsTheWorkDone) {
  // The reaction of the angle, integrated over the way by Gauss' rule piece by piece, is the energy stored.
  const ResultTable t = table_of(crank(kCord, "prescribe = { \"hinge.angle\" = [-20, -140] }\nincrements = 120\n"));
  double work = 0;
  for (std::size_t row = 0; row + 2 < t.rows(); row += 2) {
    const auto moment = [&](std::size_t k) { return t.number(row + k, "hinge.angle.reaction_Nm"); };
    work += units::kDegree / 3 * (moment(0) + 4 * moment(1) + moment(2));
  }
  const auto energy = [&](std::size_t row) {
    const double stretch = 1e-3 * (t.number(row, "cord.length_mm") - 80);
    return 0.5 * 5e3 * stretch * stretch;
  };
  EXPECT_NEAR(std::abs(work), energy(t.rows() - 1) - energy(0), 1e-9);
}

/// A block hangs on a cord over a fixed pulley, held by a cable of constant tension on the other side.
TEST(Wrapping, ACableOverAPulleyCarriesAWeight) {
  const std::string scene = R"(format = 1
units = { length = "mm", angle = "deg" }
gravity = [0, -9.81, 0]
[body.frame]
fixed = true
[body.block]
mass = 2
[joint.free]
type = "free"
parent = "frame"
child = "block"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = { x = 30, y = -100 }
[surface.pulley]
body = "frame"
shape = "cylinder"
radius = 40
[load.cable]
from = { body = "frame", point = [-80, -60, 0] }
to = { body = "block", point = [0, 20, 0] }
wrap = [{ surface = "pulley", side = [0, 1, 0] }]
magnitude = 19.62
[ligament.spring]
from = { body = "frame", point = [40, -200, 0] }
to = { body = "block", point = [0, -20, 0] }
law = "spring"
stiffness = 0.2
slack_length = 50
[[step]]
prescribe = { "free.b" = 0 }
load = { cable = [1, 1.1] }
increments = 4
)";
  const ResultTable t = table_of(scene);
  ASSERT_EQ(t.rows(), 5u);
  for (std::size_t row = 0; row < t.rows(); ++row) {
    EXPECT_EQ(t.number(row, "cable.pulley.touches"), 1);
    EXPECT_NEAR(t.number(row, "free.x_mm"), 40, 1e-9) << "it hangs straight down from the pulley";
    // What the cable pulls beyond the weight stretches the spring.
    EXPECT_NEAR(t.number(row, "spring.force_N"), (t.number(row, "cable.factor") - 1) * 19.62, 1e-9);
  }
}

/// Over an egg a cord is held by its ends only: wound far enough, it slips off, and no pose beyond is called solved.
TEST(Wrapping, ACordSlipsOffAnEgg) {
  std::string scene = crank(kCord, "prescribe = { \"hinge.angle\" = [0, -120] }\nincrements = 12\n");
  const auto put = [&](const std::string& piece, const std::string& with) {
    scene.replace(scene.find(piece), piece.size(), with);
  };
  put("shape = \"cylinder\"\nradius = 10", "shape = \"ellipsoid\"\nradii = [12, 9, 15]");
  put("[40, 5, 0]", "[40, 5, -4]");
  put("[-50, 12, 0]", "[-50, 12, 5]");
  const auto s = test::scene_model(scene);
  const test::Followed f = test::follow(s.model, plan_steps(s.scene));
  EXPECT_FALSE(f.result.complete);
  const auto events = f.of(PathEvent::Kind::slips_off);
  ASSERT_EQ(events.size(), 1u) << f.story();
  EXPECT_EQ(events[0].what, "cord round rod");
  const double angle = events[0].target.prescribed[0].value / units::kDegree;
  std::printf("slips off at %.6f deg\n", angle);
  EXPECT_LT(angle, -30);
  EXPECT_GT(angle, -60);
}

/// A link swings on a cord that winds over a rod at its hinge and leaves it again: nothing dissipates.
TEST(Wrapping, ASwingOverARodKeepsItsEnergy) {
  const Solution s = test::motion_of(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.frame]
fixed = true
[body.link]
mass = 1
centre_of_mass = [20, 0, 0]
inertia = [1e-4, 1e-4, 1e-4, 0, 0, 0]
[joint.hinge]
type = "revolute"
parent = "frame"
child = "link"
axis = [0, 0, 1]
start = { angle = -60 }
[surface.rod]
body = "frame"
shape = "cylinder"
radius = 10
[ligament.cord]
from = { body = "frame", point = [-50, 12, 0] }
to = { body = "link", point = [40, 5, 4] }
wrap = [{ surface = "rod", side = [0, 1, 0] }]
law = "spring"
stiffness = 0.5
slack_length = 60
[dynamics]
duration = 0.5
output_interval = 0.01
tolerance = 1e-11
)");
  ASSERT_EQ(s.poses.rows(), 51u);
  int touching = 0;
  double worst = 0;
  for (std::size_t row = 0; row < s.poses.rows(); ++row) {
    touching += static_cast<int>(s.poses.number(row, "cord.rod.touches"));
    worst = std::max(worst, std::abs(s.poses.number(row, "energy.balance_J")));
  }
  std::printf("%d of 51 rows touch, energy to %.2g J\n", touching, worst);
  EXPECT_GT(touching, 5);
  EXPECT_LT(touching, 46);
  EXPECT_LT(worst, 1e-10);
  int events = 0;
  for (const PathEvent& e : s.events) events += e.kind == PathEvent::Kind::wraps || e.kind == PathEvent::Kind::unwraps;
  EXPECT_GE(events, 2);
}

/// The measured knee with 24 fibres wrapped, from extension to 90 deg.
TEST(Wrapping, TheMeasuredKneeBendsWithItsFibresWrapped) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  const Solution s = test::solution_of(
      test::replaced(test::read_text(test::source_folder() + "/meshes/lenhart2015/scene-wrapped.toml"),
                     "../../../shared/data/lenhart2015/", test::data_path("lenhart2015/")));
  EXPECT_EQ(s.summary.exit_code, kExitOk);
  ASSERT_EQ(s.poses.rows(), 91u);
  int wraps = 0, unwraps = 0;
  for (const PathEvent& e : s.events) {
    EXPECT_NE(e.kind, PathEvent::Kind::snapped) << e.what;
    wraps += e.kind == PathEvent::Kind::wraps;
    unwraps += e.kind == PathEvent::Kind::unwraps;
  }
  EXPECT_EQ(wraps, 2) << "two posterior fibres come onto the edge of the tibia";
  EXPECT_EQ(unwraps, 8) << "the capsule leaves the condyles";
}

}  // namespace
}  // namespace genu
