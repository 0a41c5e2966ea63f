// A drawn right knee under a joint that says what it is, and one that says otherwise.
#include "genu/study/anatomy_doubts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using ::testing::HasSubstr;

/// What is warned about a knee between the bones of meshes/leskovar2019 (x anterior, y superior, z lateral), turned to
/// stand along z.
std::string warned(const std::string& side, const std::string& proximal) {
  const test::TemporaryFolder folder;
  std::string text = fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.femur]
fixed = true
[body.tibia]
[joint.knee]
type = "free"
parent = "femur"
child = "tibia"
rotations = ["flexion x", "adduction y", "rotation z"]
translations = ["x", "y", "z"]
grood_suntay = {{ side = "{0}", femur = {{ body = "femur", proximal = "{1}", anterior = "x" }}, tibia = {{ body = "tibia", proximal = "{1}", anterior = "x" }} }}
[[step]]
prescribe = {{ "knee.flexion" = 0 }}
increments = 1
[contact.medial]
surfaces = ["femur", "tibia"]
model = "rigid"
)",
                                 side, proximal);
  for (const char* bone : {"femur", "tibia"})
    text += fmt::format(
        "[surface.{0}]\nbody = \"{0}\"\nshape = \"mesh\"\nfile = \"{1}/meshes/leskovar2019/{0}.stl\"\nunits = \"mm\"\n"
        "x_axis = [1, 0, 0]\nz_axis = [0, -1, 0]\n",
        bone, test::source_folder());
  Diagnostics out;
  const auto prepared = prepare(folder.write("scene.toml", text), out);
  EXPECT_TRUE(prepared);
  if (!prepared) return {};
  Diagnostics told;
  warn_about_anatomy(*prepared, told);
  EXPECT_FALSE(told.has_errors());
  std::string all;
  for (const Diagnostic& d : told.items()) all += to_string(d) + "\n";
  return all;
}

TEST(AnatomyDoubts, ARightKneeCalledRight) { EXPECT_EQ(warned("right", "z"), ""); }

TEST(AnatomyDoubts, ARightKneeCalledLeft) {
  EXPECT_THAT(warned("left", "z"),
              HasSubstr("joint.knee.grood_suntay: `side` is \"left\", and the bones look like a right"));
}

TEST(AnatomyDoubts, UpsideDown) { EXPECT_THAT(warned("right", "-z"), HasSubstr("femur lies below the tibia")); }

}  // namespace
}  // namespace genu
