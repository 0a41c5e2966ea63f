#include "genu/contact/surface_change.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "support/finite_difference.h"

namespace genu {
namespace {

/// The point after every point of its surface has moved along its normal.
SurfacePoint moved(SurfacePoint point, const SurfaceChange& change, double s) {
  point.p += s * change.w * point.n;
  const Vec3 n = (point.n - s * (point.T * change.gradient)).normalized();
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(point.n, n).toRotationMatrix();
  point.n = n;
  point.T = turn * point.T;
  return point;
}

TEST(SurfaceChange, IsTheDerivativeOfTheContactEquations) {
  const Pose X_Wa{exp_rotation(Vec3(0.2, -0.3, 0.1)), Vec3(0.01, 0.02, 0.03)},
      X_Wb{exp_rotation(Vec3(-0.1, 2.9, 0.2)), Vec3(0.012, 0.018, 0.05)};
  ContactGeometry contact;
  ASSERT_TRUE(make_ellipsoid(Pose(), Vec3(0.02, 0.03, 0.025), false)->project(Vec3(0.001, 0.002, 0.03), contact.a));
  ASSERT_TRUE(make_torus(Pose(), 0.02, 0.01, false)->project(Vec3(0.02, 0.003, 0.012), contact.b));
  // Neither closed nor opposed: every term of the derivative is asked for.
  const SurfaceChange a{0.7e-3, Vec2(0.03, -0.05)}, b{-0.4e-3, Vec2(-0.02, 0.06)};
  constexpr double kForce = 120;
  const auto state = [&](double s) {
    ContactBlock block;
    evaluate_contact(X_Wa, X_Wb, {moved(contact.a, a, s), moved(contact.b, b, s)}, kForce, block);
    return Eigen::VectorXd((Eigen::VectorXd(17) << block.residual, kForce * block.direction).finished());
  };
  const Eigen::VectorXd truth = test::derivative(state, 1e-2);
  const ContactChange rate = contact_change(X_Wa, X_Wb, contact, kForce, a, b);
  const Eigen::VectorXd exact = (Eigen::VectorXd(17) << rate.residual, rate.wrench).finished();
  const double error = (exact - truth).cwiseAbs().cwiseQuotient(truth.cwiseAbs().cwiseMax(1e-4)).maxCoeff();
  std::printf("worst relative error %.2g\n", error);
  EXPECT_LT(error, 1e-7) << exact.transpose() << "\n" << truth.transpose();
}

TEST(SurfaceChange, OfASphereMovedGrownAndTurned) {
  SurfacePoint point;
  ASSERT_TRUE(make_sphere(Pose(), 0.02, false)->project(Vec3(0.3, 0.4, 0.5), point));
  const SurfaceChange grown = change_of_field(point, point.p / 0.02, Mat3::Identity() / 0.02);
  EXPECT_NEAR(grown.w, 1, 1e-14);
  EXPECT_NEAR(grown.gradient.norm(), 0, 1e-13);
  const Vec3 axis(1, 2, 3);
  const SurfaceChange turned = change_of_field(point, axis.cross(point.p), skew(axis));
  EXPECT_NEAR(turned.w, 0, 1e-14);
  EXPECT_NEAR(turned.gradient.norm(), 0, 1e-13);
  const SurfaceChange shifted = change_of_field(point, axis, Mat3::Zero());
  EXPECT_NEAR(shifted.w, axis.dot(point.n), 1e-14);
  EXPECT_NEAR((point.T * shifted.gradient - (axis - point.n * point.n.dot(axis)) / 0.02).norm(), 0, 1e-11);
}

}  // namespace
}  // namespace genu
