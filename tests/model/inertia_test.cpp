#include "genu/model/inertia.h"

#include <gtest/gtest.h>

#include "genu/core/pose.h"

namespace genu {
namespace {

const Inertia kBody = {
    1.7, {0.1, -0.2, 0.05}, (Mat3() << 0.03, 0.001, 0.002, 0.001, 0.02, -0.003, 0.002, -0.003, 0.04).finished()};

/// Momentum [linear, angular about the origin] of point masses that are the body.
struct Cloud {
  Cloud() {
    // Six points on the principal axes of sum m x x^T = tr(I)/2 - I, and one at the centre with the rest of the mass.
    const Mat3 S = 0.5 * kBody.about_centre_of_mass.trace() * Mat3::Identity() - kBody.about_centre_of_mass;
    const Mat3 L = S.llt().matrixL();
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0})
        points.push_back(kBody.centre_of_mass + sign * std::sqrt(3 / 1.7) * L.col(k));
  }
  std::vector<Vec3> points;
};

Vec6 momentum(const Pose& X, const Vec6& twist, const Vec3& about) {
  Vec6 p = Vec6::Zero();
  for (const Vec3& point : Cloud().points) {
    const Vec3 r = X.R * point, v = Vec3(twist.head<3>()) + Vec3(twist.tail<3>()).cross(r);
    p.head<3>() += 1.7 / 6 * v;
    p.tail<3>() += 1.7 / 6 * (X.p + r - about).cross(v);
  }
  return p;
}

TEST(Inertia, IsThatOfItsParticles) {
  const Pose X = {exp_rotation(Vec3(0.4, -0.9, 1.3)), {0.5, 0.1, -0.3}};
  Vec6 twist;
  twist << 0.3, -0.2, 0.5, 2, -1, 3;
  const Vec6 p = momentum(X, twist, X.p);
  EXPECT_LT((mass_matrix(kBody, X.R) * twist - p).norm(), 1e-14);
  EXPECT_NEAR(kinetic_energy(kBody, X.R, twist), 0.5 * twist.dot(p), 1e-14);
}

TEST(Inertia, ForcesChangeTheMomentumOfItsParticles) {
  const Pose X = {exp_rotation(Vec3(0.4, -0.9, 1.3)), {0.5, 0.1, -0.3}};
  Vec6 twist, acceleration;
  twist << 0.3, -0.2, 0.5, 2, -1, 3;
  acceleration << -1, 2, 0.4, 5, 6, -7;
  // Moments about the place where the origin stands now.
  const auto at = [&](double t) {
    const Vec6 moved = t * twist + 0.5 * t * t * acceleration;
    return momentum(retract(X, moved), Vec6(twist + t * acceleration), X.p);
  };
  constexpr double kH = 1e-5;
  const Vec6 wrench = (at(kH) - at(-kH)) / (2 * kH);
  const Vec6 b = gyroscopic_wrench(kBody, X.R, twist.tail<3>());
  EXPECT_LT((mass_matrix(kBody, X.R) * acceleration + b - wrench).norm(), 1e-8 * wrench.norm());
  EXPECT_GT(b.norm(), 0.1);
}

}  // namespace
}  // namespace genu
