// A sheet that is open to the other side holds a body that starts in front of it, wherever that is.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/scenes.h"

namespace genu {
namespace {

/// A ball of 5 mm that springs pull down from `height` onto a sheet; without it the ball hangs at z = -8.3 mm.
std::string scene(const std::string& sheet, double height) {
  std::string text = fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.base]
fixed = true
[body.ball]
[joint.j]
type = "free"
parent = "base"
child = "ball"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
reference = {{ z = 5.5 }}
start = {{ z = {} }}
[surface.ball]
body = "ball"
shape = "sphere"
radius = 5
[surface.sheet]
body = "base"
{}
[contact.c]
surfaces = ["ball", "sheet"]
model = "rigid"
[ligament.down]
from = {{ body = "ball", point = [0, 0, -4] }}
to = {{ body = "base", point = [0, 0, -40] }}
law = "spring"
stiffness = 2
slack_length = 20
[[step]]
prescribe = {{}}
)",
                                 height, sheet);
  const char* sides[][2] = {{"4, 0", "40, 0"}, {"-4, 0", "-40, 0"}, {"0, 4", "0, 40"}, {"0, -4", "0, -40"}};
  for (int k = 0; k < 4; ++k)
    text += fmt::format(
        "[ligament.s{}]\nfrom = {{ body = \"ball\", point = [{}, 0] }}\nto = {{ body = \"base\", point = [{}, 0] }}\n"
        "law = \"spring\"\nstiffness = 1\nslack_length = 20\n",
        k, sides[k][0], sides[k][1]);
  return text;
}

TEST(ThinSurfaces, HoldWhatStartsInFrontOfThem) {
  const char* sheets[] = {"shape = \"plane\"\npatch = { x = [-25, 25], y = [-25, 25] }",
                          "shape = \"polynomial\"\nterms = [[2, 0, 0.01], [0, 2, 0.01]]\npatch = { x = [-25, 25], y = "
                          "[-25, 25] }"};
  for (const char* sheet : sheets)
    for (const double height : {5.1, 5.5, 7.0, 9.0, 20.0}) {
      const ResultTable t = test::table_of(scene(sheet, height));
      ASSERT_GT(t.rows(), 0u);
      EXPECT_NEAR(t.number(0, "j.z_mm"), 5, 1e-9) << sheet << " from " << height;
      EXPECT_GT(t.number(0, "c.force_N"), 10) << sheet << " from " << height;
    }
}

TEST(ThinSurfaces, HoldABallThatOneSpringAlonePullsFromAfar) {
  // Only a foundation much stiffer than the first one to be tried keeps it above.
  std::string text = scene(
      "shape = \"polynomial\"\nterms = [[2, 0, 0.01], [0, 2, 0.01]]\npatch = { x = [-25, 25], y = "
      "[-25, 25] }",
      5.5);
  text = text.substr(0, text.find("[[step]]"));  // and without the four springs that follow
  const ResultTable t = test::table_of(text + "[[step]]\nprescribe = { \"j.c\" = 0 }\n");
  ASSERT_GT(t.rows(), 0u);
  EXPECT_NEAR(t.number(0, "j.z_mm"), 5, 1e-9);
  EXPECT_NEAR(t.number(0, "c.force_N"), 42, 1e-9);  // 2 N/mm on a spring of 41 mm that rests at 20 mm
}

TEST(ThinSurfaces, WhatStartsBehindIsInsideAndRefused) {
  const test::TemporaryFolder folder;
  for (const double height : {-7.0, -15.0, -40.0}) {
    const std::string file =
        folder.write("scene.toml", scene("shape = \"plane\"\npatch = { x = [-25, 25], y = [-25, 25] }", height));
    Diagnostics out;
    EXPECT_EQ(run_scene(file, folder / "out", {}, out, nullptr), kExitRefused) << height;
    EXPECT_NE(test::messages(out).find("surfaces overlap by"), std::string::npos) << test::messages(out);
  }
}

}  // namespace
}  // namespace genu
