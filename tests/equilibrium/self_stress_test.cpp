// Stools on four feet: a load over the inside of their hull is shared in many ways, one over its rim in one way only.
#include "genu/equilibrium/self_stress.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::load;
using test::spring;
using test::step;
using test::surface;

std::string vec(const Vec3& x) {
  return "[" + std::to_string(x.x()) + ", " + std::to_string(x.y()) + ", " + std::to_string(x.z()) + "]";
}

/// Feet at `feet` (mm), all of 5 mm, and 40 N down at `where`; springs keep it from sliding.
std::string stool(const std::vector<Vec3>& feet, const Vec3& where) {
  std::string out = bone_on_ground("{ z = 5 }") + surface("floor", "ground", "plane");
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const std::string k = std::to_string(i);
    out += surface("foot" + k, "bone", "sphere", "radius = 5\norigin = " + vec(feet[i])) +
           contact("c" + k, "foot" + k, "floor");
  }
  return out + spring("hold", "[0, 0, 0]", "[0, 0, 5]", 0.1, 0) + spring("turn", "[30, 0, 0]", "[30, 0, 5]", 0.1, 0) +
         load("w", "force = [0, 0, -40]\npoint = " + vec(where)) + step("load = { w = 1 }");
}

/// One foot in each quadrant, so that all are corners of their hull or one lies inside: either way no three are in
/// line.
std::vector<Vec3> random_feet(std::mt19937& random) {
  std::uniform_real_distribution<double> far(12, 25), turn(0.2, 1.3);
  std::vector<Vec3> out;
  for (int i = 0; i < 4; ++i) {
    const double angle = i * M_PI / 2 + turn(random), distance = far(random);
    out.emplace_back(distance * std::cos(angle), distance * std::sin(angle), 0);
  }
  return out;
}

TEST(SelfStress, FourFeetShareALoadInManyWaysWhereverItStands) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.05, 1);
  for (int draw = 0; draw < 60; ++draw) {
    const auto feet = random_feet(random);
    Vec3 where = Vec3::Zero();
    double sum = 0;
    for (const Vec3& foot : feet) {
      const double p = std::pow(part(random), 3);  // near corners too
      where += p * foot;
      sum += p;
    }
    const auto w = test::follow(stool(feet, where / sum));
    ASSERT_FALSE(w.points.empty());
    EXPECT_EQ(w.points[0].report.status, PoseStatus::undetermined) << draw << w.story();
    EXPECT_EQ(w.points[0].undetermined.shared_contacts.size(), 4u) << draw;
    EXPECT_EQ(w.points[0].pose.state.contacts.size(), 4u) << draw;
  }
}

TEST(SelfStress, OverTheLineBetweenTwoNeighboursOnlyTheyCarry) {
  const std::vector<Vec3> feet = {{20, 20, 0}, {-20, 20, 0}, {-20, -20, 0}, {20, -20, 0}};
  for (const double y : {-20.0, -15.0, 0.0, 10.0, 20.0}) {
    const auto w = test::follow(stool(feet, {-20, y, 0}));
    EXPECT_TRUE(w.result.complete) << y << w.story();
  }
}

TEST(SelfStress, ThreeFeetLeaveNoChoice) {
  const auto w = test::follow(stool({{20, 20, 0}, {-20, 20, 0}, {-20, -20, 0}}, {-14, 10, 0}));
  EXPECT_TRUE(w.result.complete) << w.story();
}

TEST(SelfStress, AFootThatDoesNotReachTheFloorHasNoPart) {
  const auto w = test::follow(stool({{20, 20, 0}, {-20, 20, 0}, {-20, -20, 0}, {20, -20, 1e-5}}, {-14, 10, 0}));
  EXPECT_TRUE(w.result.complete) << w.story();
  ASSERT_EQ(w.points.at(0).pose.state.contacts.size(), 3u);
  double largest = 0;
  for (const ActiveContact& c : w.points[0].pose.state.contacts) largest = std::max(largest, c.force);
  EXPECT_NEAR(largest, 24, 1e-4);
}

/// Strands upright at `places` (mm), each at its jump from 2.25 to 7.5 N, that carry `load_N` together at x = `at`;
/// springs keep the rest.
std::string hung_on(const std::vector<double>& places, double load_N, double at = 0) {
  std::string out = bone_on_ground();
  for (std::size_t i = 0; i < places.size(); ++i)
    out += test::ligament("t" + std::to_string(i), vec({places[i], 0, 0}), vec({places[i], 0, 31.5}),
                          "law = \"abdel-rahman\"\nstiffness = 10\ntoe_stiffness = 1\ntransition_strain = 0.05\n"
                          "slack_length = 30");
  return out + spring("x", "[0, 0, 20]", "[50, 0, 20]", 0.1, 50) + spring("y", "[0, 0, -20]", "[0, 50, -20]", 0.1, 50) +
         spring("c", "[0, 20, -20]", "[50, 20, -20]", 0.1, 50) +
         load("w", "force = [0, 0, " + std::to_string(-load_N) + "]\npoint = " + vec({at, 0, 0})) +
         step("prescribe = { \"j.a\" = 0 }\nload = { w = 1 }");
}

TEST(SelfStress, ThreeStrandsAtTheirJumpsShareALoadInManyWays) {
  for (const double load_N : {7.0, 10.0, 13.5, 18.0, 22.0}) {
    const auto w = test::follow(hung_on({-10, 0, 10}, load_N));
    ASSERT_FALSE(w.points.empty());
    // Found with forces, or not found as no two of three can be chosen: never one choice passed for the answer.
    EXPECT_FALSE(w.result.complete) << load_N << w.story();
    if (w.points[0].report.status != PoseStatus::undetermined) continue;
    EXPECT_EQ(w.points[0].undetermined.shared_ligaments, (std::vector<int>{0, 1, 2})) << load_N;
  }
}

TEST(SelfStress, AtTheEndsOfTheirJumpsStrandsLeaveNoChoice) {
  for (const double load_N : {6.75, 22.5}) {
    const auto w = test::follow(hung_on({-10, 0, 10}, load_N));
    EXPECT_TRUE(w.result.complete) << load_N << w.story();
  }
}

TEST(SelfStress, TwoStrandsAtTheirJumpsAreHeldByLevers) {
  const auto w = test::follow(hung_on({-10, 10}, 9, 2));
  EXPECT_TRUE(w.result.complete) << w.story();
}

}  // namespace
}  // namespace genu
