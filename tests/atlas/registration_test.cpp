// Maps of the reference knee onto itself, moved and bent by known amounts, are found again.
#include "genu/atlas/registration.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "genu/atlas/reference_knee.h"

namespace genu {
namespace {

/// Points taken along by `map`, their normals by its linear part.
std::vector<FacingPoint> moved(const std::vector<FacingPoint>& points, const Affine& map) {
  std::vector<FacingPoint> out = points;
  const Mat3 turn = map.linear.inverse().transpose();
  for (FacingPoint& p : out) p = {map(p.at), (turn * p.normal).normalized()};
  return out;
}

double largest_error(const Registration& found, const std::vector<FacingPoint>& points, const Affine& map) {
  double most = 0;
  for (const FacingPoint& p : points) most = std::max(most, (found.map(p.at) - map(p.at)).norm());
  return most;
}

Affine affine_of(double angle, const Vec3& axis, const Vec3& scale, const Vec3& shift) {
  return {Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix() * scale.asDiagonal(), shift};
}

TEST(Registration, FindsAnAffineMap) {
  const std::vector<FacingPoint>& femur = reference_knee().femur.bone;
  const Affine map = affine_of(0.3, Vec3(1, 2, -1), Vec3(1.1, 0.95, 1.04), Vec3(0.01, -0.02, 0.005));
  const Affine start{Mat3::Identity(), map.shift};
  const Registration found = register_points(femur, PointTree(moved(femur, map)), std::vector{start});
  EXPECT_LT(largest_error(found, femur, map), 2e-5);
  EXPECT_LT(found.median, 1e-5);
  EXPECT_EQ(found.matched, 1);
}

/// A left knee: the map turns right into left, and normals still face outward.
TEST(Registration, FindsAMirrorImage) {
  const std::vector<FacingPoint>& tibia = reference_knee().tibia.bone;
  Affine map = affine_of(0.2, Vec3(0, 1, 1), Vec3(0.9, 0.9, -0.9), Vec3(0.01, 0, 0));
  const Affine start{Vec3(1, 1, -1).asDiagonal(), Vec3::Zero()};
  const Registration found = register_points(tibia, PointTree(moved(tibia, map)), std::vector{start});
  EXPECT_LT(largest_error(found, tibia, map), 2e-5);
}

TEST(Registration, TakesTheStartThatFits) {
  const std::vector<FacingPoint>& femur = reference_knee().femur.bone;
  const Affine upside_down = affine_of(3.1, Vec3::UnitX(), Vec3::Ones(), Vec3(0, 0, 0.03));
  const Registration found = register_points(femur, PointTree(femur), std::vector{upside_down, Affine{}});
  EXPECT_LT(found.median, 1e-5);
}

/// A smooth field of 3 mm over 40 mm: what is between the points goes along.
TEST(Registration, FollowsASmoothField) {
  const std::vector<FacingPoint>& femur = reference_knee().femur.bone;
  const auto bent = [](const Vec3& p) {
    return Vec3(p + 3e-3 * Vec3(std::sin(p.z() / 0.02), std::cos(p.x() / 0.025), std::sin(p.y() / 0.03)));
  };
  std::vector<FacingPoint> target = femur;
  for (FacingPoint& p : target) p.at = bent(p.at);  // normals turn by less than what partners may differ by
  const Registration found = register_points(femur, PointTree(target), std::vector{Affine{}});
  std::vector<double> errors;
  for (const ReferenceFibre& fibre : reference_knee().fibres)
    errors.push_back((found.map(fibre.femur) - bent(fibre.femur)).norm());
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 1.5e-3);
  EXPECT_LT(errors.back(), 4e-3);
}

/// Half a bone has half its partners; the half that is there is matched.
TEST(Registration, OfABoneCutShort) {
  const std::vector<FacingPoint>& tibia = reference_knee().tibia.bone;
  std::vector<FacingPoint> upper = tibia;
  std::erase_if(upper, [](const FacingPoint& p) { return p.at.y() < -0.05; });
  const Affine start = affine_of(0.1, Vec3(1, 0, 1), Vec3::Ones(), Vec3(2e-3, 3e-3, 0));
  const Registration found = register_points(tibia, PointTree(upper), std::vector{start});
  double most = 0;
  for (const FacingPoint& p : upper) most = std::max(most, (found.map(p.at) - p.at).norm());
  EXPECT_LT(most, 1.5e-3);
  EXPECT_LT(found.matched, 0.95);
}

TEST(Registration, OfNothing) {
  EXPECT_EQ(register_points({}, PointTree({}), std::vector{Affine{}}).matched, 0);
  EXPECT_EQ(register_points(reference_knee().femur.bone, PointTree(reference_knee().femur.bone), {}).matched, 0);
}

TEST(Similarity, IsFound) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const bool reflects : {false, true}) {
    const Affine map = affine_of(1.2, Vec3(1, -1, 2), Vec3(1.3, 1.3, reflects ? -1.3 : 1.3), Vec3(1, 2, 3));
    std::vector<Vec3> from(9), to;
    for (Vec3& p : from)
      for (double& x : p) x = normal(random);
    for (const Vec3& p : from) to.push_back(map(p));
    const Affine found = similarity(from, to, reflects);
    EXPECT_LT((found.linear - map.linear).norm(), 1e-12);
    EXPECT_LT((found.shift - map.shift).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace genu
