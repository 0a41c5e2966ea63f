// The judge accepts paths that wrap as the solver finds them, and rejects them with a number changed.
#include "genu/judge/wrapping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrupted.h"
#include "support/crank_scene.h"
#include "support/scenes.h"

namespace genu {
namespace {

using test::Corrupted;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

/// A crank whose cord winds over an egg.
const std::string kScene = test::crank_scene(R"([surface.egg]
body = "frame"
shape = "ellipsoid"
radii = [12, 9, 15]
[ligament.cord]
from = { body = "frame", point = [-50, 12, 5] }
to = { body = "crank", point = [40, 5, -4] }
wrap = [{ surface = "egg", side = [0, 1, 0] }]
law = "linear"
stiffness = 800
reference_strain = 0.05
[[step]]
prescribe = { "hinge.angle" = [20, -35] }
increments = 10
)");

const Corrupted& cranked() {
  static const Corrupted run = [] {
    Diagnostics out;
    const auto scene = parse_scene(kScene, "scene.toml", out);
    EXPECT_TRUE(scene.has_value());
    return Corrupted(*scene, test::solved(*scene).poses.to_csv());
  }();
  return run;
}

constexpr std::size_t kTouching = 8, kFree = 0;

TEST(JudgeWrapping, AcceptsWhatTheSolverFinds) {
  EXPECT_THAT(cranked().rejections(), IsEmpty()) << to_text(cranked().judge());
  Corrupted run = cranked();
  EXPECT_EQ(run.number(kTouching, "cord.egg.touches"), 1);
  EXPECT_EQ(run.number(kFree, "cord.egg.touches"), 0);
}

TEST(JudgeWrapping, RejectsAnyNumberThatIsOff) {
  for (const char* column : {"cord.length_mm", "cord.force_N", "cord.strain", "cord.egg.arc_mm"}) {
    Corrupted run = cranked();
    EXPECT_THAT(run.add(kTouching, column, 1e-4).rejections(), Not(IsEmpty())) << column;
  }
  for (const char* column : {"cord.egg.begin.x_mm", "cord.egg.begin.z_mm", "cord.egg.end.y_mm"}) {
    Corrupted run = cranked();
    EXPECT_THAT(run.add(kTouching, column, 1e-3).rejections(), Not(IsEmpty())) << column;
  }
}

TEST(JudgeWrapping, RejectsALineThroughTheSurface) {
  Corrupted run = cranked();
  run.cell(kTouching, "cord.egg.touches") = "0";
  run.cell(kTouching, "cord.egg.arc_mm") = "0";
  EXPECT_THAT(run.rejections(), Contains("free lines clear surfaces"));
}

}  // namespace
}  // namespace genu
