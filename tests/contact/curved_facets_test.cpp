#include "genu/contact/curved_facets.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "support/layers.h"
#include "support/random_points.h"

namespace genu {
namespace {

constexpr double kRadius = 0.02;

std::shared_ptr<const SmoothCells> ball(double edge) {
  return std::make_shared<const SmoothCells>(test::ball(kRadius, edge), make_sphere({}, kRadius, false));
}

/// The place where a line from inside leaves the sphere.
double exact(const Vec3& origin, const Vec3& direction) {
  const double b = origin.dot(direction);
  return -b + std::sqrt(b * b - origin.squaredNorm() + kRadius * kRadius);
}

struct Line {
  Vec3 origin, direction;
};

/// From within the ball, up to 60 deg off the normal where they leave it.
std::vector<Line> lines(int count) {
  test::RandomPoints random(3);
  std::vector<Line> out;
  while (static_cast<int>(out.size()) < count) {
    const Vec3 origin = random.in_ball(0.5 * kRadius), direction = random.in_ball(1).normalized();
    out.push_back({origin, direction});
  }
  return out;
}

int facet_under(const SmoothCells& cells, const Vec3& x) {
  int best = 0;
  for (int cell = 0; cell < cells.cell_count(); ++cell)
    if ((cells.middle(cell).x - x).norm() < (cells.middle(best).x - x).norm()) best = cell;
  return best;
}

TEST(CurvedFacets, LinesMeetTheSphereToTheThirdOrder) {
  double worst[2] = {0, 0}, turned[2] = {0, 0};
  for (int k = 0; k < 2; ++k) {
    const auto cells = ball(k == 0 ? 4e-3 : 1e-3);
    const CurvedFacets facets(cells);
    CurvedFacets::Memory memory;
    for (const Line& line : lines(200)) {
      const double distance = exact(line.origin, line.direction);
      const Vec3 x = line.origin + distance * line.direction;
      CurvedFacets::Meeting there;
      ASSERT_TRUE(facets.meet(line.origin, line.direction, facet_under(*cells, x), memory, there));
      worst[k] = std::max(worst[k], std::abs(there.distance - distance));
      turned[k] = std::max(turned[k], (there.normal - x / kRadius).norm());
    }
  }
  EXPECT_LT(worst[0], 3e-6);
  EXPECT_LT(worst[1], worst[0] / 64);
  EXPECT_LT(turned[1], turned[0] / 16);
}

TEST(CurvedFacets, TheWayToTheLineMakesNoDifference) {
  const auto cells = ball(2e-3);
  const CurvedFacets facets(cells);
  int far = 0;
  for (const Line& line : lines(100)) {
    const int under = facet_under(*cells, line.origin + exact(line.origin, line.direction) * line.direction);
    CurvedFacets::Memory memory;
    CurvedFacets::Meeting near, there;
    ASSERT_TRUE(facets.meet(line.origin, line.direction, under, memory, near));
    // Three sides away.
    int from = under;
    for (int side = 0; side < 3; ++side) from = cells->neighbour(from, side);
    far += from != near.facet ? 1 : 0;
    ASSERT_TRUE(facets.meet(line.origin, line.direction, from, memory, there));
    EXPECT_NEAR(there.distance, near.distance, 1e-14);
    EXPECT_LT((there.normal - near.normal).norm(), 2e-2) << "on an edge either facet's";
  }
  EXPECT_GT(far, 50);
}

TEST(CurvedFacets, NoStepBetweenNeighbours) {
  // Parallel lines over an edge, 0.1 um apart; the surface leans by less than 0.1 there.
  const auto cells = ball(2e-3);
  const CurvedFacets facets(cells);
  CurvedFacets::Memory memory;
  int crossed = 0;
  for (int cell = 0; cell < 200; ++cell) {
    const Vec3 n = cells->middle(cell).n, over = 0.5 * (cells->corner(cell, 0) + cells->corner(cell, 1));
    const Vec3 across = (over - cells->middle(cell).x).normalized();
    CurvedFacets::Meeting last;
    for (int k = -30; k <= 30; ++k) {
      const Vec3 origin = over - 1e-3 * n + k * 1e-7 * across;
      CurvedFacets::Meeting there;
      ASSERT_TRUE(facets.meet(origin, n, cell, memory, there));
      if (k > -30) {
        EXPECT_LT(std::abs(there.distance - last.distance), 1e-8);
        if (there.facet != last.facet) ++crossed;
      }
      last = there;
    }
  }
  EXPECT_GT(crossed, 50);
}

TEST(CurvedFacets, BeyondTheRimThereIsNoMeeting) {
  const auto cells = std::make_shared<const SmoothCells>(test::sheet(0.01, 4), make_plane({}, false));
  const CurvedFacets facets(cells);
  CurvedFacets::Memory memory;
  CurvedFacets::Meeting there;
  EXPECT_TRUE(facets.meet({5e-3, 1e-3, -1e-3}, Vec3::UnitZ(), 0, memory, there));
  EXPECT_NEAR(there.distance, 1e-3, 1e-15);
  EXPECT_FALSE(facets.meet({15e-3, 1e-3, -1e-3}, Vec3::UnitZ(), 0, memory, there));
  EXPECT_FALSE(facets.meet({5e-3, 1e-3, -1e-3}, Vec3::UnitX(), 0, memory, there)) << "along the sheet";
}

}  // namespace
}  // namespace genu
