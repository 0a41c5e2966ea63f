// One-sided conditions against what can be seen: half planes, cones, and random fans of them looked at all round.
#include "genu/equilibrium/feasible_direction.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

MatX fan_of(const std::vector<double>& directions) {
  MatX out(static_cast<Eigen::Index>(directions.size()), 2);
  for (std::size_t i = 0; i < directions.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) << std::cos(directions[i]), std::sin(directions[i]);
  return out;
}

const MatX kPlane = MatX::Identity(2, 2);

TEST(FeasibleDirection, LeavesAHalfPlane) {
  const VecX way = feasible_direction(fan_of({0}), kPlane);
  EXPECT_NEAR(way.norm(), 1, 1e-9);
  EXPECT_NEAR(way[0], -1, 1e-6);
}

TEST(FeasibleDirection, OppositeBoundsLeaveNothingButTheLineBetween) {
  // Along the line neither bound is left: no way out.
  EXPECT_TRUE(feasible_direction(fan_of({0, M_PI}), kPlane).isZero(0));
  EXPECT_FALSE(feasible_direction(fan_of({0, M_PI, M_PI / 2}), kPlane).isZero(0));
}

TEST(FeasibleDirection, FindsOneWhereHalfATurnIsFree) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(0, 2 * M_PI);
  int found = 0;
  for (int draw = 0; draw < 500; ++draw) {
    std::vector<double> directions(static_cast<std::size_t>(2 + draw % 5));
    for (double& d : directions) d = anywhere(random);
    std::sort(directions.begin(), directions.end());
    double widest = directions.front() + 2 * M_PI - directions.back();
    for (std::size_t i = 1; i < directions.size(); ++i) widest = std::max(widest, directions[i] - directions[i - 1]);
    if (std::abs(widest - M_PI) < 1e-3) continue;
    const MatX bounds = fan_of(directions);
    const VecX way = feasible_direction(bounds, kPlane);
    EXPECT_EQ(!way.isZero(0), widest > M_PI) << widest;
    if (way.isZero(0)) continue;
    ++found;
    EXPECT_LE((bounds * way).maxCoeff(), 1e-9);
    EXPECT_TRUE(within(bounds, way));
    EXPECT_FALSE(within(bounds, -way));
  }
  EXPECT_GT(found, 100);
}

/// k x n directions drawn at random.
MatX directions(int k, int n, std::mt19937& random) {
  std::normal_distribution<double> any;
  MatX out(k, n);
  for (Eigen::Index i = 0; i < out.size(); ++i) out.data()[i] = any(random);
  return out.rowwise().normalized();
}

/// Bounds of which only `way` and what is within `margin` of it is free: pairs that all but oppose each other.
MatX thin_cone(const VecX& way, double margin, int pairs, std::mt19937& random) {
  const auto n = static_cast<int>(way.size());
  MatX out(2 * pairs, n);
  const MatX across = directions(pairs, n, random);
  for (int i = 0; i < pairs; ++i) {
    const VecX side = (across.row(i).transpose() - across.row(i).dot(way) * way).normalized();
    out.row(2 * i) = (side - margin * way).transpose().normalized();
    out.row(2 * i + 1) = (-side - margin * way).transpose().normalized();
  }
  return out;
}

TEST(FeasibleDirection, FindsTheWayOutOfThinCones) {
  std::mt19937 random(5);
  for (int draw = 0; draw < 2000; ++draw) {
    const int n = 2 + draw % 11, pairs = 1 + draw % 7;
    const double margin = std::pow(10, -1 - draw % 4);  // down to 1e-4
    const VecX way = directions(1, n, random).row(0).transpose();
    const MatX bounds = thin_cone(way, margin, pairs, random);
    const VecX found = feasible_direction(bounds, MatX::Identity(n, n));
    ASSERT_NEAR(found.norm(), 1, 1e-9) << "draw " << draw;
    EXPECT_TRUE(within(bounds, found));
    EXPECT_LT((bounds * found).minCoeff(), -1e-6);
  }
}

TEST(FeasibleDirection, FindsNoneWhereForcesHoldEachOther) {
  // y > 0 with R^T y = 0: the last row balances the others.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> weight(0.01, 1);
  for (int draw = 0; draw < 2000; ++draw) {
    const int n = 2 + draw % 11, k = 2 + draw % 15;
    MatX bounds = directions(k, n, random);
    VecX sum = VecX::Zero(n);
    for (int i = 0; i + 1 < k; ++i) sum += weight(random) * bounds.row(i).transpose();
    bounds.row(k - 1) = -sum.normalized().transpose();
    EXPECT_TRUE(feasible_direction(bounds, MatX::Identity(n, n)).isZero(0)) << "draw " << draw;
  }
}

TEST(FeasibleDirection, LeavesAnyConeThatAMotionLeaves) {
  // Every bound turned away from one direction: all of it, or all but what others hold.
  std::mt19937 random(7);
  for (int draw = 0; draw < 2000; ++draw) {
    const int n = 2 + draw % 11, k = 1 + draw % 20;
    MatX bounds = directions(k, n, random);
    const VecX way = directions(1, n, random).row(0).transpose();
    for (int i = 0; i < k; ++i)
      if (bounds.row(i).dot(way) > -1e-3)
        bounds.row(i) = (bounds.row(i) - (bounds.row(i).dot(way) + 1e-3) * way.transpose()).normalized();
    const VecX found = feasible_direction(bounds, MatX::Identity(n, n));
    ASSERT_NEAR(found.norm(), 1, 1e-9) << "draw " << draw;
    EXPECT_TRUE(within(bounds, found));
  }
}

TEST(FeasibleDirection, RowsOfAnyLengthAreTheSameBounds) {
  const MatX bounds = fan_of({0, M_PI - 0.01, 2}) * 1e-3;
  const VecX found = feasible_direction(bounds, kPlane);
  ASSERT_NEAR(found.norm(), 1, 1e-9);
  EXPECT_LE((fan_of({0, M_PI - 0.01, 2}) * found).maxCoeff(), 1e-9);
}

TEST(FeasibleDirection, WithoutBoundsEverythingIsWithin) {
  EXPECT_TRUE(within(MatX(0, 2), Vec2(1, 2)));
  EXPECT_TRUE(feasible_direction(MatX(0, 2), kPlane).isZero(0));  // there is nothing to leave
}

TEST(FeasibleDirection, NonnegativeLeastSquaresMeetTheirConditions) {
  // y >= 0, A^T (A y - b) >= 0, and one of the two is 0 in each place (Karush, Kuhn, Tucker).
  std::mt19937 random(5);
  std::normal_distribution<double> any;
  for (int draw = 0; draw < 200; ++draw) {
    MatX A(6, 1 + draw % 8);
    VecX b(6);
    for (double& x : A.reshaped()) x = any(random);
    for (double& x : b.reshaped()) x = any(random);
    const VecX y = nonnegative_least_squares(A, b), rate = A.transpose() * (A * y - b);
    EXPECT_GE(y.minCoeff(), 0) << draw;
    EXPECT_GE(rate.minCoeff(), -1e-10) << draw;
    EXPECT_NEAR(y.cwiseProduct(rate).cwiseAbs().maxCoeff(), 0, 1e-10) << draw;
  }
}

}  // namespace
}  // namespace genu
