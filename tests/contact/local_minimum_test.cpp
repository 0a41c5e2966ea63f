// The descent to a local minimum of the gap: closed forms, monotonicity, and a grid that looks everywhere.
#include "genu/contact/local_minimum.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"

namespace genu {
namespace {

using test::random_pose;
using test::some_surfaces;

constexpr double kLongestStep = 1e-3;  // m

Pose placed_at(double x, double y, double z) { return {Mat3::Identity(), {x, y, z}}; }

TEST(LocalMinimum, SphereOverPlane) {
  const auto plane = make_plane({}, false), sphere = make_sphere({}, 0.02, false);
  for (const double height : {0.03, 0.02, 0.005}) {
    const auto d = descend_gap(*plane, *sphere, {exp_rotation({1, 2, 3}), {0.1, -0.2, height}}, {0.01, 0.01, 0.01},
                               {.max_step = kLongestStep});
    ASSERT_TRUE(d && d->settled);
    EXPECT_NEAR(d->minimum.gap, height - 0.02, 1e-15);
    EXPECT_NEAR((d->minimum.contact.a.p - Vec3(0.1, -0.2, 0)).norm(), 0, 1e-12);
  }
}

TEST(LocalMinimum, TorusOverPlane) {
  const auto plane = make_plane({}, false), torus = make_torus({}, 0.015, 0.005, false);
  // Its axis tilted from the plane's normal by b: the lowest point is R sin b + r below the centre.
  for (const double b : {0.2, 0.9, 1.5707963}) {
    const auto d = descend_gap(*plane, *torus, {exp_rotation({b, 0, 0}), {0, 0, 0.03}}, {0.003, -0.02, 0},
                               {.max_step = kLongestStep});
    ASSERT_TRUE(d && d->settled) << b;
    EXPECT_NEAR(d->minimum.gap, 0.03 - 0.015 * std::sin(b) - 0.005, 1e-15) << b;
  }
}

TEST(LocalMinimum, SphereAgainstSphereAndInSocket) {
  const auto ball = make_sphere({}, 0.01, false), other = make_sphere({}, 0.02, false),
             cup = make_sphere({}, 0.02, true);
  const Vec3 centre(0.001, 0.004, 0.002);
  const auto apart = descend_gap(*other, *ball, placed_at(0.02, 0.03, 0.01), {0, 0.01, 0}, {.max_step = kLongestStep});
  ASSERT_TRUE(apart && apart->settled);
  EXPECT_NEAR(apart->minimum.gap, Vec3(0.02, 0.03, 0.01).norm() - 0.03, 1e-15);
  const auto inside =
      descend_gap(*cup, *ball, {exp_rotation({0.3, 1, 2}), centre}, {0, 0, 0.01}, {.max_step = kLongestStep});
  ASSERT_TRUE(inside && inside->settled);
  EXPECT_NEAR(inside->minimum.gap, 0.02 - 0.01 - centre.norm(), 1e-15);
}

TEST(LocalMinimum, LeavesMaximaAndSaddles) {
  // Started exactly on a stationary point that is no minimum, where the gradient says nothing.
  constexpr double kFar = 5e-3;  // m
  const auto plane = make_plane({}, false), sphere = make_sphere({}, 0.02, false),
             torus = make_torus({}, 0.015, 0.005, false);
  const auto top = descend_gap(*plane, *sphere, placed_at(0, 0, 0.03), {0, 0, 0.02}, {.max_step = kFar});
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->minimum.gap, 0.01, 1e-14);
  const Pose upright{exp_rotation({1.5707963267948966, 0, 0}), {0, 0, 0.03}};
  const auto inner = descend_gap(*plane, *torus, upright, {0, 0.01, 0}, {.max_step = kFar});
  ASSERT_TRUE(inner);
  EXPECT_NEAR(inner->minimum.gap, 0.01, 1e-14);
}

TEST(LocalMinimum, NeverRaisesTheGap) {
  std::mt19937 random(2);
  const auto surfaces = some_surfaces();
  int settled = 0, started = 0;
  for (const auto& a : surfaces)
    for (const auto& b : surfaces)
      for (int repeat = 0; repeat < 20; ++repeat) {
        const SurfacePoint on_a = test::random_point(*a.surface, random), on_b = test::random_point(*b.surface, random);
        Pose X_ab = test::touching(on_a, on_b, 0.3);
        X_ab.p += 2e-3 * on_a.n;
        const SurfacePoint start = test::random_point(*b.surface, random);
        const auto before = a.surface->gap(X_ab * start.p);
        const auto d = descend_gap(*a.surface, *b.surface, X_ab, start.p, {.max_step = kLongestStep});
        if (!before || !d) continue;
        ++started;
        settled += d->settled ? 1 : 0;
        EXPECT_LE(d->minimum.gap, *before + 1e-14) << a.name << ' ' << b.name;
        const ContactGeometry& c = d->minimum.contact;
        EXPECT_NEAR(d->minimum.gap, c.a.n.dot(X_ab * c.b.p - c.a.p), 1e-15);
        const double sine = (c.a.T.transpose() * (X_ab.R * c.b.n)).norm();
        EXPECT_TRUE(!d->settled || sine < 2e-6) << a.name << ' ' << b.name << ' ' << sine;
      }
  EXPECT_GT(started, 500);
  EXPECT_GT(settled, 0.5 * started);  // planes and saddles leave some pairs without a minimum
}

TEST(LocalMinimum, EndsFartherAwayThanItIsAskedToLook) {
  // In a socket with 0.1 mm of clearance the gap falls all the way to where the ball rests.
  const auto cup = make_sphere({}, 0.0241, true), ball = make_sphere({}, 0.024, false);
  const Pose pressed = placed_at(0, 0, -1e-4);
  for (const double angle : {0.1, 0.5, 1.5}) {  // from the lowest point, rad
    const Vec3 start = 0.024 * Vec3(std::sin(angle), 0, -std::cos(angle));
    const double way = 2 * 0.024 * std::sin(angle / 2);
    EXPECT_FALSE(descend_gap(*cup, *ball, pressed, start, {.max_step = 1e-3, .farthest = 0.9 * way}));
    const auto d = descend_gap(*cup, *ball, pressed, start, {.max_step = 1e-3, .farthest = 1.1 * way});
    ASSERT_TRUE(d && d->settled) << angle;
    EXPECT_NEAR(d->minimum.gap, 0, 1e-15);
  }
}

TEST(LocalMinimum, FallsOffTheEndOfAnUnboundedSlope) {
  // A tilted plane over a plane has no minimum: the descent must not claim one.
  const auto plane = make_plane({}, false), over = make_plane({}, true);
  const auto d =
      descend_gap(*plane, *over, {exp_rotation({0.1, 0, 0}), {0, 0, 0.01}}, Vec3::Zero(), {.max_step = kLongestStep});
  EXPECT_TRUE(!d || !d->settled);
}

TEST(LocalMinimum, ClosestPointIsExact) {
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

TEST(LocalMinimum, NothingLiesLowerOnAGrid) {
  // The lowest of the minima reached from coarse samples is the lowest point of a fine grid, to the grid's sagitta.
  std::mt19937 random(4);
  const auto torus = make_torus({}, 0.015, 0.005, false), ellipsoid = make_ellipsoid({}, {0.012, 0.018, 0.025}, false);
  const double fine = 0.4e-3;
  const auto coarse_samples = ellipsoid->samples(4e-3, Vec3::Zero(), 1),
             grid = ellipsoid->samples(fine, Vec3::Zero(), 1);
  for (int i = 0; i < 12; ++i) {
    Pose X_ab = random_pose(random, 1e-3);
    X_ab.p += 0.04 * Vec3(std::cos(i), std::sin(i), 0.3 * std::cos(3 * i)).normalized();
    double lowest = std::numeric_limits<double>::infinity(), refined = lowest;
    for (const Vec3& p : grid.points) lowest = std::min(lowest, torus->gap(X_ab * p).value_or(lowest));
    for (const Vec3& p : coarse_samples.points)
      if (const auto d = descend_gap(*torus, *ellipsoid, X_ab, p, {.max_step = kLongestStep}))
        refined = std::min(refined, d->minimum.gap);
    EXPECT_LE(refined, lowest + 1e-15) << i;
    const double sagitta = fine * fine / 2 * (1 / 0.005 + 0.025 / (0.012 * 0.012));
    EXPECT_GT(refined, lowest - sagitta) << i;
  }
}

/// The settled minima that plain descents from the samples of B find, each once.
std::vector<Descent> minima_of(const Surface& A, const Surface& B, const Pose& X_ab, const SampleSet& starts) {
  std::vector<Descent> out;
  for (const Vec3& p : starts.points) {
    const auto d = descend_gap(A, B, X_ab, p, {.max_step = kLongestStep});
    if (!d || !d->settled) continue;
    const Vec3& end = d->minimum.contact.b.p;
    if (std::none_of(out.begin(), out.end(),
                     [&](const Descent& o) { return (o.minimum.contact.b.p - end).norm() < 1e-6; }))
      out.push_back(*d);
  }
  return out;
}

TEST(LocalMinimum, EndsEarlyInTheBowlOfAKnownMinimumAndNowhereElse) {
  // What ends in a bowl must be on its way to that minimum, as the whole descent shows, also where there are several.
  std::mt19937 random(11);
  const auto surfaces = some_surfaces();
  constexpr double kBowl = 6 * kLongestStep;
  int early = 0, near = 0;
  for (const auto& a : surfaces)
    for (const auto& b : surfaces)
      for (int repeat = 0; repeat < 4; ++repeat) {
        const SurfacePoint on_a = test::random_point(*a.surface, random), on_b = test::random_point(*b.surface, random);
        Pose X_ab = test::touching(on_a, on_b, 0.3);
        X_ab.p += 2e-3 * on_a.n;
        const SampleSet starts = b.surface->samples(2e-3, on_b.p, 0.02);
        const auto all = minima_of(*a.surface, *b.surface, X_ab, starts);
        for (const Descent& known : all) {
          if (known.bend.norm() < 1e-9) continue;  // on a plateau every point is a minimum
          const std::vector<Descent> one{known};
          for (const Vec3& start : starts.points) {
            if ((start - known.minimum.contact.b.p).norm() > kBowl) continue;
            const DescentLimits plain{.max_step = kLongestStep};
            DescentLimits limits = plain;
            limits.known = &one;
            limits.bowl = kBowl;
            const auto whole = descend_gap(*a.surface, *b.surface, X_ab, start, plain);
            if (!whole || !whole->settled) continue;
            const auto limited = descend_gap(*a.surface, *b.surface, X_ab, start, limits);
            const double off = (whole->minimum.contact.b.p - known.minimum.contact.b.p).norm();
            ++near;
            if (limited) continue;
            ++early;
            EXPECT_LT(off, 1e-5) << a.name << " under " << b.name << ": that minimum is not where this start leads";
          }
        }
      }
  EXPECT_GT(near, 1000);
  EXPECT_GT(early, 0.5 * near);
}

TEST(LocalMinimum, WhatIsKnownOfItsStartChangesNothing) {
  std::mt19937 random(12);
  for (const auto& a : some_surfaces())
    for (const auto& b : some_surfaces()) {
      const SurfacePoint on_a = test::random_point(*a.surface, random), on_b = test::random_point(*b.surface, random);
      Pose X_ab = test::touching(on_a, on_b, 0.3);
      X_ab.p += 1e-3 * on_a.n;
      const SurfacePoint start = test::random_point(*b.surface, random);
      SurfacePoint own, foot;
      if (!b.surface->project(start.p, own) || !a.surface->project(X_ab * start.p, foot)) continue;
      const DescentLimits limits{.max_step = kLongestStep};
      const auto asked = descend_gap(*a.surface, *b.surface, X_ab, start.p, limits),
                 told = descend_gap(*a.surface, *b.surface, X_ab, start.p, limits, {&own, &foot});
      ASSERT_EQ(asked.has_value(), told.has_value()) << a.name << ' ' << b.name;
      if (!asked || !asked->settled || !told->settled) continue;
      EXPECT_NEAR(asked->minimum.gap, told->minimum.gap, 1e-15) << a.name << ' ' << b.name;
    }
}

}  // namespace
}  // namespace genu
