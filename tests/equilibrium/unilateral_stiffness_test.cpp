// The least cost of a motion, against its plain twins: every combination of sides, and a descent from everywhere.
#include "genu/equilibrium/unilateral_stiffness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "genu/core/decompositions.h"

namespace genu {
namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double normal() { return normal_(random_); }
  int integer(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  VecX vector(int d) {
    return VecX::NullaryExpr(d, [this](Eigen::Index) { return normal(); });
  }
  MatX symmetric(int d) {
    const MatX A = MatX::NullaryExpr(d, d, [this](Eigen::Index, Eigen::Index) { return normal(); });
    return A + A.transpose();
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

Side kink(const VecX& direction, double below, double above) {
  const VecX row = direction.normalized();
  return {row, below * row, above * row, false};
}

Side closed(const VecX& direction) {
  return {direction.normalized(), VecX::Zero(direction.size()), VecX::Zero(direction.size()), true};
}

/// K(x) x, on the sides that x is on.
VecX force(const UnilateralStiffness& at, const VecX& x) {
  VecX out = at.stiffness * x;
  for (const Side& s : at.sides) out += (s.row.dot(x) > 0 ? s.above : s.below) * s.row.dot(x);
  return out;
}

double cost(const UnilateralStiffness& at, const VecX& x) { return x.dot(force(at, x)) / x.squaredNorm(); }

/// Downhill on the unit sphere from `x`; the cost is once continuously differentiable there.
double descended(const UnilateralStiffness& at, VecX x) {
  double bound = at.stiffness.norm();
  for (const Side& s : at.sides) bound += std::max(s.below.norm(), s.above.norm());
  for (int i = 0; i < 3000; ++i) x = (x - (force(at, x) - cost(at, x) * x) / (2 * bound)).normalized();
  return cost(at, x);
}

double least_by_descent(const UnilateralStiffness& at, Draw& draw) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 40; ++i)
    least = std::min(least, descended(at, draw.vector(static_cast<int>(at.stiffness.rows())).normalized()));
  return least;
}

UnilateralStiffness drawn(Draw& draw) {
  const int d = draw.integer(1, 4), m = draw.integer(0, 9);
  UnilateralStiffness out{draw.symmetric(d), {}, 1e-14};
  if (draw.integer(0, 1) == 0) out.stiffness += 3 * MatX::Identity(d, d);
  for (int i = 0; i < m; ++i) out.sides.push_back(kink(draw.vector(d), 3 * draw.normal(), 3 * draw.normal()));
  return out;
}

TEST(UnilateralStiffness, TheLeastCostIsWhatNoDescentComesBelow) {
  Draw draw(7);
  for (int i = 0; i < 300; ++i) {
    const UnilateralStiffness at = drawn(draw);
    const LeastCost found = least_cost(at);
    ASSERT_TRUE(found.told && found.any) << i;
    EXPECT_NEAR(found.motion.norm(), 1, 1e-9);
    EXPECT_NEAR(cost(at, found.motion), found.cost, 1e-9) << i;  // it is a motion's
    EXPECT_NEAR((force(at, found.motion) - found.cost * found.motion).norm(), 0, 1e-6) << i;
    EXPECT_NEAR(least_by_descent(at, draw), found.cost, 1e-4) << i << ": " << at.sides.size() << " sides";
  }
}

TEST(UnilateralStiffness, ManySidesInAPlaneAreAFan) {
  // A ring of directions that only pull: of n, evenly spread, half are stretched by any motion.
  for (const int n : {8, 12, 24, 60}) {
    UnilateralStiffness at{-2 * MatX::Identity(2, 2), {}, 1e-14};
    for (int i = 0; i < n; ++i)
      at.sides.push_back(kink(Vec2(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n)), 0, 1));
    const LeastCost found = least_cost(at);
    EXPECT_TRUE(found.told);
    EXPECT_NEAR(found.cost, n / 4.0 - 2, 1e-9) << n;
    EXPECT_LT(found.cases, 40 * n);
  }
}

TEST(UnilateralStiffness, NothingGoesBeyondAClosedPlane) {
  Draw draw(11);
  int held = 0, out = 0;
  for (int i = 0; i < 200; ++i) {
    const MatX K = draw.symmetric(2);
    const double at_wall = draw.normal();
    UnilateralStiffness at{K, {closed(Vec2(std::cos(at_wall), std::sin(at_wall))), closed(draw.vector(2))}, 1e-14};
    const LeastCost found = least_cost(at);
    ASSERT_TRUE(found.told);
    double least = std::numeric_limits<double>::infinity();
    constexpr int kRound = 40000;
    for (int k = 0; k < kRound; ++k) {
      const Vec2 x(std::cos(2 * M_PI * k / kRound), std::sin(2 * M_PI * k / kRound));
      if (at.sides[0].row.dot(x) <= 1e-4 && at.sides[1].row.dot(x) <= 1e-4) least = std::min(least, x.dot(K * x));
    }
    ASSERT_TRUE(found.any);
    // The mode may be a saddle's within the planes; its sign, and the least, are those of the walk round.
    EXPECT_NEAR(found.cost, least, 5e-3) << i;
    (found.cost > 0 ? held : out) += 1;
  }
  EXPECT_GT(held, 20);
  EXPECT_GT(out, 20);
}

TEST(UnilateralStiffness, BetweenOppositeClosedPlanesOneMovesAlongThem) {
  MatX K = MatX::Zero(3, 3);
  K.diagonal() << -5, 2, 4;
  UnilateralStiffness at{K, {closed(Vec3::UnitX()), closed(-Vec3::UnitX())}, 1e-14};
  EXPECT_NEAR(least_cost(at).cost, 2, 1e-12);
  at.sides.push_back(closed(Vec3::UnitY()));
  at.sides.push_back(closed(-Vec3::UnitY()));
  at.sides.push_back(closed(Vec3::UnitZ()));
  EXPECT_NEAR(least_cost(at).cost, 4, 1e-12);
  at.sides.push_back(closed(-Vec3::UnitZ()));
  EXPECT_FALSE(least_cost(at).any);
}

TEST(UnilateralStiffness, WhatCostsNothingIsToldBesideWhatFalls) {
  MatX K = MatX::Zero(2, 2);
  K(0, 0) = -1;
  const UnilateralStiffness at{K, {kink(Vec2::UnitY(), 0, 5)}, 1e-14};
  const LeastCost found = least_cost(at);
  EXPECT_NEAR(found.cost, -1, 1e-12);
  ASSERT_EQ(found.free.cols(), 1);
  EXPECT_LT(found.free(1, 0), -0.999);
}

TEST(UnilateralStiffness, AWallOnBothSidesOfNothingIsNoMotionThatCostsNothing) {
  const UnilateralStiffness at{MatX::Zero(1, 1), {kink(VecX::Ones(1), 0, 5), kink(-VecX::Ones(1), 0, 3)}, 1e-14};
  const LeastCost found = least_cost(at);
  EXPECT_NEAR(found.cost, 3, 1e-12);
  EXPECT_EQ(found.free.cols(), 0);
}

TEST(UnilateralStiffness, UnsymmetricSidesAreThoseOfTheirOwnMotions) {
  // y pushes x, one way only: [k u; 0 k] has the eigenvalue k alone, whatever u is.
  UnilateralStiffness at{2 * MatX::Identity(2, 2), {}, 1e-14};
  at.sides.push_back({Vec2::UnitY(), VecX::Zero(2), 100 * Vec2::UnitX(), false});
  EXPECT_NEAR(least_cost(at).cost, 2, 1e-6);
  // One that pushes the way it is moved, beyond alone: it runs away there, and is held on this side.
  at.sides.push_back({Vec2::UnitX(), VecX::Zero(2), -3 * Vec2::UnitX(), false});
  const LeastCost found = least_cost(at);
  EXPECT_NEAR(found.cost, -1, 1e-9);
  EXPECT_GT(found.motion[0], 0.999);
}

TEST(UnilateralStiffness, TooManyAreNotTold) {
  Draw draw(3);
  UnilateralStiffness at{-MatX::Identity(12, 12), {}, 1e-14};
  for (int i = 0; i < 60; ++i) at.sides.push_back(kink(draw.vector(12), 0, 1));
  EXPECT_FALSE(least_cost(at).told);
}

TEST(UnilateralStiffness, AllowedMotionsOfAConeWithoutInside) {
  MatX bounds(2, 2);
  bounds << 1, 0, -1, 0;  // x = 0
  const VecX along = allowed(bounds, MatX::Identity(2, 2));
  ASSERT_EQ(along.size(), 2);
  EXPECT_NEAR(std::abs(along[1]), 1, 1e-12);
  MatX none(3, 2);
  none << 1, 0, -1, 1, -1, -1;
  EXPECT_EQ(allowed(none, MatX::Identity(2, 2)).size(), 0);
}

}  // namespace
}  // namespace genu
