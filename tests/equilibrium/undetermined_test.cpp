// What is free or shared is named; what conforms is held as conforming surfaces hold.
#include "genu/equilibrium/undetermined.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::load;
using test::step;
using test::surface;

std::string ball_on_floor(const std::string& prescribe) {
  return bone_on_ground("{ z = 20 }") + surface("ball", "bone", "sphere", "radius = 20") +
         surface("floor", "ground", "plane") + contact("foot", "ball", "floor") +
         test::spring("s", "[0, 0, 0]", "[30, 0, 20]", 5, 0) + test::spring("t", "[0, 0, 0]", "[-30, 0, 20]", 5, 0) +
         load("weight", "force = [0, 0, -100]") + step("prescribe = { " + prescribe + " }\nload = { weight = 1 }");
}

TEST(Undetermined, APrescribedHeightSharesTheLoadWithTheFloor) {
  const auto w = test::follow(ball_on_floor(test::kNoTurn + ", \"j.z\" = 20"));
  ASSERT_FALSE(w.points.empty());
  EXPECT_EQ(w.points[0].report.status, PoseStatus::undetermined) << w.story();
  EXPECT_FALSE(w.result.complete);
  const Undetermined& u = w.points[0].undetermined;
  ASSERT_EQ(u.shared_reactions.size(), 1u);
  EXPECT_EQ(u.shared_reactions[0].first.index, 5);
  EXPECT_EQ(u.shared_contacts, std::vector<int>{0});
  EXPECT_TRUE(u.free_motion.empty());
}

TEST(Undetermined, AForceThatIsDeterminedIsNot) {
  const auto w = test::follow(ball_on_floor(test::kNoTurn));
  EXPECT_TRUE(w.result.complete) << w.story();
  EXPECT_TRUE(w.points.at(0).undetermined.none());
}

TEST(Undetermined, TheSpinThatCostsNothingIsNamed) {
  const auto w = test::follow(ball_on_floor("\"j.a\" = 0, \"j.b\" = 0"));
  ASSERT_FALSE(w.points.empty());
  EXPECT_EQ(w.points[0].report.status, PoseStatus::undetermined) << w.story();
  const auto& free = w.points[0].undetermined.free_motion;
  ASSERT_EQ(free.size(), 1u);
  EXPECT_EQ(free[0].index, 2);  // about z
}

TEST(Undetermined, ABallThatRollsIsNoPoseWhereverItFellFrom) {
  // Nothing but its weight: all five motions that are left cost nothing, to rounding where it fell from above.
  for (const char* z : {"20", "20.5", "23"}) {
    const auto w = test::follow(bone_on_ground(std::string("{ z = ") + z + " }") +
                                surface("ball", "bone", "sphere", "radius = 20") + surface("floor", "ground", "plane") +
                                contact("c", "ball", "floor") + load("press", "force = [0, 0, -100]") + step(""));
    ASSERT_FALSE(w.points.empty());
    EXPECT_EQ(w.points[0].report.status, PoseStatus::undetermined) << z << w.story();
    const auto& free = w.points[0].undetermined.free_motion;
    ASSERT_EQ(free.size(), 5u) << z << ": all but the height";
    for (int i = 0; i < 5; ++i) EXPECT_EQ(free[static_cast<std::size_t>(i)].index, i) << z;
  }
}

TEST(Undetermined, ABodyThatNothingHoldsIsFreeAltogether) {
  // No contact, nothing prescribed, and the one ligament slack.
  const auto w = test::follow(
      bone_on_ground("{ z = 10 }") +
      test::ligament("l", "[0, 0, 0]", "[0, 0, -10]", "law = \"quadratic\"\nstiffness = 100\nslack_length = 30") +
      step(""));
  ASSERT_FALSE(w.points.empty());
  EXPECT_EQ(w.points[0].report.status, PoseStatus::undetermined) << w.story();
  EXPECT_EQ(w.points[0].undetermined.free_motion.size(), 6u);
}

TEST(Undetermined, ABallThatFillsItsSocketCannotMove) {
  const std::string socket = bone_on_ground() + surface("ball", "bone", "sphere", "radius = 20") +
                             surface("cup", "ground", "sphere", "radius = 20\ninside = true") +
                             contact("c", "ball", "cup") + load("press", "force = [10, 0, -100]") +
                             step("prescribe = { " + test::kNoTurn + " }");
  const auto w = test::follow(socket);
  ASSERT_TRUE(w.result.complete) << w.story();
  EXPECT_EQ(w.points[0].stability.free_motions, 0);
  EXPECT_EQ(w.points[0].stability.verdict, Stability::Verdict::stable);
  EXPECT_NEAR(w.points[0].pose.state.contacts.at(0).force, std::hypot(10, 100), 1e-6);
}

TEST(Undetermined, ABallFallsThroughTheClearanceToWhereItsLoadPresses) {
  const std::string socket = bone_on_ground() + surface("ball", "bone", "sphere", "radius = 19") +
                             surface("cup", "ground", "sphere", "radius = 20\ninside = true") +
                             contact("c", "ball", "cup") + load("press", "force = [10, 0, -100]") +
                             step("prescribe = { " + test::kNoTurn + " }");
  const auto w = test::follow(socket);
  ASSERT_TRUE(w.result.complete) << w.story();
  const Vec3 expected = 1e-3 * Vec3(10, 0, -100).normalized();
  EXPECT_LT((w.points[0].pose.state.poses[1].p - expected).norm(), 1e-11);
}

}  // namespace
}  // namespace genu
