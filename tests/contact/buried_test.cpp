// What lies deeper in the other surface than a layer's rays look is noticed, from either side; what is outside is not.
#include "genu/contact/buried.h"

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

constexpr double kSearchDepth = 4e-3;

double deepest(const Mesh& a, const Mesh& b, const Pose& X_ab) {
  const Buried buried({&a, std::make_shared<const TriangleTree>(a)}, {&b, std::make_shared<const TriangleTree>(b)},
                      kSearchDepth);
  Buried::Memory memory;
  return buried.deepest(X_ab, memory);
}

/// From both sides, named either way.
double both(const Mesh& a, const Mesh& b, const Pose& X_ab) {
  const double one = deepest(a, b, X_ab), other = deepest(b, a, X_ab.inverse());
  EXPECT_NEAR(one, other, 1e-12);
  return one;
}

TEST(Buried, ABallInABlock) {
  const Mesh ball = test::ball(0.01, 2e-3), large = test::ball(0.05, 5e-3);
  for (const double at : {0.065, 0.0601, 0.0599, 0.058})
    EXPECT_EQ(both(large, ball, {Mat3::Identity(), {at, 0, 0}}), 0) << at;
  for (const double at : {0.05, 0.03, 0.0}) {
    const double found = both(large, ball, {exp_rotation({0.3, 0.2, 0.1}), {at, 0, 0}});
    EXPECT_GT(found, kSearchDepth) << at;
    EXPECT_LE(found, 0.1) << at;
  }
}

TEST(Buried, ABallInItsSocketIsNot) {
  const Mesh ball = test::ball(0.02, 3e-3);
  Mesh socket = test::ball(0.021, 3e-3);
  for (auto& t : socket.triangles) std::swap(t[1], t[2]);
  for (const double aside : {0.0, 0.8e-3, 2e-3}) EXPECT_EQ(both(socket, ball, {Mat3::Identity(), {aside, 0, 0}}), 0);
}

TEST(Buried, AboveAnOpenSheetIsNotButBehindItIs) {
  const Mesh ball = test::ball(5e-3, 1e-3), sheet = test::sheet(0.05, 30);
  for (const double up : {0.02, 5.1e-3, 4e-3, 2e-3})
    EXPECT_EQ(both(sheet, ball, {Mat3::Identity(), {0, 0, up}}), 0) << up;
  for (const double up : {-2e-3, -0.02})
    EXPECT_GT(both(sheet, ball, {Mat3::Identity(), {0, 0, up}}), kSearchDepth) << up;
}

TEST(Buried, AWalkIsToldAsEachPoseByItself) {
  const Mesh ball = test::ball(0.01, 2e-3), large = test::ball(0.05, 5e-3);
  const Buried follow({&large, std::make_shared<const TriangleTree>(large)},
                      {&ball, std::make_shared<const TriangleTree>(ball)}, kSearchDepth);
  Buried::Memory memory;
  int deep = 0;
  for (double at = 0.065; at > 0.03; at -= 0.5e-3) {
    const Pose X{exp_rotation({10 * at, 0, 0}), {at, 0, 0}};
    const double found = follow.deepest(X, memory);
    // The middle of the deepest triangle is 0.06 - at deep, or a little less.
    if (0.06 - at > kSearchDepth + 0.5e-3) {
      EXPECT_GT(found, kSearchDepth) << at;
      ++deep;
    }
    if (0.06 - at < 0.5 * kSearchDepth) {
      EXPECT_EQ(found, 0) << at;
    }
  }
  EXPECT_GT(deep, 40);
}

}  // namespace
}  // namespace genu
