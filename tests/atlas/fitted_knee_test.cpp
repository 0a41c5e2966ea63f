// Insertions on other people's bones, against those that a statistical shape model knows by its vertices.
#include "genu/atlas/fitted_knee.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "genu/atlas/tolerances.h"
#include "support/point_mesh.h"

namespace genu {
namespace {

using test::as_mesh;

KneeAxes axes_of(const Affine& map, double scale) {
  const ReferenceKnee::Plateau& plateau = reference_knee().bone;
  return {map.linear.col(0) / scale, map.linear.col(1) / scale, map.linear.col(2) / scale,
          map(plateau.centre),       scale * plateau.width,     0};
}

/// The knee itself, larger, turned, and as its mirror image: the insertions are its own, with its own slack lengths.
TEST(FittedKnee, OfItselfIsItself) {
  const ReferenceKnee& knee = reference_knee();
  for (const double side : {1.0, -1.0}) {
    const double scale = 1.2;
    const Affine map{
        scale * Eigen::AngleAxisd(0.7, Vec3(1, 1, 0).normalized()).toRotationMatrix() * Vec3(1, 1, side).asDiagonal(),
        Vec3(0.1, -0.05, 0.3)};
    const FittedKnee fitted =
        fit_reference_knee(as_mesh(knee.femur.bone, map), as_mesh(knee.tibia.bone, map), axes_of(map, scale));
    EXPECT_EQ(fitted.reflected, side < 0);
    EXPECT_TRUE(fitted.femur.articular);  // all that is known of this femur
    EXPECT_FALSE(fitted.tibia.articular);
    EXPECT_LT(turned_against(fitted, axes_of(map, scale)), 1e-3);
    EXPECT_FALSE(fitted.femur.poor() || fitted.tibia.poor());
    const std::vector<double> slack = slack_lengths(fitted);
    int compared = 0;
    for (std::size_t i = 0; i < knee.fibres.size(); ++i) {
      const Insertion &femur = fitted.femur.insertions[i], &tibia = fitted.tibia.insertions[i];
      const double off = (femur.at - map(knee.fibres[i].femur)).norm() + (tibia.at - map(knee.fibres[i].tibia)).norm();
      EXPECT_LT(off, 2 * kOntoMesh) << knee.fibres[i].name;
      EXPECT_GE(femur.error, kPeopleDiffer);
      if (off > 2e-3) continue;  // put onto the bone from further off: another fibre
      ++compared;
      EXPECT_NEAR(slack[i], scale * knee.fibres[i].slack, off + 0.02 * scale * knee.fibres[i].slack)
          << knee.fibres[i].name;
    }
    EXPECT_GT(compared, 10);
  }
}

/// The fibres of a bundle go where its middle is given, and keep their places about it; others stay.
TEST(FittedKnee, TakesGivenEnds) {
  const ReferenceKnee& knee = reference_knee();
  const Affine map;
  const Mesh femur = as_mesh(knee.femur.bone, map), tibia = as_mesh(knee.tibia.bone, map);
  KneeAxes axes = axes_of(map, 1);
  const FittedKnee before = fit_reference_knee(femur, tibia, axes);
  const std::vector<std::string> lcl = {"LCL"}, acl = {"ACLam", "ACLpl"};
  const Vec3 lateral(0, 0, 0.02), away(0.01, 0.02, 0);
  axes.given = {{"LCL fibula", lcl, false, middle_of(before.tibia, lcl) + lateral, 1e-3},
                {"ACL femur", acl, true, middle_of(before.femur, acl) + away, 2e-3}};
  const FittedKnee after = fit_reference_knee(femur, tibia, axes);
  EXPECT_LT((middle_of(after.tibia, lcl) - axes.given[0].at).norm(), 1e-9);  // beside the tibia: as it was given
  EXPECT_LT((middle_of(after.femur, acl) - axes.given[1].at).norm(), 1e-9);  // of cartilage: put onto no mesh
  for (std::size_t i = 0; i < knee.fibres.size(); ++i) {
    const std::string& bundle = knee.fibres[i].bundle;
    const Insertion &f = after.femur.insertions[i], &t = after.tibia.insertions[i];
    const bool in_lcl = bundle == "LCL", in_acl = bundle == "ACLam" || bundle == "ACLpl";
    EXPECT_EQ(t.given, in_lcl ? "LCL fibula" : "");
    EXPECT_EQ(f.given, in_acl ? "ACL femur" : "");
    EXPECT_LT((t.at - before.tibia.insertions[i].at - (in_lcl ? lateral : Vec3(0, 0, 0))).norm(), 1e-9);
    EXPECT_LT((f.at - before.femur.insertions[i].at - (in_acl ? away : Vec3(0, 0, 0))).norm(), 1e-9);
    EXPECT_EQ(t.error, in_lcl ? 1e-3 : before.tibia.insertions[i].error);
    EXPECT_EQ(f.error, in_acl ? 2e-3 : before.femur.insertions[i].error);
  }
}

TEST(FittedKnee, OfABallIsPoor) {
  Mesh ball;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j <= 20; ++j) {
      const double a = 2 * 3.141592653589793 * i / 40, b = 3.141592653589793 * j / 20;
      ball.vertices.emplace_back(0.04 * std::sin(b) * std::cos(a), 0.04 * std::cos(b),
                                 0.04 * std::sin(b) * std::sin(a));
      if (j < 20) {
        const int k = i * 21 + j, next = (i + 1) % 40 * 21 + j;
        ball.triangles.push_back({k, k + 1, next});
        ball.triangles.push_back({k + 1, next + 1, next});
      }
    }
  const KneeAxes axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3(0, 0.04, 0), 0.08, 0};
  const FittedKnee fitted = fit_reference_knee(ball, ball, axes);
  EXPECT_TRUE(fitted.femur.poor() || fitted.tibia.poor());
}

}  // namespace
}  // namespace genu
