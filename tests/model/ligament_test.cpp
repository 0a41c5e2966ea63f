// Ligaments between two moving bodies: closed forms, derivatives by finite differences, and the invariances of
// mechanics.
#include "genu/model/ligament.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/law_def.h"
#include "support/wrench_difference.h"

namespace genu {
namespace {

using test::random_pose;

constexpr const char* kLawNames[] = {"quadratic", "linear", "blankevoort", "spring", "table", "abdel-rahman"};

LigamentLaw build_law(const std::string& kind, double slack_length) {
  LigamentDef def = test::law_def(
      kind, {{"stiffness", kind == "abdel-rahman" ? 500. : 100.}, {"toe_stiffness", 1000}, {"transition_strain", 0.5}});
  def.points = {{0, 0}, {1, 20}, {4, 200}, {30, 3000}};
  def.rest_value = slack_length;
  std::string why;
  std::optional<LigamentLaw> law = make_law(def, 1, why);
  EXPECT_TRUE(law) << why;
  return *law;
}

/// A law along a line, as each test asks for it.
struct Ligament : TautLine {
  LigamentLaw law;
  Ligament(LigamentLaw made, const Vec3& a, const Vec3& b) : TautLine{a, b}, law(std::move(made)) {}
  bool evaluate(const Pose& X_WA, const Pose& X_WB, TwoBodyWrench& out, int piece = LigamentLaw::kByLength) const {
    return evaluate_straight(law, *this, X_WA, X_WB, out, piece);
  }
  bool evaluate_wrench(const Pose& X_WA, const Pose& X_WB, TwoBodyWrench& out) const {
    return evaluate_straight_wrench(law, *this, X_WA, X_WB, out);
  }
};

/// Bodies about 0.1 m apart and a ligament that is taut at most poses.
Ligament some_ligament(const std::string& kind, double slack_length = 0.02) {
  return {build_law(kind, slack_length), {0.03, -0.01, 0.02}, {-0.02, 0.015, 0.01}};
}

VecX both_wrenches(const Ligament& ligament, const Pose& X_WA, const Pose& X_WB) {
  TwoBodyWrench out;
  ligament.evaluate_wrench(X_WA, X_WB, out);
  VecX both(12);
  both << out.on_a, out.on_b;
  return both;
}

TEST(Ligament, PullsStraightBetweenItsEnds) {
  const Ligament spring{build_law("spring", 0.1), {0, 0.1, 0}, {0, 0, 0}};
  TwoBodyWrench out;
  ASSERT_TRUE(spring.evaluate(Pose{}, {Mat3::Identity(), {0.3, 0.1, 0}}, out));
  Vec6 on_a, on_b;
  on_a << 20, 0, 0, 0, 0, -2;
  on_b << -20, 0, 0, 0, 0, 0;
  EXPECT_LT((out.on_a - on_a).norm(), 1e-14);
  EXPECT_LT((out.on_b - on_b).norm(), 1e-14);
  EXPECT_NEAR(out.length, 0.3, 1e-16);
  EXPECT_NEAR(out.strain, 2, 1e-15);
  EXPECT_NEAR(out.force, 20, 1e-14);
  EXPECT_NEAR(out.energy, 2, 1e-15);
  EXPECT_NEAR(out.stiffness(6, 6), -100, 1e-12);       // along the line: F'
  EXPECT_NEAR(out.stiffness(7, 7), -20 / 0.3, 1e-12);  // across: F / L
}

TEST(Ligament, StiffnessIsTheWrenchsDerivative) {
  for (const std::string kind : kLawNames) {
    const Ligament ligament = some_ligament(kind);
    std::mt19937 generator(1);
    double worst = 0;
    int taut = 0;
    for (int i = 0; i < 40; ++i) {
      const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1);
      TwoBodyWrench out;
      // A law's break within the difference's reach would spoil the difference, not the derivative.
      if (!ligament.evaluate(A, B, out) || (kind == "abdel-rahman" && out.strain < 0.7)) continue;
      ++taut;
      const auto wrench = [&](const Pose& X, const Pose& Y) { return both_wrenches(ligament, X, Y); };
      // Steps of 10 um stay on one piece of the laws that are made of several.
      const MatX fd = test::twist_difference(wrench, A, B, 1e-5);
      worst = std::max(worst, test::relative_error(out.stiffness, fd));
    }
    EXPECT_GT(taut, 30);
    EXPECT_LT(worst, 1e-10) << "law " << kind;
  }
}

TEST(Ligament, WrenchIsMinusTheEnergysGradient) {
  for (const std::string kind : kLawNames) {
    const Ligament ligament = some_ligament(kind);
    std::mt19937 generator(2);
    double worst = 0;
    for (int i = 0; i < 40; ++i) {
      const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1);
      const auto energy = [&](const Pose& X, const Pose& Y) -> VecX {
        TwoBodyWrench out;
        ligament.evaluate_wrench(X, Y, out);
        return VecX::Constant(1, out.energy);
      };
      const MatX fd = test::twist_difference(energy, A, B, 1e-5);
      worst = std::max(worst, test::relative_error(-both_wrenches(ligament, A, B).transpose(), fd, 1));
    }
    EXPECT_LT(worst, 1e-10) << "law " << kind;
  }
}

/// With a potential U the derivative of the wrench along twists is -(Hessian + half the moments' turning): what is left
/// after adding [m]x / 2 for each body is symmetric.
TEST(Ligament, StiffnessIsSymmetricUpToTheTurningOfTheMoments) {
  const Ligament ligament = some_ligament("blankevoort");
  std::mt19937 generator(3);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    TwoBodyWrench out;
    ligament.evaluate(random_pose(generator, 0.1), random_pose(generator, 0.1), out);
    Mat12 k = out.stiffness;
    k.block<3, 3>(3, 3) += skew(out.on_a.tail<3>()) / 2;
    k.block<3, 3>(9, 9) += skew(out.on_b.tail<3>()) / 2;
    worst = std::max(worst, test::relative_error(k, k.transpose()));
  }
  EXPECT_LT(worst, 1e-14);
}

TEST(Ligament, ActionIsReactionAboutTheWorldsOrigin) {
  const Ligament ligament = some_ligament("quadratic");
  std::mt19937 generator(4);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1);
    TwoBodyWrench out;
    ligament.evaluate(A, B, out);
    const Vec3 force = out.on_a.head<3>() + out.on_b.head<3>();
    const Vec3 moment =
        out.on_a.tail<3>() + A.p.cross(out.on_a.head<3>()) + out.on_b.tail<3>() + B.p.cross(out.on_b.head<3>());
    worst = std::max({worst, force.norm(), moment.norm() / (1 + out.force)});
  }
  EXPECT_LT(worst, 1e-15);
}

TEST(Ligament, MovingBothBodiesTogetherTurnsTheWrenchesAndNothingElse) {
  const Ligament ligament = some_ligament("blankevoort");
  std::mt19937 generator(5);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1), move = random_pose(generator, 1);
    TwoBodyWrench here, there;
    ligament.evaluate(A, B, here);
    ligament.evaluate(move * A, move * B, there);
    Mat12 turn = Mat12::Zero();
    for (int block = 0; block < 4; ++block) turn.block<3, 3>(3 * block, 3 * block) = move.R;
    worst = std::max({worst, (there.on_a - turn.topLeftCorner<6, 6>() * here.on_a).norm() / (1 + here.force),
                      (there.on_b - turn.topLeftCorner<6, 6>() * here.on_b).norm() / (1 + here.force),
                      test::relative_error(turn * here.stiffness * turn.transpose(), there.stiffness)});
  }
  EXPECT_LT(worst, 1e-12);
}

/// A rigid motion of both changes no length, so the wrench may only turn: K * (common twist) = w x wrench.
TEST(Ligament, StiffnessOfACommonMotionOnlyTurnsTheWrenches) {
  const Ligament ligament = some_ligament("blankevoort");
  std::mt19937 generator(6);
  for (int i = 0; i < 20; ++i) {
    const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1);
    TwoBodyWrench out;
    ligament.evaluate(A, B, out);
    const Vec3 w(0.3, -0.5, 0.8), v(1, 2, 3);
    Eigen::Matrix<double, 12, 1> twist, expected;
    twist << v + w.cross(A.p), w, v + w.cross(B.p), w;
    expected << w.cross(out.on_a.head<3>()), w.cross(out.on_a.tail<3>()), w.cross(out.on_b.head<3>()),
        w.cross(out.on_b.tail<3>());
    EXPECT_LT((out.stiffness * twist - expected).norm(), 1e-13 * (1 + out.stiffness.norm()));
  }
}

TEST(Ligament, MirroredPosesGiveMirroredWrenches) {
  const Mat3 mirror = Vec3(1, -1, 1).asDiagonal();  // through the x-z plane; axial vectors change sign besides
  const Ligament ligament = some_ligament("quadratic");
  const Ligament reflected{ligament.law, mirror * ligament.p_A, mirror * ligament.p_B};
  const auto reflect = [&](const Pose& X) { return Pose{mirror * X.R * mirror, mirror * X.p}; };
  std::mt19937 generator(7);
  for (int i = 0; i < 20; ++i) {
    const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1);
    TwoBodyWrench here, there;
    ligament.evaluate(A, B, here);
    reflected.evaluate(reflect(A), reflect(B), there);
    EXPECT_LT((there.on_a.head<3>() - mirror * here.on_a.head<3>()).norm(), 1e-14 * (1 + here.force));
    EXPECT_LT((there.on_a.tail<3>() + mirror * here.on_a.tail<3>()).norm(), 1e-14 * (1 + here.force));
  }
}

TEST(Ligament, ExchangingTheEndsExchangesTheWrenches) {
  const Ligament ligament = some_ligament("linear"), reversed{ligament.law, ligament.p_B, ligament.p_A};
  std::mt19937 generator(8);
  const Pose A = random_pose(generator, 0.1), B = random_pose(generator, 0.1);
  TwoBodyWrench one, other;
  ligament.evaluate(A, B, one);
  reversed.evaluate(B, A, other);
  EXPECT_LT((one.on_a - other.on_b).norm(), 1e-14);
  EXPECT_LT((one.stiffness.topRightCorner<6, 6>() - other.stiffness.bottomLeftCorner<6, 6>()).norm(), 1e-10);
}

TEST(Ligament, SlackGivesZerosAndClearsWhatWasThere) {
  const Ligament ligament = some_ligament("quadratic", 10);
  TwoBodyWrench out;
  out.on_a.setOnes();
  out.on_b.setOnes();
  out.stiffness.setOnes();
  out.force = out.energy = 1;
  EXPECT_FALSE(ligament.evaluate(Pose{}, Pose{}, out));
  EXPECT_EQ(out.on_a.norm() + out.on_b.norm() + out.stiffness.norm() + out.force + out.energy, 0);
  EXPECT_NEAR(out.strain, (out.length - 10) / 10, 1e-16);
}

TEST(Ligament, SpringOfSlackLengthZeroIsSmoothWhereItsEndsMeet) {
  const Ligament spring = some_ligament("spring", 0);
  std::mt19937 generator(9);
  const Pose A = random_pose(generator, 0.1);
  Pose B = random_pose(generator, 0.1);
  for (const double distance : {0.0, 1e-300, 1e-12, 1e-3}) {
    B.p = A * spring.p_A - B.R * spring.p_B + Vec3(0, distance, 0);
    TwoBodyWrench out;
    ASSERT_TRUE(spring.evaluate(A, B, out));
    EXPECT_NEAR(out.on_a[1], 100 * distance, 1e-14);
    const auto wrench = [&](const Pose& X, const Pose& Y) { return both_wrenches(spring, X, Y); };
    EXPECT_LT(test::relative_error(out.stiffness, test::twist_difference(wrench, A, B)), 1e-9) << distance;
    EXPECT_TRUE(std::isnan(out.strain));
  }
}

TEST(Ligament, SpringWithoutADirectionGivesNoNaN) {
  const Ligament spring{build_law("spring", 0.1), Vec3::Zero(), Vec3::Zero()};
  TwoBodyWrench out;
  spring.evaluate(Pose{}, Pose{}, out);
  EXPECT_EQ(out.on_a.norm() + out.stiffness.norm(), 0);
  EXPECT_EQ(out.force, -10);
}

}  // namespace
}  // namespace genu
