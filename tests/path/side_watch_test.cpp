#include "genu/path/side_watch.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/path/tolerances.h"
#include "support/crank_scene.h"
#include "support/scenes.h"
#include "support/solved.h"

namespace genu {
namespace {

constexpr double kRod = 10;  // mm

/// A crank that winds a cord over a rod or ball at its axis.
std::string wound(const std::string& shape, const std::string& wrap, const std::string& angles) {
  return test::crank_scene(R"([surface.rod]
body = "frame"
shape = ")" + shape + R"("
radius = 10
[ligament.cord]
from = { body = "frame", point = [-50, 12, 0] }
to = { body = "crank", point = [40, 5, 0] }
wrap = [)" + wrap + R"(]
law = "spring"
stiffness = 5
slack_length = 10
[[step]]
prescribe = { "hinge.angle" = [)" +
                           angles + R"(] }
increments = 13
)");
}

/// deg: where the way below the rod is shorter than 1 - kShorterShare times the way above it. Both have legs p and q;
/// their arcs a and b are what the legs leave of a full turn. `rest` (mm): of the path, beyond the crank's point.
double angle_of_event(double rest = 0) {
  const double from = std::hypot(50, 12), to = std::hypot(40, 5);
  const double legs = std::sqrt(from * from - kRod * kRod) + std::sqrt(to * to - kRod * kRod);
  const double hidden = std::acos(kRod / from) + std::acos(kRod / to), both = 2 * EIGEN_PI - 2 * hidden;
  const double above = (kShorterShare * (legs + rest) + kRod * both) / ((2 - kShorterShare) * kRod);
  return (std::atan2(12, -50) - hidden - above - std::atan2(5, 40)) / units::kDegree;
}

TEST(SideWatch, AnotherSideOfARodThatBecomesShorterIsAnEvent) {
  for (const std::string wrap : {"\"rod\"", "{ surface = \"rod\", side = \"shortest\" }"}) {
    const test::Followed f = test::follow(wound("cylinder", wrap, "0, -120"));
    ASSERT_TRUE(f.result.complete) << f.story();
    const auto events = f.of(PathEvent::Kind::wrap_side);
    ASSERT_EQ(events.size(), 1u) << f.story();
    EXPECT_EQ(events[0].what, "cord round rod: 1 % shorter round the other side");
    EXPECT_NEAR(events[0].target.prescribed[0].value / units::kDegree, angle_of_event(), 1e-6);
    // It keeps its own side.
    const Wraps& last = f.points.back().pose.state.wraps;
    EXPECT_GT(last[0].arc.begin.p.y(), 0);
  }
}

/// A second rod, on the crank, which the cord touches all the way: each surface has its other side for itself.
TEST(SideWatch, EachSurfaceOfAPathIsWatchedForItself) {
  const test::Followed f = test::follow(test::crank_scene(R"([surface.rod]
body = "frame"
shape = "cylinder"
radius = 10
[surface.rod2]
body = "crank"
shape = "cylinder"
radius = 10
origin = [60, -2, 0]
[ligament.cord]
from = { body = "frame", point = [-50, 12, 0] }
to = { body = "crank", point = [80, 5, 0] }
path = ["rod", { body = "crank", point = [40, 5, 0] }, "rod2"]
law = "spring"
stiffness = 5
slack_length = 10
[[step]]
prescribe = { "hinge.angle" = [0, -120] }
increments = 13
)"));
  ASSERT_TRUE(f.result.complete) << f.story();
  const double reach = std::hypot(20, 7),
               rest = 2 * std::sqrt(reach * reach - kRod * kRod) +
                      kRod * (EIGEN_PI - 2 * std::atan(7.0 / 20) - 2 * std::acos(kRod / reach));
  const auto events = f.of(PathEvent::Kind::wrap_side);
  ASSERT_EQ(events.size(), 1u) << f.story();
  EXPECT_EQ(events[0].what, "cord round rod: 1 % shorter round the other side");
  EXPECT_NEAR(events[0].target.prescribed[0].value / units::kDegree, angle_of_event(rest), 1e-6);
}

TEST(SideWatch, BackAndForthItIsAnEventEachTime) {
  const auto step = [](const char* angles) {
    return std::string("[[step]]\nprescribe = { \"hinge.angle\" = [") + angles + "] }\nincrements = 13\n";
  };
  const test::Followed f = test::follow(wound("cylinder", "\"rod\"", "0, -120") + step("-120, 0") + step("0, -120"));
  ASSERT_TRUE(f.result.complete) << f.story();
  EXPECT_EQ(f.of(PathEvent::Kind::wrap_side).size(), 2u) << f.story();
}

TEST(SideWatch, AGivenSideIsMeant) {
  const test::Followed f = test::follow(wound("cylinder", "{ surface = \"rod\", side = [0, 1, 0] }", "0, -120"));
  ASSERT_TRUE(f.result.complete) << f.story();
  EXPECT_TRUE(f.of(PathEvent::Kind::wrap_side).empty()) << f.story();
}

/// Round a ball all sides are one: the string slips round it, and no other one is a shortest one.
TEST(SideWatch, ABallHasNoOtherSide) {
  const test::Followed f = test::follow(wound("sphere", "\"rod\"", "0, -120"));
  EXPECT_FALSE(f.result.complete);
  EXPECT_TRUE(f.of(PathEvent::Kind::wrap_side).empty()) << f.story();
  EXPECT_EQ(f.of(PathEvent::Kind::slips_off).size(), 1u) << f.story();
}

TEST(SideWatch, WatchesPathsThatMayChoose) {
  EXPECT_EQ(SideWatch(test::scene_model(wound("cylinder", "\"rod\"", "0, -120")).model).count(), 1u);
  EXPECT_EQ(SideWatch(test::scene_model(wound("cylinder", "{ surface = \"rod\", side = [0, 1, 0] }", "0, -120")).model)
                .count(),
            0u);
}

}  // namespace
}  // namespace genu
