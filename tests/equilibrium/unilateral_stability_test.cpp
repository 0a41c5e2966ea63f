// What is held one way only: random fans of ligaments against the widest gap between them and a look all round,
// contacts without force.
#include "genu/equilibrium/unilateral_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/solved.h"

namespace genu {
namespace {

using test::bone_on_ground;
using test::contact;
using test::ligament;
using test::load;
using test::step;
using test::surface;
using Verdict = Stability::Verdict;

std::string number(double x) { return std::to_string(x); }

/// Ligaments of law `law` in the plane z = 0 from the bone's origin toward `directions` (rad), about to become taut.
std::string fan(const std::vector<double>& directions, const std::string& law, double strain) {
  std::string out;
  for (std::size_t i = 0; i < directions.size(); ++i)
    out += ligament("l" + std::to_string(i), "[0, 0, 0]",
                    "[" + number(30 * std::cos(directions[i])) + ", " + number(30 * std::sin(directions[i])) + ", 0]",
                    law + "\nstiffness = 1000\nreference_strain = " + std::to_string(strain));
  return out;
}

/// Each of them taken for taut.
Stability stability_of_fan(const std::vector<double>& directions, const std::string& law = "law = \"linear\"",
                           double strain = 0) {
  const auto s = test::scene_model(bone_on_ground() + fan(directions, law, strain) +
                                   step("prescribe = { " + test::kNoTurn + ", \"j.z\" = 0 }"));
  State state = reference_state(s.model);
  state.pieces.clear();
  for (std::size_t i = 0; i < s.model.ligaments.size(); ++i)
    if (!s.model.ligaments[i].law.sharp_breaks().empty()) state.pieces.push_back({static_cast<int>(i), 1});
  const Target target = test::target_of(s.scene);
  fit_multipliers(s.model, target, state);
  Linearization here;
  linearize(s.model, state, target, here);
  Stability out = assess_stability(here, s.model.scales.length);
  assess_unilateral_stability(s.model, state, {}, target, here.layer_loads, 0, out);
  return out;
}

/// The widest angle (rad) in which no ligament pulls: half a turn of it is a way out.
double widest_gap(std::vector<double> directions) {
  std::sort(directions.begin(), directions.end());
  double widest = directions.front() + 2 * M_PI - directions.back();
  for (std::size_t i = 1; i < directions.size(); ++i) widest = std::max(widest, directions[i] - directions[i - 1]);
  return widest;
}

/// J: what a motion of unit norm in the plane costs at least, looked for all round; each ligament pulls where it is
/// stretched.
double least_cost_round(const std::vector<double>& directions) {
  constexpr double kStiffness = 1000 / 30e-3 * 1e-4;  // J for a motion of 10 mm, of each
  constexpr int kRound = 20000;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kRound; ++k) {
    double cost = 0;
    for (const double d : directions) cost += std::pow(std::max(0.0, -std::cos(d - 2 * M_PI * k / kRound)), 2);
    least = std::min(least, kStiffness * cost);
  }
  return least;
}

TEST(UnilateralStability, AFanOfLigamentsHoldsWhatItSurrounds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0, 2 * M_PI);
  int held = 0, free = 0;
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<double> directions(static_cast<std::size_t>(3 + draw % 4));
    for (double& d : directions) d = anywhere(random);
    const double widest = widest_gap(directions);
    if (std::abs(widest - M_PI) < 1e-3) continue;
    const Stability found = stability_of_fan(directions);
    EXPECT_TRUE(found.unilateral);
    EXPECT_NEAR(found.mode.norm(), 1, 1e-9);
    if (widest < M_PI) {
      ++held;
      EXPECT_EQ(found.verdict, Verdict::stable) << widest;
      EXPECT_NEAR(found.smallest, least_cost_round(directions), 1e-5);
      EXPECT_EQ(found.neutral.cols(), 0);
      continue;
    }
    ++free;
    EXPECT_EQ(found.verdict, Verdict::neutral) << widest;
    EXPECT_EQ(found.smallest, 0);
    const Vec3 way = found.mode.head<3>();
    for (const double d : directions)
      EXPECT_GE(way.dot(Vec3(std::cos(d), std::sin(d), 0)), -1e-7);  // none is stretched
    EXPECT_GE(found.neutral.cols(), 1);
  }
  EXPECT_GT(held, 30);
  EXPECT_GT(free, 30);
}

TEST(UnilateralStability, AToeThatPullsByNoMoreThanFailsToBalanceHoldsNothing) {
  const std::string toe = "law = \"quadratic\"";
  const double little = 1e-6;  // 1e-9 N each
  const Stability left = stability_of_fan({0, M_PI / 2}, toe, little), held = stability_of_fan({0, 2, 4}, toe, 1e-3);
  EXPECT_TRUE(left.unilateral);
  EXPECT_EQ(left.verdict, Verdict::neutral);  // nothing balances the two but where both are slack
  EXPECT_FALSE(held.unilateral);              // three that balance one another hold the body
  EXPECT_EQ(held.verdict, Verdict::stable);
}

TEST(UnilateralStability, ManyStrandsAreNoHarderThanFew) {
  for (const int n : {9, 16, 40}) {
    std::vector<double> round, half;
    for (int i = 0; i < n; ++i) {
      round.push_back(2 * M_PI * i / n);
      half.push_back(2.5 * i / n);
    }
    const Stability held = stability_of_fan(round), free = stability_of_fan(half);
    EXPECT_EQ(held.verdict, Verdict::stable) << n;
    EXPECT_NEAR(held.smallest, least_cost_round(round), 1e-5 * held.smallest) << n;
    EXPECT_EQ(free.verdict, Verdict::neutral) << n;
  }
}

TEST(UnilateralStability, WhereAToeBeginsNothingIsHeldEitherWay) {
  const std::vector<double> round = {0, 2, 4};
  EXPECT_EQ(stability_of_fan(round).verdict, Verdict::stable);
  EXPECT_EQ(stability_of_fan(round, "law = \"quadratic\"").verdict, Verdict::neutral);
}

/// An arm upside down, with 100 N mm/rad that throw it, and what holds it one way only.
Stability stability_of_arm(const std::string& held) {
  const auto w = test::follow(
      "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.base]\nfixed = true\n[body.arm]\n"
      "[joint.h]\ntype = \"revolute\"\nparent = \"base\"\nchild = \"arm\"\naxis = [0, 1, 0]\n" +
      held + "[load.w]\nbody = \"arm\"\npoint = [0, 0, 100]\nforce = [0, 0, -1]\n[[step]]\nincrements = 1\n");
  EXPECT_FALSE(w.points.empty()) << w.story();
  return w.points.empty() ? Stability() : w.points.back().stability;
}

TEST(UnilateralStability, AStopHoldsOneWay) {
  for (const char* at : {"from = 0", "from = -90, to = 0"}) {
    const Stability s = stability_of_arm(std::string("limits = { ") + at + ", stiffness = 1 }\n");
    EXPECT_TRUE(s.unilateral) << at;
    EXPECT_EQ(s.verdict, Verdict::unstable) << at;
    EXPECT_NEAR(s.smallest, -0.1, 1e-9) << at;
  }
}

TEST(UnilateralStability, ALoadWhoseScaleBeginsThereHoldsOneWay) {
  const std::string load = "[load.m]\non = \"h.angle\"\nvalue = -1\nscale = { over = \"h.angle\", table = ";
  const Stability s = stability_of_arm("stiffness = 0.001\n" + load + "[[0, 0], [10, 1]] }\n");
  EXPECT_EQ(s.verdict, Verdict::unstable);
  EXPECT_NEAR(s.smallest, 0.18 / M_PI - 0.1, 1e-9);
  const Stability round = stability_of_arm("stiffness = 0.001\n" + load + "[[-10, -1], [10, 1]] }\n");
  EXPECT_FALSE(round.unilateral);
  EXPECT_EQ(round.verdict, Verdict::stable);
}

std::string ball_on_floor() {
  return bone_on_ground("{ z = 20 }") + surface("ball", "bone", "sphere", "radius = 20") +
         surface("floor", "ground", "plane") + contact("foot", "ball", "floor") + load("weight", "force = [0, 0, -10]");
}

/// The ball's weight is taken away; only x and what floor and springs leave are free.
test::Followed unloaded(const std::string& springs) {
  return test::follow(ball_on_floor() + springs +
                      step("prescribe = { " + test::kNoTurn + ", \"j.y\" = 0 }\nload = { weight = [1, 0] }"));
}

const std::string kHeldFromAbove = test::spring("upright", "[0, 0, 0]", "[0, 0, 20]", 5, 0);
const std::string kHeldSideways = test::spring("sideways", "[0, 0, 0]", "[50, 0, 20]", 5, 50);
/// Compressed between the ball and walls beside it: it holds the ball there and throws it up.
const std::string kProps = test::spring("left", "[0, 0, 0]", "[-40, 0, 20]", 10, 50) +
                           test::spring("right", "[0, 0, 0]", "[40, 0, 20]", 10, 50);

TEST(UnilateralStability, AFloorThatCarriesNothingDoesNotHoldWhatLiesOnIt) {
  const auto w = unloaded(kHeldSideways);
  ASSERT_EQ(w.points.size(), 2U) << w.story();
  EXPECT_EQ(w.points[0].report.status, PoseStatus::ok);
  EXPECT_EQ(w.points[1].report.status, PoseStatus::undetermined);
  ASSERT_EQ(w.points[1].undetermined.free_motion.size(), 1U);
  EXPECT_EQ(w.points[1].undetermined.free_motion[0].index, 5);  // z
}

TEST(UnilateralStability, WhatElseHoldsTheBallHoldsItWithoutTheFloorToo) {
  const auto w = unloaded(kHeldFromAbove);
  ASSERT_EQ(w.points.size(), 2U) << w.story();
  EXPECT_TRUE(w.result.complete) << w.story();
  EXPECT_EQ(w.points[1].stability.verdict, Verdict::stable);
}

TEST(UnilateralStability, ABallThatLeavesTheFloorByItselfIsUnstable) {
  const auto w = unloaded(kProps);
  ASSERT_EQ(w.points.size(), 2U) << w.story();
  EXPECT_EQ(w.points[0].stability.verdict, Verdict::stable);  // its weight presses it down
  const Stability& s = w.points[1].stability;
  EXPECT_EQ(s.verdict, Verdict::unstable);
  EXPECT_NEAR(s.smallest, 2 * 10e3 * (1 - 50.0 / 40) * 1e-4, 1e-12);  // 2 k (1 - L0 / L), J
  EXPECT_GT(s.mode[2], 0.99);
}

TEST(UnilateralStability, AFloorThatIsJustLeftBarsAllTheSame) {
  // Lifted until the last row, where it lies on the floor and no contact is held: down is barred, up a strand is taut.
  const auto w = test::follow(
      ball_on_floor() + kProps +
      ligament("strand", "[0, 0, 0]", "[0, 0, -20]", "law = \"linear\"\nstiffness = 400\nreference_strain = 0") +
      step("prescribe = { " + test::kNoTurn + ", \"j.y\" = 0 }\nload = { weight = [-0.5, 0] }"));
  ASSERT_EQ(w.points.size(), 2U) << w.story();
  EXPECT_EQ(w.points[1].report.status, PoseStatus::ok) << w.story();
  EXPECT_EQ(w.points[1].stability.verdict, Verdict::stable);
  EXPECT_NEAR(w.points[1].stability.smallest, (10e3 + 2 * 10e3 * (1 - 50.0 / 40)) * 1e-4, 1e-9);
}

TEST(UnilateralStability, ARiseOfAForceBarsWhatComesFromBelow) {
  // 2.25 N at the end of the toe, 7.5 N beyond: shorter, the toe's 3 N/mm hold with 10 of a spring against -5 of props.
  const std::string strand = ligament("rise", "[0, 0, 0]", "[0, 0, 51.5]",
                                      "law = \"abdel-rahman\"\nstiffness = 10\ntoe_stiffness = 1\n"
                                      "transition_strain = 0.05\nslack_length = 30");
  const auto w =
      test::follow(bone_on_ground("{ z = 20 }") + kProps + strand +
                   test::spring("hold", "[0, 0, 0]", "[0, 0, 50]", 10, 30) + load("pull", "force = [0, 0, -2.25]") +
                   step("prescribe = { " + test::kNoTurn + ", \"j.x\" = 0, \"j.y\" = 0 }\nload = { pull = 1 }"));
  ASSERT_FALSE(w.points.empty()) << w.story();
  const Stability& s = w.points.back().stability;
  EXPECT_TRUE(s.unilateral);
  EXPECT_EQ(s.verdict, Verdict::stable);
  EXPECT_NEAR(s.smallest, (3e3 + 10e3 - 5e3) * 1e-4, 1e-6);
}

TEST(UnilateralStability, PressedDownNothingOfThatMatters) {
  for (const double weight : {1e-3, 1.0, 1e4}) {
    const auto w = test::follow(
        ball_on_floor() + kProps +
        step("prescribe = { " + test::kNoTurn + ", \"j.y\" = 0 }\nload = { weight = " + number(weight) + " }"));
    ASSERT_FALSE(w.points.empty());
    EXPECT_FALSE(w.points[0].stability.unilateral);
    EXPECT_EQ(w.points[0].stability.verdict, Verdict::stable);
  }
}

TEST(UnilateralStability, ALayerThatCarriesNothingHoldsNothing) {
  const auto w = test::follow(bone_on_ground("{ z = 20 }") + surface("ball", "bone", "sphere", "radius = 20") +
                              surface("floor", "ground", "plane") +
                              test::layer("foot", "ball", "floor", "quadrature = \"smooth\"") +
                              load("weight", "force = [0, 0, -10]") + kHeldSideways +
                              step("prescribe = { " + test::kNoTurn + ", \"j.y\" = 0 }\nload = { weight = [1, 0] }"));
  ASSERT_EQ(w.points.size(), 2U) << w.story();
  EXPECT_EQ(w.points[0].stability.verdict, Verdict::stable);
  EXPECT_EQ(w.points[1].report.status, PoseStatus::undetermined);
}

}  // namespace
}  // namespace genu
