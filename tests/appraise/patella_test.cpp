// What is said of a patella: from closed forms, where its contact surface does not lie in front of the femur's.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A patella like a ball against a femur like a bigger one, pulled to it from within; anterior is x, where it starts.
std::string all_said(double x) {
  const Solution s = test::solution_of(fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.femur]
fixed = true
[body.patella]
[joint.pf]
type = "free"
parent = "femur"
child = "patella"
rotations = ["flexion -z", "rotation x", "tilt y"]
translations = ["x", "y", "z"]
start = {{ x = {} }}
grood_suntay = {{ side = "right", femur = {{ body = "femur", proximal = "y", anterior = "x" }}, patella = {{ body = "patella", proximal = "y", anterior = "x" }} }}
[surface.condyles]
body = "femur"
shape = "sphere"
radius = 20
[surface.back]
body = "patella"
shape = "sphere"
radius = 10
[contact.pf_contact]
surfaces = ["condyles", "back"]
model = "rigid"
[ligament.tendon]
from = {{ body = "patella", point = [0, 0, 0] }}
to = {{ body = "femur", point = [{}, 0, 0] }}
law = "spring"
stiffness = 1
slack_length = 5
[[step]]
prescribe = {{ "pf.y" = 0, "pf.flexion" = 0, "pf.rotation" = 0, "pf.tilt" = 0 }}
)",
                                                   x, x > 0 ? 10 : -10));
  std::string out;
  for (const std::string& sentence : s.summary.verdict) out += sentence + "\n";
  return out;
}

TEST(Patella, InFrontOfTheFemurIsRight) { EXPECT_THAT(all_said(31), Not(HasSubstr("wrong side"))); }

TEST(Patella, BehindTheFemurIsNamed) {
  EXPECT_THAT(all_said(-31), HasSubstr("on the wrong side: 30 mm behind the middle of the femur's contact surface"));
}

}  // namespace
}  // namespace genu
