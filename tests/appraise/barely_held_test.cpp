// A ball in a socket that a spring holds, and as it would be with hardly any stiffness.
#include "genu/appraise/barely_held.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/places.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A ball of 24 mm pressed with 100 N into a socket of 25 mm, with one angle prescribed and a spring for the others.
class BarelyHeld : public ::testing::Test {
 protected:
  BarelyHeld() {
    const std::string spring =
        "[ligament.s]\nlaw = \"spring\"\nfrom = { body = \"bone\", point = [0, 20, 0] }\nto = { body = \"ground\", "
        "point = [2, 40, 0] }\nstiffness = 5\nslack_length = 18\n";
    const std::string text =
        test::bone_on_ground("{ z = 1.2 }") + test::surface("head", "bone", "sphere", "radius = 24") +
        test::surface("cup", "ground", "sphere", "radius = 25\ninside = true") +
        test::layer("hip", "head", "cup", "quadrature = \"smooth\"") + test::load("up", "force = [0, 0, 100]") +
        spring + test::step("prescribe = { \"j.a\" = [0.1, 0.17], \"j.b\" = 0 }\nincrements = 2");
    Diagnostics out;
    prepared_ = prepare(*parse_scene(text, "scene.toml", out), std::make_shared<MeshLibrary>(), out);
    ContactField field(prepared_->model);
    found_ = solve(*prepared_, field, {});
  }
  std::vector<std::string> sentences() const { return barely_held_sentences(*prepared_, found_.records, found_.poses); }

  std::optional<Prepared> prepared_;
  Solution found_;
};

TEST_F(BarelyHeld, NotWhatASpringHolds) {
  EXPECT_EQ(found_.summary.exit_code, kExitOk) << found_.summary.verdict[0];
  EXPECT_TRUE(sentences().empty());
}

TEST_F(BarelyHeld, NotWhatFarOriginsAloneMakeSoft) {
  for (PoseRecord& r : found_.records) r.point.stability.smallest = 1e-7;
  EXPECT_TRUE(sentences().empty());
}

/// The same hip with three ligaments that are slack at this pose.
TEST(BarelyHeldHip, WhereLigamentsAreSlack) {
  const auto ligament = [](const char* name, const char* from, const char* to) {
    return fmt::format(
        "[ligament.{}]\nfrom = {{ body = \"pelvis\", point = {} }}\nto = {{ body = \"femur\", point = {} }}\nlaw = "
        "\"blankevoort\"\nstiffness = 4000\ntransition_strain = 0.06\nreference_strain = 0.02\n",
        name, from, to);
  };
  const RunSummary s =
      test::solution_of(
          R"(format = 1
units = { length = "mm", angle = "deg" }
[body.pelvis]
fixed = true
[body.femur]
[joint.hip]
type = "free"
parent = "pelvis"
child = "femur"
rotations = ["flexion z", "adduction x", "rotation y"]
translations = ["x", "y", "z"]
start = { flexion = 30, adduction = 2, rotation = -28 }
[contact.hip]
surfaces = ["head", "cup"]
model = "cartilage"
modulus = 10
poisson = 0.45
thickness = 4
)" + test::surface("head", "femur", "sphere", "radius = 24") +
          test::surface("cup", "pelvis", "sphere", "radius = 25\ninside = true") +
          ligament("iliofemoral", "[20, 30, 10]", "[15, -30, 30]") +
          ligament("ischiofemoral", "[-25, -5, -5]", "[-10, -20, 30]") +
          ligament("pubofemoral", "[20, -15, -20]", "[5, -35, 20]") +
          "[load.weight]\nbody = \"femur\"\nforce = [0, -700, 0]\n[[step]]\nprescribe = { \"hip.flexion\" = 30 "
          "}\nincrements = 1\n")
          .summary;
  EXPECT_EQ(s.exit_code, kExitDoubtful);
  EXPECT_THAT(s.verdict[0], AllOf(StartsWith("Solved, but 2 of 2 poses are barely held, the first at hip.flexion = 30"),
                                  HasSubstr("would move hip.adduction and hip.rotation by 10 deg")));
}

}  // namespace
}  // namespace genu
