#include "genu/contact/rim.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "genu/surface/blend_surface.h"
#include "genu/surface/patch.h"
#include "support/layers.h"

namespace genu {
namespace {

constexpr double kRollerRadius = 0.02, kHalf = 0.01;  // m

/// A roller along z of its frame, cut at both ends.
std::shared_ptr<const Surface> roller() {
  Patch patch;
  patch.box[2] = {-kHalf, kHalf};
  return make_patch(make_cylinder(Pose{}, kRollerRadius, false), Pose{}, patch, {false, false, true});
}

/// The roller lies along x of the plane, its middle `height` over it, one end lowered by the angle `tilt`.
Pose lying(double height, double tilt) {
  const Mat3 along_x = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()).toRotationMatrix();
  return {Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix() * along_x, Vec3(0, 0, height)};
}

std::vector<LocalMinimum> rims_of(const Surface& own, const Surface& other, const Pose& X_os) {
  Rim rim(own, other, 1e-3, Vec3::Zero(), 0.1);
  std::vector<LocalMinimum> out;
  rim.scan(X_os, out);
  return out;
}

TEST(Rim, OfALoweredEndIsFoundHoweverShallow) {
  const auto plane = make_plane(Pose{}, false);
  const auto own = roller();
  for (const double tilt : {0.001, 0.02, 0.3})
    for (const double deep : {1e-8, 1e-6, 1e-4}) {
      const double touching = kRollerRadius * std::cos(tilt) + kHalf * std::sin(tilt);
      const auto minima = rims_of(*own, *plane, lying(touching - deep, tilt));
      ASSERT_FALSE(minima.empty()) << tilt << " " << deep;
      for (const LocalMinimum& m : minima) EXPECT_LE(m.gap, 0);
      double lowest = 0;
      for (const LocalMinimum& m : minima) lowest = std::min(lowest, m.gap);
      EXPECT_NEAR(lowest, -deep, 1e-3 * deep + 1e-12) << tilt;
      EXPECT_TRUE(rims_of(*own, *plane, lying(touching + deep, tilt)).empty()) << tilt << " " << deep;
    }
}

TEST(Rim, WhereTheGapFallsInwardIsNone) {
  // A cap of a ball that is pressed into the plane up to its rim: its lowest point is inside.
  Patch patch;
  patch.box[2] = {-1.0, -0.019};
  const auto cap = make_patch(make_sphere(Pose{}, kRollerRadius, false), Pose{}, patch, {false, false, false});
  EXPECT_TRUE(rims_of(*cap, *make_plane(Pose{}, false), {Mat3::Identity(), Vec3(0, 0, 0.018)}).empty());
}

TEST(Rim, OfACornerOverASheetThatEndsSoonIsFound) {
  // Most of the segments that end at the corner are past the other's edge, where there is no gap.
  using R = std::pair<double, double>;
  constexpr double kSlope = 1e-3, kDeep = 1e-5, kOver = 1.2e-3;
  Patch square;
  square.box = {R{-kHalf, kHalf}, R{-kHalf, kHalf}, std::nullopt};
  const Pose down{Mat3(Vec3(1, -1, -1).asDiagonal()), Vec3::Zero()};
  const auto own = make_patch(make_plane(down, false), down, square, {true, true, false});
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Vec3 corner(x * kHalf, y * kHalf, 0);
      Patch end;  // from kOver inside the corner outward
      const auto outward = [&](double sign) {
        return sign > 0 ? R{kHalf - kOver, 3 * kHalf} : R{-3 * kHalf, kOver - kHalf};
      };
      end.box = {outward(x), outward(y), std::nullopt};
      const auto other = make_patch(make_plane(Pose{}, false), Pose{}, end, {true, true, false});
      const Mat3 lean = exp_rotation(kSlope * Vec3(-y, x, 0).normalized());
      const auto minima = rims_of(*own, *other, {lean, corner - lean * corner - Vec3(0, 0, kDeep)});
      ASSERT_FALSE(minima.empty()) << x << ' ' << y;
      for (const LocalMinimum& m : minima) EXPECT_NEAR(m.gap, -kDeep, 1e-3 * kDeep) << x << ' ' << y;
      EXPECT_EQ(minima.size(), 2U) << "both sides of the corner";
    }
}

TEST(Rim, SurfacesWithoutEdgesHaveNone) {
  const auto plane = make_plane(Pose{}, false);
  EXPECT_TRUE(Rim(*make_sphere(Pose{}, kRollerRadius, false), *plane, 1e-3, Vec3::Zero(), 0.1).empty());
  EXPECT_TRUE(Rim(*make_cylinder(Pose{}, kRollerRadius, false), *plane, 1e-3, Vec3::Zero(), 0.1).empty());
  EXPECT_FALSE(Rim(*roller(), *plane, 1e-3, Vec3::Zero(), 0.1).empty());
}

/// A ball whose middle is 4 mm past the edge of an open sheet touches its rim from the side.
TEST(Rim, OfAnOpenMeshAgainstAMesh) {
  constexpr double kRadius = 0.01;
  Diagnostics ignored;
  const auto own = BlendSurface::build(test::sheet(0.01, 10), {}, "sheet", ignored);
  const auto ball = make_sphere(Pose{}, kRadius, false);
  const auto other = BlendSurface::build(ball->triangles(1e-3, Vec3::Zero(), 0.1), {}, "ball", ignored);
  ASSERT_TRUE(own && other);
  Rim rim(*own, *other, 1e-3, Vec3::Zero(), 0.1);
  ASSERT_FALSE(rim.empty());
  const double touching = std::sqrt(kRadius * kRadius - 4e-3 * 4e-3);
  for (double height = touching + 5e-3; height > touching - 1e-4; height -= 0.7e-4) {
    std::vector<LocalMinimum> out;
    rim.scan({Mat3::Identity(), -Vec3(0.014, 0, height)}, out);
    if (std::abs(height - touching) < 1e-5) continue;  // the ball is known to that
    EXPECT_EQ(out.empty(), height > touching) << height - touching;
  }
}

/// What was looked at from afar is looked at again when it has come near.
TEST(Rim, RemembersNoLongerThanItMay) {
  const auto plane = make_plane(Pose{}, false);
  const auto own = roller();
  Rim rim(*own, *plane, 1e-3, Vec3::Zero(), 0.1);
  const double tilt = 0.02, touching = kRollerRadius * std::cos(tilt) + kHalf * std::sin(tilt);
  for (double height = touching + 0.05; height > touching - 1e-4; height -= 1.7e-4) {
    std::vector<LocalMinimum> out;
    rim.scan(lying(height, tilt), out);
    EXPECT_EQ(out.empty(), height >= touching) << height - touching;
  }
}

}  // namespace
}  // namespace genu
