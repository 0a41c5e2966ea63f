// Which way surfaces face: sheets of closed forms, right way round, turned, apart, touching and overlapping.
#include "genu/assemble/facing.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

/// z = height + bend (x^2 + y^2) over a square of 2 * half, m; its outward side up or down.
Mesh sheet(double half, double height, double bend, bool up) {
  constexpr int n = 16;
  Mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = half * (2.0 * i / n - 1), y = half * (2.0 * j / n - 1);
      mesh.vertices.emplace_back(x, y, height + bend * (x * x + y * y));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back(up ? std::array{a, b, b + 1} : std::array{a, b + 1, b});
      mesh.triangles.push_back(up ? std::array{a, b + 1, a + 1} : std::array{a, a + 1, b + 1});
    }
  return mesh;
}

constexpr double kCondyle = 25, kPlateau = 5;  // 1/m: half the curvature

TEST(Facing, OfBonesThatAreApartTouchOrOverlap) {
  for (const double gap : {5e-3, 1e-4, 0.0, -1e-4, -2e-3, -20e-3}) {
    const Mesh condyle = sheet(0.01, gap, kCondyle, false), plateau = sheet(0.015, 0, kPlateau, true);
    EXPECT_EQ(how_they_face(condyle, plateau), Facing::opposed) << gap;
    EXPECT_EQ(how_they_face(plateau, condyle), Facing::opposed) << gap;
  }
}

TEST(Facing, BacksFaceEachOtherWhereBothAreInsideOut) {
  for (const double gap : {5e-3, 2e-4, 1e-6}) {
    const Mesh condyle = sheet(0.01, gap, kCondyle, true), plateau = sheet(0.015, 0, kPlateau, false);
    EXPECT_EQ(how_they_face(condyle, plateau), Facing::away) << gap;
    EXPECT_EQ(how_they_face(plateau, condyle), Facing::away) << gap;
  }
}

TEST(Facing, TheSameWayWhereOneIsInsideOut) {
  for (const double gap : {5e-3, 2e-4})
    for (const bool up : {true, false})
      EXPECT_EQ(how_they_face(sheet(0.01, gap, kCondyle, up), sheet(0.015, 0, kPlateau, up)), Facing::same_way) << gap;
}

TEST(Facing, IsUnknownWhereNothingIsInFront) {
  EXPECT_EQ(how_they_face(sheet(0.01, 1, 0, false), sheet(0.01, 0, 0, true)), Facing::unknown);
  EXPECT_EQ(how_they_face(sheet(0.01, 0, 0, true), Mesh{}), Facing::unknown);
}

TEST(Facing, FlatPlatesThatOverlapAreOpposed) {
  EXPECT_EQ(how_they_face(sheet(0.01, -1e-4, 0, false), sheet(0.015, 0, 0, true)), Facing::opposed);
}

}  // namespace
}  // namespace genu
