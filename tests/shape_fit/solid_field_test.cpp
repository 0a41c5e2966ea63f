#include "genu/shape_fit/solid_field.h"

#include <random>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"

namespace genu {
namespace {

using Shape = SolidPart::Shape;
using Operation = SolidPart::Operation;

const Pose kPose = {exp_rotation(Vec3(0.4, -1.1, 0.7)), {0.01, -0.02, 0.03}};

SolidPart part(Shape shape, Operation operation = Operation::join, double blend = 0) {
  SolidPart p;
  p.shape = shape;
  p.operation = operation;
  p.blend = blend;
  p.placement = kPose;
  p.radius = shape == Shape::box ? 0.004 : 0.02;
  p.end_radius = 0.008;
  p.radii = Vec3(0.02, 0.03, 0.04);
  p.from = Vec3(-0.01, 0.005, 0);
  p.to = Vec3(0.02, -0.005, 0.03);
  return p;
}

constexpr Shape kShapes[] = {Shape::sphere, Shape::ellipsoid, Shape::rod, Shape::torus, Shape::box, Shape::half_space};

class Points {
 public:
  Vec3 next() { return Vec3(uniform_(random_), uniform_(random_), uniform_(random_)); }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{-0.06, 0.06};
};

void expect_gradient(const std::function<SolidValue(const Vec3&)>& f, const Vec3& x, double tolerance) {
  constexpr double h = 1e-6;
  const SolidValue v = f(x);
  for (int k = 0; k < 3; ++k) {
    const double quotient = (f(x + h * Vec3::Unit(k)).f - f(x - h * Vec3::Unit(k)).f) / (2 * h);
    EXPECT_NEAR(v.gradient[k], quotient, tolerance) << "at " << x.transpose();
  }
}

/// Of the box and the rod, the gradient is continuous but its own derivative is not.
TEST(SolidField, GradientsOfShapes) {
  for (const Shape shape : kShapes) {
    SCOPED_TRACE(static_cast<int>(shape));
    Points points;
    for (int k = 0; k < 200; ++k) {
      const Vec3 x = points.next();
      const SolidPart p = part(shape);
      const Vec3 own = kPose.R.transpose() * (x - kPose.p);
      // Inside a box the nearest side changes with a jump.
      if (shape == Shape::box && part_value(p, x).f < -p.radius) continue;
      if (own.norm() < 2e-3) continue;
      expect_gradient([&](const Vec3& y) { return part_value(p, y); }, x, 2e-4);
    }
  }
}

TEST(SolidField, RoundShapesHaveTheDistanceOfTheirSurfaces) {
  Points points;
  const auto sphere = make_sphere(kPose, 0.02, false), torus = make_torus(kPose, 0.02, 0.008, false);
  const auto ellipsoid = make_ellipsoid(kPose, Vec3(0.02, 0.03, 0.04), false);
  for (int k = 0; k < 100; ++k) {
    const Vec3 x = points.next();
    EXPECT_NEAR(part_value(part(Shape::sphere), x).f, *sphere->gap(x), 1e-15);
    EXPECT_NEAR(part_value(part(Shape::torus), x).f, *torus->gap(x), 1e-15);
    SurfacePoint s;
    ASSERT_TRUE(ellipsoid->project(x, s));
    for (const double off : {-1e-5, 1e-5}) {
      const SolidValue v = part_value(part(Shape::ellipsoid), s.p + off * s.n);
      EXPECT_NEAR(v.f, off, 1e-8) << "to first order";
      EXPECT_LT((v.gradient - s.n).norm(), 3e-3);
    }
  }
}

TEST(SolidField, ARodIsTheHullOfItsBalls) {
  const SolidPart rod = part(Shape::rod);
  Points points;
  for (int k = 0; k < 100; ++k) {
    const Vec3 x = points.next();
    double least = 1e9;
    for (int i = 0; i <= 20000; ++i) {
      const double t = i / 20000.0;
      const Vec3 centre = kPose * Vec3((1 - t) * rod.from + t * rod.to);
      least = std::min(least, (x - centre).norm() - ((1 - t) * rod.radius + t * rod.end_radius));
    }
    EXPECT_NEAR(part_value(rod, x).f, least, 1e-9);
  }
  SolidPart swallowed = rod;
  swallowed.to = swallowed.from + Vec3(0.001, 0, 0);
  EXPECT_NEAR(part_value(swallowed, kPose * swallowed.from).f, -0.02, 1e-15) << "one ball holds the other";
}

TEST(SolidField, ABoxIsRoundedInside) {
  const SolidPart box = part(Shape::box);
  EXPECT_NEAR(part_value(box, kPose * Vec3(0.01, 0, 0)).f, 0, 1e-15);
  EXPECT_NEAR(part_value(box, kPose * Vec3(0.013, 0, 0)).f, 0.003, 1e-15);
  EXPECT_NEAR(part_value(box, kPose * Vec3(0.01, 0.015, 0.02)).f, 0.004 * (std::sqrt(3.0) - 1), 1e-15) << "a corner";
  EXPECT_NEAR(part_value(box, kPose * Vec3::Zero()).f, -0.01, 1e-15);
}

TEST(SolidField, SmoothMinimum) {
  const double k = 0.3;
  const auto value = [&](double a, double b) { return smooth_min({a, Vec3(1, 0, 0)}, {b, Vec3(0, 1, 0)}, k); };
  EXPECT_EQ(value(0.1, 0.4001).f, 0.1) << "far from the seam nothing changes";
  EXPECT_EQ(smooth_min({0.1, {}}, {0.2, {}}, 0).f, 0.1);
  EXPECT_NEAR(value(0.2, 0.2).f, 0.2 - k / 6, 1e-15);
  for (double b = -0.35; b < 0.36; b += 0.0101) {
    const double h = 1e-5;
    EXPECT_LE(value(0, b).f, std::min(0.0, b));
    EXPECT_NEAR(value(0, b).gradient.y(), (value(0, b + h).f - value(0, b - h).f) / (2 * h), 1e-8);
    EXPECT_NEAR(value(0, b).gradient.x(), (value(h, b).f - value(-h, b).f) / (2 * h), 1e-8);
    EXPECT_EQ(value(0, b).f, smooth_min({b, {}}, {0, {}}, k).f) << "the order does not matter";
  }
}

/// The curvature of a blend is continuous: second differences across its ends and its middle are small.
TEST(SolidField, BlendsAreTwiceContinuouslyDifferentiable) {
  const auto slope = [](double b) { return smooth_min({0, Vec3::Zero()}, {b, Vec3::UnitX()}, 0.3).gradient.x(); };
  for (const double b : {-0.3, 0.0, 0.3}) {
    const double h = 1e-5;
    EXPECT_NEAR((slope(b + h) - slope(b)) / h, (slope(b) - slope(b - h)) / h, 2e-4 / 0.3);
  }
}

TEST(SolidField, PartsAreJoinedCutAndKept) {
  SolidPart cut = part(Shape::half_space, Operation::cut), keep = part(Shape::half_space, Operation::keep);
  const SolidPart ball = part(Shape::sphere);
  const Vec3 above = kPose * Vec3(0, 0, 0.005), below = kPose * Vec3(0, 0, -0.005);
  EXPECT_NEAR(SolidField({ball, cut})(below).f, 0.005, 1e-15);
  EXPECT_LT(SolidField({ball, cut})(above).f, 0);
  EXPECT_NEAR(SolidField({ball, keep})(above).f, 0.005, 1e-15);
  EXPECT_LT(SolidField({ball, keep})(below).f, 0);
  cut.blend = keep.blend = 0.004;
  SolidPart joined = part(Shape::rod, Operation::join, 0.006);
  const SolidField all({ball, joined, part(Shape::torus, Operation::join, 0.003), cut});
  Points points;
  for (int k = 0; k < 200; ++k) expect_gradient(all, points.next(), 2e-3);
}

TEST(SolidField, ProjectionArrivesAndTheBoxHoldsIt) {
  for (const Shape shape : {Shape::sphere, Shape::ellipsoid, Shape::rod, Shape::torus, Shape::box}) {
    const SolidField field({part(shape), part(Shape::rod, Operation::join, 0.01)});
    const BoundingBox box = field.box();
    Points points;
    for (int k = 0; k < 200; ++k) {
      Vec3 x = points.next(), n;
      if (field(x).f < -0.004) continue;
      ASSERT_TRUE(field.project(x, n));
      EXPECT_NEAR(field(x).f, 0, 1e-12);
      EXPECT_NEAR(n.norm(), 1, 1e-14);
      EXPECT_TRUE((x.array() >= box.low.array()).all() && (x.array() <= box.high.array()).all()) << x.transpose();
    }
  }
}

}  // namespace
}  // namespace genu
