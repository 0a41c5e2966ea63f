// The descent to a local minimum of the gap: closed forms, monotonicity, and a grid that looks everywhere.
#include "genu/contact/local_minimum.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"
#include "genu/contact/proximity.h"
#include "support/blend_torus.h"
#include "support/moved_surface.h"

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

TEST(LocalMinimum, IsWhereADescentThatIsNeverRoughEnds) {
  // The same torus as a mesh; MovedSurface takes no rough steps.
  const std::shared_ptr<const Surface> torus = test::build(test::jittered_torus(0.015, 0.005, 1e-3));
  const test::MovedSurface exact(torus, 0, Vec3::Zero());
  std::mt19937 random(14);
  int settled = 0, same = 0;
  for (int i = 0; i < 40; ++i) {
    SurfacePoint on_a, on_b;
    ASSERT_TRUE(torus->project(test::torus_point(i, 1.7 * i), on_a));
    ASSERT_TRUE(torus->project(test::torus_point(2.3 * i, 0.7 * i), on_b));
    const Pose X_ab = test::touching(on_a, on_b, i);
    SurfacePoint start;
    if (!torus->retract(on_b, 2e-3 * Vec2(std::cos(i), std::sin(i)), start)) continue;
    const auto rough = descend_gap(*torus, *torus, X_ab, start.p, {.max_step = kLongestStep}),
               plain = descend_gap(exact, exact, X_ab, start.p, {.max_step = kLongestStep});
    ASSERT_EQ(bool(rough), bool(plain)) << i;
    if (!plain || !plain->settled) continue;
    ++settled;
    EXPECT_TRUE(rough->settled) << i;
    // Another bowl may be as near to where both began; a flat one has an end only to the root of rounding.
    if (std::abs(rough->minimum.gap - plain->minimum.gap) > 1e-14) continue;
    ++same;
    EXPECT_NEAR((rough->minimum.contact.b.p - plain->minimum.contact.b.p).norm(), 0, 1e-9) << i;
    EXPECT_NEAR((rough->minimum.contact.a.p - plain->minimum.contact.a.p).norm(), 0, 1e-9) << i;
    const ContactGeometry& c = rough->minimum.contact;
    EXPECT_NEAR((c.a.T.transpose() * (X_ab.R * c.b.n)).norm(), 0, 2e-9) << i;
  }
  EXPECT_GE(settled, 20);
  EXPECT_GE(same, 0.9 * settled);
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

struct Bowls {
  int near = 0, early = 0, rivals = 0;  ///< starts; ended early; that lead to another minimum than the known one
};

/// Whether only starts that lead to a known minimum end early, as whole descents show, with steps too small to leap
/// into another bowl.
void check_bowls(const std::string& name, const Surface& A, const Surface& B, const Pose& X_ab, const SampleSet& starts,
                 Bowls& out) {
  for (const Descent& known : minima_of(A, B, X_ab, starts)) {
    if (known.bend.norm() < 1e-9) continue;  // on a plateau every point is a minimum
    const std::vector<Descent> one{known};
    DescentLimits limits{.max_step = kLongestStep};
    limits.known = one;
    limits.same = 0.1 * kLongestStep;
    limits.bowl = 6 * kLongestStep;
    for (const Vec3& start : starts.points) {
      if ((start - known.minimum.contact.b.p).norm() > limits.bowl) continue;
      const auto whole = descend_gap(A, B, X_ab, start, {.max_step = 0.1 * kLongestStep});
      if (!whole || !whole->settled) continue;
      const double off = (whole->minimum.contact.b.p - known.minimum.contact.b.p).norm();
      const bool early = !descend_gap(A, B, X_ab, start, limits);
      ++out.near;
      out.rivals += off > 2 * limits.same;
      out.early += early;
      EXPECT_FALSE(early && off > 2 * limits.same) << name << ": that start leads " << off << " m away";
    }
  }
}

TEST(LocalMinimum, EndsEarlyInTheBowlOfAKnownMinimumAndNowhereElse) {
  std::mt19937 random(11);
  const auto surfaces = some_surfaces();
  Bowls bowls;
  for (const auto& a : surfaces)
    for (const auto& b : surfaces)
      for (int repeat = 0; repeat < 2; ++repeat) {
        const SurfacePoint on_a = test::random_point(*a.surface, random), on_b = test::random_point(*b.surface, random);
        Pose X_ab = test::touching(on_a, on_b, 0.3);
        X_ab.p += 2e-3 * on_a.n;
        check_bowls(a.name + " under " + b.name, *a.surface, *b.surface, X_ab, b.surface->samples(2e-3, on_b.p, 0.02),
                    bowls);
      }
  EXPECT_GT(bowls.near, 500);
  EXPECT_GT(bowls.early, 0.5 * bowls.near);
}

TEST(LocalMinimum, TwoWellsBesideEachOtherAreTwoBowls) {
  // z = -along / (2 apart^2) (x^2 - apart^2 / 4)^2 - across / 2 y^2: two bumps, seen from above by a plane.
  const auto plane = make_plane({exp_rotation({3.14159265358979312, 0, 0}), Vec3::Zero()}, false);
  Bowls bowls;
  for (const double apart : {1e-3, 1.7e-3, 3e-3, 5e-3})
    for (const double along : {20.0, 100.0, 500.0})
      for (const double across : {20.0, 500.0})
        for (const double lean : {0.0, 2e-3}) {
          const double a = along / (2 * apart * apart), h = apart * apart / 4;
          const auto floor = make_polynomial(
              {},
              {{4, 0, -a}, {2, 0, 2 * a * h}, {0, 0, -a * h * h}, {1, 0, lean * along * apart}, {0, 2, -across / 2}},
              false);
          check_bowls("two wells", *plane, *floor, {}, floor->samples(0.5e-3, Vec3::Zero(), 6e-3), bowls);
        }
  EXPECT_GT(bowls.rivals, 1000);
  EXPECT_GT(bowls.early, 1000);
}

TEST(LocalMinimum, BothFacesOfAThinBodyInASlotAreFound) {
  // Straight opposite of a known minimum everything is the same but the side.
  const auto slot = make_ellipsoid({}, {0.06, 0.06, 2.51e-3}, true),
             plate = make_ellipsoid({}, {0.02, 0.02, 2.5e-3}, false);
  Bowls bowls;
  check_bowls("slot", *slot, *plate, {}, plate->samples(1e-3, Vec3::Zero(), 0.1), bowls);
  EXPECT_GT(bowls.rivals, 20);
  EXPECT_GT(bowls.early, 20);
  Proximity proximity(*slot, *plate, {.spacing = 1e-3, .reach = 0.1});
  ProximityScan scan;
  proximity.scan({}, 1e-3, scan);
  ASSERT_EQ(scan.minima.size(), 2U);
  for (const LocalMinimum& m : scan.minima) EXPECT_NEAR(m.gap, 1e-5, 1e-12);
}

TEST(LocalMinimum, WhatIsKnownOfItsStartChangesNothing) {
  std::mt19937 random(12);
  int compared = 0;
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
      ++compared;
    }
  EXPECT_GT(compared, 12);
}

TEST(LocalMinimum, AScanRemembersNoFootOfAnotherPose) {
  const auto plane = make_plane({}, false), ball = make_ellipsoid({}, {0.02, 0.03, 0.025}, false);
  const Proximity::Options options{.spacing = 1e-3, .reach = 0.1};
  const Pose here{exp_rotation({0.3, 0.2, 0}), {1e-3, 0, 0.0252}}, there{exp_rotation({0.5, -0.1, 1}), {0, 0, 0.0245}};
  Proximity used(*plane, *ball, options), fresh(*plane, *ball, options);
  ProximityScan scan, other;
  std::vector<NearSample> near;
  used.scan(there, 2e-3, scan);
  used.near_samples(there, 2e-3, near);
  used.scan(here, 2e-3, scan);
  fresh.scan(here, 2e-3, other);
  ASSERT_EQ(scan.minima.size(), other.minima.size());
  ASSERT_FALSE(scan.minima.empty());
  for (std::size_t k = 0; k < scan.minima.size(); ++k) EXPECT_EQ(scan.minima[k].gap, other.minima[k].gap);
}

}  // namespace
}  // namespace genu
