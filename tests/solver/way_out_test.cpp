// One-sided conditions against what can be seen: half planes, cones, and random fans of them looked at all round.
#include "genu/solver/way_out.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

MatX fan(const std::vector<double>& directions) {
  MatX out(static_cast<Eigen::Index>(directions.size()), 2);
  for (std::size_t i = 0; i < directions.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) << std::cos(directions[i]), std::sin(directions[i]);
  return out;
}

const MatX kPlane = MatX::Identity(2, 2);

TEST(WayOut, LeavesAHalfPlane) {
  const VecX way = way_out(fan({0}), kPlane);
  EXPECT_NEAR(way.norm(), 1, 1e-9);
  EXPECT_NEAR(way[0], -1, 1e-6);
}

TEST(WayOut, OppositeBoundsLeaveNothingButTheLineBetween) {
  // Along the line neither bound is left: no way out.
  EXPECT_TRUE(way_out(fan({0, M_PI}), kPlane).isZero(0));
  EXPECT_FALSE(way_out(fan({0, M_PI, M_PI / 2}), kPlane).isZero(0));
}

TEST(WayOut, FindsOneWhereHalfATurnIsFree) {
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
    const MatX bounds = fan(directions);
    const VecX way = way_out(bounds, kPlane);
    EXPECT_EQ(!way.isZero(0), widest > M_PI) << widest;
    if (way.isZero(0)) continue;
    ++found;
    EXPECT_LE((bounds * way).maxCoeff(), 1e-9);
    EXPECT_TRUE(within(bounds, way));
    EXPECT_FALSE(within(bounds, -way));
  }
  EXPECT_GT(found, 100);
}

TEST(WayOut, WithoutBoundsEverythingIsWithin) {
  EXPECT_TRUE(within(MatX(0, 2), Vec2(1, 2)));
  EXPECT_TRUE(way_out(MatX(0, 2), kPlane).isZero(0));  // there is nothing to leave
}

}  // namespace
}  // namespace genu
