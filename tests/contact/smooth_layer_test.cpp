#include "genu/contact/smooth_layer.h"

#include <atomic>

#include <gtest/gtest.h>

#include "contact/layer_shapes.h"
#include "genu/core/pose.h"

namespace genu::layer_tests {
namespace {

constexpr double kThickness = 5e-3, kDelta = 1e-3;

LayerLaw law_of(LayerLaw::Kind kind = LayerLaw::Kind::linear) { return {kind, 1e7}; }
double stiffness() { return law_of().confined_modulus / kThickness; }

/// Off the symmetric place, so that no lattice lies on contact as its mirror image.
Pose pressed_in(double delta) { return {exp_rotation(Vec3(0, 0, 0.3)), Vec3(0.123e-3, 0.217e-3, -delta)}; }

Pressed press(const std::shared_ptr<const Surface>& b, double edge, const LayerLaw& law = law_of(), bool swap = false) {
  return smooth(b, edge, 15e-3, law, kThickness, kThickness, swap);
}

std::vector<Bowl> bowls() { return {sphere(25e-3), ellipsoid(40e-3, 20e-3, 25e-3), torus(20e-3, 15e-3)}; }

TEST(SmoothLayer, SphereOnPlaneIsTheMeanOfBothCastings) {
  // From the plane pi K delta^2 (R - delta / 3), from the sphere pi K delta^2 R.
  const double R = 25e-3;
  const Carried all = exact(sphere(R), kDelta, stiffness());
  const double force = std::numbers::pi * stiffness() * kDelta * kDelta * (R - kDelta / 6);
  const double area = std::numbers::pi * (2 * R * kDelta - kDelta * kDelta / 2);
  EXPECT_NEAR(all.force / force, 1, 1e-10);
  EXPECT_NEAR(all.area / area, 1, 1e-10);
}

TEST(SmoothLayer, ConvergesWithTheFourthOrderAndKnowsItsError) {
  // At twelve places: at one alone errors of either sign may cancel.
  constexpr int kPlaces = 12;
  for (const Bowl& bowl : bowls()) {
    const Carried truth = exact(bowl, kDelta, stiffness());
    const Pressed pressed = press(bowl.surface, 4e-3);
    double squares[4] = {0, 0, 0, 0}, known[4] = {0, 0, 0, 0};
    for (int place = 0; place < kPlaces; ++place)
      for (int level = 0; level < 4; ++level) {
        const Pose X{exp_rotation(Vec3(0, 0, 0.3 + place)), Vec3(0.3e-3 * place, 0.217e-3 * place, -kDelta)};
        ElasticLayer::Memory memory;
        LayerWrench out;
        pressed.layer->evaluate({}, X, memory, out, level);
        const double error = std::abs(out.wrench[8] / truth.force - 1);
        EXPECT_LT(error, out.error / out.load) << bowl.name << " level " << level << " place " << place;
        squares[level] += error * error / kPlaces;
        known[level] += std::pow(out.error / out.load, 2) / kPlaces;
      }
    for (int level = 0; level < 4; ++level)
      EXPECT_LT(std::sqrt(known[level] / squares[level]), 25) << bowl.name << " level " << level;
    // Three halvings of the edge: 4096 at the fourth order.
    EXPECT_GT(std::sqrt(squares[0] / squares[3]), 1000) << bowl.name << ' ' << std::sqrt(squares[0]);
  }
}

TEST(SmoothLayer, TenThousandTrianglesGiveForceAreaAndPeakWithinAThousandth) {
  for (const Bowl& bowl : bowls()) {
    const Carried truth = exact(bowl, kDelta, stiffness());
    for (const bool mesh : {false, true}) {
      const double edge = bowl.name == "sphere" ? 1.25e-3 : 1.6e-3;
      const Pressed pressed = press(mesh ? as_mesh(bowl, edge) : bowl.surface, edge);
      const Carried found = carried(*pressed.layer, {}, pressed_in(kDelta));
      EXPECT_LT(pressed.triangles, 13000) << bowl.name;
      EXPECT_NEAR(found.force / truth.force, 1, 1e-3) << bowl.name << mesh;
      EXPECT_NEAR(found.area / truth.area, 1, 1e-3) << bowl.name << mesh;
      EXPECT_NEAR(found.peak / truth.peak, 1, mesh ? 1e-3 : 1e-9) << bowl.name << mesh;
    }
  }
}

TEST(SmoothLayer, CarriesNothingDeeperThanItsSearch) {
  constexpr double kSearch = 0.5e-3;
  const Bowl ball = sphere(25e-3);
  const Pressed pressed = smooth(ball.surface, 2e-3, 15e-3, law_of(), kThickness, kSearch);
  for (const double delta : {0.49e-3, 0.505e-3, 0.52e-3, 0.7e-3}) {
    const Carried found = carried(*pressed.layer, {}, pressed_in(delta)), all = exact(ball, delta, stiffness());
    EXPECT_LE(found.peak, kSearch * (1 + 1e-12)) << delta;
    EXPECT_GT(found.force, 0) << delta;
    EXPECT_LT(found.force, (delta > kSearch ? 1 : 1.001) * all.force) << delta;
  }
}

TEST(SmoothLayer, TangentAgreesWithDifferences) {
  constexpr double kStep = 1e-7;
  double worst = 0;
  for (const auto kind : {LayerLaw::Kind::linear, LayerLaw::Kind::logarithmic})
    for (const bool mesh : {false, true}) {
      const Bowl bowl = torus(20e-3, 15e-3);
      const Pressed pressed = press(mesh ? as_mesh(bowl, 2e-3) : bowl.surface, 2e-3, law_of(kind));
      const Pose X_Wa{exp_rotation(Vec3(0.2, -0.1, 0.4)), Vec3(0.1, -0.2, 0.05)}, X_Wb = X_Wa * pressed_in(kDelta);
      ElasticLayer::Memory memory;
      LayerWrench here, plus, minus;
      pressed.layer->evaluate(X_Wa, X_Wb, memory, here);
      for (Eigen::Index k = 0; k < 12; ++k) {
        const Vec6 step = kStep * Vec6::Unit(k % 6);
        const auto moved = [&](double sign, LayerWrench& out) {
          pressed.layer->evaluate(k < 6 ? retract(X_Wa, sign * step) : X_Wa, k < 6 ? X_Wb : retract(X_Wb, sign * step),
                                  memory, out);
        };
        moved(1, plus);
        moved(-1, minus);
        const Vec12 slope = (plus.wrench - minus.wrench) / (2 * kStep);
        worst = std::max(worst, (slope - here.stiffness.col(k)).norm() / here.stiffness.norm());
      }
    }
  EXPECT_LT(worst, 1e-6) << worst;
}

TEST(SmoothLayer, SwappedSurfacesGiveTheSame) {
  const Bowl bowl = ellipsoid(40e-3, 20e-3, 25e-3);
  const auto b = as_mesh(bowl, 2e-3);
  const Pressed one = press(b, 2e-3), other = press(b, 2e-3, law_of(), true);
  ElasticLayer::Memory memory_one, memory_other;
  LayerWrench x, y;
  one.layer->evaluate({}, pressed_in(kDelta), memory_one, x);
  other.layer->evaluate(pressed_in(kDelta), {}, memory_other, y);
  Vec12 swapped;
  swapped << y.wrench.tail<6>(), y.wrench.head<6>();
  EXPECT_LT((swapped - x.wrench).norm(), 1e-12 * x.wrench.norm());
  EXPECT_LT((x.wrench.head<3>() + x.wrench.segment<3>(6)).norm(), 1e-12 * x.wrench.norm());
  EXPECT_NEAR(y.load / x.load, 1, 1e-14);
}

TEST(SmoothLayer, MovesWithBothBodies) {
  const Pressed pressed = press(torus(20e-3, 15e-3).surface, 2e-3);
  const Pose moved{exp_rotation(Vec3(0.7, -1.1, 0.3)), Vec3(0.02, 0.01, -0.03)};
  ElasticLayer::Memory memory;
  LayerWrench x, y;
  pressed.layer->evaluate({}, pressed_in(kDelta), memory, x);
  pressed.layer->evaluate(moved, moved * pressed_in(kDelta), memory, y);
  const Vec3 force = moved.R * x.wrench.segment<3>(6);
  EXPECT_LT((y.wrench.segment<3>(6) - force).norm(), 1e-11 * force.norm());
  EXPECT_LT((y.wrench.tail<3>() - moved.R * x.wrench.tail<3>()).norm(), 1e-11 * x.wrench.norm());
}

TEST(SmoothLayer, MemoryChangesNothing) {
  const Bowl bowl = sphere(25e-3);
  const Pressed pressed = press(as_mesh(bowl, 2e-3), 2e-3);
  ElasticLayer::Memory warm;
  LayerWrench x, y;
  for (int k = 0; k < 40; ++k) {
    const double t = 0.05 * k;
    const Pose X{exp_rotation(Vec3(0.2 * t, -0.3 * t, t)), Vec3(2e-3 * t, -3e-3 * t, -kDelta * std::cos(3 * t))};
    ElasticLayer::Memory cold;
    pressed.layer->evaluate({}, X, warm, x, k % 7 == 0 ? 1 : 0);
    pressed.layer->evaluate({}, X, cold, y, k % 7 == 0 ? 1 : 0);
    ASSERT_EQ(x.wrench, y.wrench) << k;
    ASSERT_EQ(x.stiffness, y.stiffness) << k;
  }
}

TEST(SmoothLayer, LeavesOffWhenCancelledAndLeavesNoTrace) {
  const Pressed pressed = press(sphere(25e-3).surface, 2e-3);
  ElasticLayer::Memory cold;
  LayerWrench whole, out;
  std::atomic<int> asked = 0;  // by both sides at once
  cold.cancelled = [&] { return ++asked < 0; };
  pressed.layer->evaluate({}, pressed_in(kDelta), cold, whole, 1);
  EXPECT_GT(asked, 20) << "in the middle of a sum";
  for (const int after : {0, 1, asked.load() / 2, asked.load() - 1}) {
    ElasticLayer::Memory memory;
    std::atomic<int> left = after;
    memory.cancelled = [&] { return left-- <= 0; };
    pressed.layer->evaluate({}, pressed_in(kDelta), memory, out, 1);
    EXPECT_FALSE(out.wrench.allFinite()) << after;
    memory.cancelled = {};
    pressed.layer->evaluate({}, pressed_in(kDelta), memory, out, 1);
    EXPECT_EQ(out.wrench, whole.wrench) << after;
    EXPECT_EQ(out.stiffness, whole.stiffness) << after;
  }
}

TEST(SmoothLayer, NothingOutOfContact) {
  const Pressed pressed = press(sphere(25e-3).surface, 2e-3);
  ElasticLayer::Memory memory;
  LayerWrench out;
  for (const double gap : {1e-6, 0.5e-3, 5e-3, 0.5}) {
    pressed.layer->evaluate({}, pressed_in(-gap), memory, out);
    EXPECT_TRUE(out.wrench.isZero(0)) << gap;
    EXPECT_TRUE(out.stiffness.isZero(0)) << gap;
  }
}

TEST(SmoothLayer, DeepOverlap) {
  // 4 mm of 5 at a sphere of 25: contact is 27 mm wide and meets the plane at 33 deg.
  const Bowl bowl = sphere(25e-3);
  const Carried truth = exact(bowl, 4e-3, stiffness());
  for (const bool mesh : {false, true}) {
    const auto b = mesh ? as_mesh(bowl, 2e-3) : bowl.surface;
    const Pressed pressed = smooth(b, 2e-3, 25e-3, law_of(), kThickness, kThickness);
    const Carried found = carried(*pressed.layer, {}, pressed_in(4e-3));
    EXPECT_NEAR(found.force / truth.force, 1, 1e-3) << mesh;
    EXPECT_NEAR(found.area / truth.area, 1, 1e-3) << mesh;
  }
}

TEST(SmoothLayer, VisitedPointsSumToTheWrench) {
  const Pressed pressed = press(torus(20e-3, 15e-3).surface, 2e-3);
  const Pose X_Wb = pressed_in(kDelta);
  ElasticLayer::Memory memory;
  LayerWrench out;
  pressed.layer->evaluate({}, X_Wb, memory, out);
  Vec3 force = Vec3::Zero();
  for (std::size_t side = 0; side < 2; ++side)
    pressed.layer->visit({}, X_Wb, side, memory, [&](const LayerPoint& point) {
      force += side == 0 ? Vec3(0.5 * point.load * point.n) : Vec3(-0.5 * point.load * (X_Wb.R * point.n));
    });
  EXPECT_LT((force - out.wrench.segment<3>(6)).norm(), 1e-12 * force.norm());
}

}  // namespace
}  // namespace genu::layer_tests
