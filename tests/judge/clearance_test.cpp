#include "genu/judge/clearance.h"

#include <limits>

#include <gtest/gtest.h>

#include "support/random_points.h"

namespace genu::judge {
namespace {

double distance(const Clearance::Box& box, const Vec3& x) {
  return (x - x.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

TEST(Clearance, IsABoundAndNotMuchLess) {
  test::RandomPoints random(1);
  std::vector<Clearance::Box> boxes;
  for (int k = 0; k < 300; ++k) {
    // On a bent sheet, as the triangles of a mesh.
    const double u = random.uniform(-0.04, 0.04), v = random.uniform(-0.02, 0.02);
    const Vec3 x(u, v, 10 * u * u);
    boxes.push_back({x - 5e-4 * Vec3::Ones(), x + 5e-4 * Vec3::Ones()});
  }
  const Clearance clearance(boxes);
  int clear = 0, seen = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 x = random.in_ball(0.08);
    const double reach = random.uniform(0, 0.03);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Clearance::Box& box : boxes) nearest = std::min(nearest, distance(box, x));
    const bool beyond = clearance.beyond(x, reach);
    EXPECT_TRUE(!beyond || nearest > reach) << x.transpose();
    clear += nearest > reach ? 1 : 0;
    seen += beyond ? 1 : 0;
  }
  EXPECT_GT(seen, 0.8 * clear) << clear;
  EXPECT_LT(clear, 1900);
}

TEST(Clearance, OfNothingIsWithoutBound) {
  EXPECT_TRUE(Clearance(std::vector<Clearance::Box>()).beyond(Vec3::Zero(), 1e6));
}

}  // namespace
}  // namespace genu::judge
