// The gap of a point to a surface and its derivatives: finite differences, exact feet, and how rough a rough one is.
#include "genu/contact/gap_jet.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"
#include "support/blend_torus.h"
#include "support/finite_difference.h"

namespace genu {
namespace {

using test::some_surfaces;

TEST(GapJet, DerivativesAreThoseOfTheGap) {
  std::mt19937 random(3);
  const auto surfaces = some_surfaces();
  for (const auto& a : surfaces)
    for (const auto& b : surfaces) {
      GapJet jet;
      jet.b = test::random_point(*b.surface, random);
      const SurfacePoint on_a = test::random_point(*a.surface, random);
      Pose X_ab = test::touching(on_a, jet.b, 0.3);
      X_ab.R = X_ab.R * exp_rotation({0.05, -0.1, 0.07});
      X_ab.p = on_a.p + 5e-4 * on_a.n - X_ab.R * jet.b.p;
      ASSERT_TRUE(evaluate_gap(*a.surface, X_ab, &on_a, jet));
      const auto beside = [&](const Vec2& ds) {
        GapJet out;
        EXPECT_TRUE(b.surface->retract(jet.b, ds, out.b) && evaluate_gap(*a.surface, X_ab, &jet.a, out));
        return out;
      };
      for (int axis = 0; axis < 2; ++axis) {
        const double slope = test::derivative([&](double s) { return beside(s * Vec2::Unit(axis)).value; }, 1e-6);
        EXPECT_NEAR(slope, jet.gradient[axis], 1e-8) << a.name << ' ' << b.name;
        // Of second order along the surface: the retraction has no acceleration of its own.
        const double h = 2e-5;
        const double bend =
            (beside(h * Vec2::Unit(axis)).value - 2 * jet.value + beside(-h * Vec2::Unit(axis)).value) / (h * h);
        EXPECT_NEAR(bend, jet.bend()(axis, axis), 1e-4 * (jet.bend().norm() + 100)) << a.name << ' ' << b.name;
      }
    }
}

TEST(GapJet, ClosestPointIsExact) {
  std::mt19937 random(8);
  for (const auto& s : some_surfaces()) {
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
      const SurfacePoint foot = test::random_point(*s.surface, random);
      const double height = 1e-3;
      SurfacePoint found;
      ASSERT_TRUE(s.surface->project(foot.p + height * foot.n + 1e-4 * foot.T.col(0), found));
      ASSERT_TRUE(closest_point(*s.surface, foot.p + height * foot.n, found));
      worst = std::max(worst, (found.p - foot.p).norm());
    }
    EXPECT_LT(worst, 1e-15) << s.name;
  }
}

TEST(GapJet, ARoughOneErrsByTheThirdOrderOfTheStep) {
  const auto torus = test::build(test::jittered_torus(0.015, 0.005, 1e-3));
  double value[2] = {0, 0}, gradient[2] = {0, 0};
  for (int i = 0; i < 30; ++i) {
    GapJet from;
    ASSERT_TRUE(torus->project(test::torus_point(i, 1.7 * i), from.b));
    SurfacePoint on_a;
    ASSERT_TRUE(torus->project(test::torus_point(2.3 * i, 0.7 * i), on_a));
    Pose X_ab = test::touching(on_a, from.b, i);
    X_ab.p += 1e-4 * on_a.n;
    ASSERT_TRUE(evaluate_gap(*torus, X_ab, &on_a, from));
    for (int k = 0; k < 2; ++k) {
      const Vec2 ds = 6e-4 / (1 << k) * Vec2(std::cos(i), std::sin(i));
      GapJet rough, exact;
      ASSERT_TRUE(torus->retract_roughly(from.b, ds, rough.b) &&
                  evaluate_gap_roughly(*torus, X_ab, &from.a, 0.01 * ds.norm(), rough));
      ASSERT_TRUE(torus->retract(from.b, ds, exact.b) && evaluate_gap(*torus, X_ab, nullptr, exact));
      value[k] = std::max(value[k], std::abs(rough.value - exact.value));
      gradient[k] = std::max(gradient[k], (rough.b.p - exact.b.p).norm());
    }
  }
  EXPECT_LT(value[0], 2e-8);  // of 6e-4
  EXPECT_LT(value[1], value[0] / 4);
  EXPECT_LT(gradient[0], 1e-8);
  EXPECT_LT(gradient[1], gradient[0] / 8);
}

TEST(GapJet, AnUnsteadyFootIsLookedForAnew) {
  // From beyond the centre of a sphere the far side is nearer, and from a foot given on this side it has to be found.
  const auto ball = make_sphere({}, 0.02, false);
  GapJet jet;
  SurfacePoint top, x;
  ASSERT_TRUE(ball->project({0, 0, 0.02}, top));
  jet.b.p = {0, 1e-3, -0.005};
  jet.b.T = tangent_basis(jet.b.n);
  ASSERT_TRUE(evaluate_gap(*ball, {}, &top, jet));
  EXPECT_NEAR(jet.value, std::hypot(1e-3, 0.005) - 0.02, 1e-15);
  EXPECT_LT(jet.a.p.z(), 0);
}

}  // namespace
}  // namespace genu
