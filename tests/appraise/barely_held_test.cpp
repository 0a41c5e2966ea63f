// A ball in a socket that a spring holds, and as it would be with hardly any stiffness.
#include "genu/appraise/barely_held.h"

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

TEST_F(BarelyHeld, WhereTheErrorOfALayerMayBeAllThatHolds) {
  // 10 times the tolerance of 1e-4, 100 N, a size of centimetres: some mJ.
  for (PoseRecord& r : found_.records) r.point.stability.smallest = -1e-4;
  ASSERT_EQ(sentences().size(), 1U);
  EXPECT_THAT(sentences()[0], AllOf(StartsWith("3 of 3 poses are barely held, the first at j.a = 5.73 deg"),
                                    HasSubstr("a motion of j.c meets")));
  for (PoseRecord& r : found_.records) r.point.stability.smallest = 0.1;
  EXPECT_TRUE(sentences().empty());
}

TEST_F(BarelyHeld, NotOnePoseAloneNorWhatIsCalledNeutral) {
  found_.records[1].point.stability.smallest = 1e-4;
  EXPECT_TRUE(sentences().empty());
  for (PoseRecord& r : found_.records) {
    r.point.stability.smallest = 0;
    r.point.stability.verdict = Stability::Verdict::neutral;
  }
  EXPECT_TRUE(sentences().empty());
}

}  // namespace
}  // namespace genu
