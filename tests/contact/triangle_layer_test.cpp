// A layer summed over triangles: against the same sum done plainly, against closed forms, and its tangent against
// differences.
#include "genu/contact/triangle_layer.h"

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

const LayerLaw kLinear{LayerLaw::Kind::linear, 38e6}, kLogarithmic{LayerLaw::Kind::logarithmic, 38e6};
constexpr double kLayerThickness = 6e-3, kSearch = 5e-3;

TriangleLayer layer(const Mesh& casting, const Mesh& target, const LayerLaw& law = kLinear) {
  return TriangleLayer(casting, std::make_shared<TriangleTree>(target), kSearch, law, {kLayerThickness, {}, {}});
}

TEST(TriangleLayer, IsTheSumOverAllTriangles) {
  const Mesh casting = test::sheet(0.02, 40), target = test::ball(0.02, 1.5e-3);
  const Pose X{exp_rotation({0.1, -0.05, 0.3}), {1e-3, 2e-3, -0.0188}};
  for (const LayerLaw& law : {kLinear, kLogarithmic})
    for (const bool swap : {false, true}) {
      const Mesh &c = swap ? target : casting, &t = swap ? casting : target;
      const Pose X_TC = swap ? X.inverse() : X;
      LayerSum sum;
      LayerQuadrature::Memory memory;
      layer(c, t, law).add(X_TC, memory, sum);
      const Vec6 expected = test::wrench_by_all(c, t, X_TC, kSearch, law, kLayerThickness);
      EXPECT_GT(expected.head<3>().norm(), 100);
      EXPECT_LT((sum.wrench - expected).norm(), 1e-11 * expected.norm());
    }
}

/// A ball pressed d into a sheet that casts: K times the volume of the cap, pi d^2 (R - d/3), as a disc of
/// pi (2 R d - d^2).
TEST(TriangleLayer, BallOnASheet) {
  const double R = 0.02, d = 0.5e-3, K = kLinear.confined_modulus / kLayerThickness;
  double last = 0;
  for (const int n : {20, 40, 80}) {
    const TriangleLayer sum_over = layer(test::sheet(8e-3, n), test::ball(R, 16e-3 / n));
    const Pose X{Mat3::Identity(), {0, 0, -(R - d)}};
    LayerSum sum;
    LayerQuadrature::Memory memory;
    sum_over.add(X, memory, sum);
    const double force = -sum.wrench[2], exact = K * M_PI * d * d * (R - d / 3);
    double area = 0;
    sum_over.visit(X, memory, [&](const LayerPoint& p) { area += p.area; });
    const double error = std::abs(force / exact - 1);
    std::printf("%d x %d squares: force error %.2e, area error %.2e\n", n, n, error,
                area / (M_PI * (2 * R * d - d * d)) - 1);
    if (last > 0) {
      EXPECT_LT(error, 0.5 * last);
    }
    last = error;
    EXPECT_NEAR(area / (M_PI * (2 * R * d - d * d)), 1, 1.0 / n);
  }
  EXPECT_LT(last, 2e-3);
}

TEST(TriangleLayer, TangentIsTheDerivative) {
  const Mesh casting = test::ball(0.02, 1.2e-3), target = test::sheet(0.02, 31);
  for (const LayerLaw& law : {kLinear, kLogarithmic}) {
    const TriangleLayer sum_over = layer(casting, target, law);
    const Pose X{exp_rotation({0.1, -0.05, 0.3}), {1e-3, 2e-3, 0.0188}};
    LayerQuadrature::Memory memory;
    LayerSum here;
    sum_over.add(X, memory, here);
    // So small a step that no ray wanders over an edge: pressure is linear in between.
    const double step = 1e-9;
    for (int i = 0; i < 6; ++i) {
      Vec6 twist = Vec6::Zero();
      twist[i] = i < 3 ? step : 50 * step;
      LayerSum ahead, behind;
      // The twist is in the casting body's axes at its origin.
      const auto moved = [&](double sign) {
        return X * Pose{exp_rotation(sign * twist.tail<3>()), sign * twist.head<3>()};
      };
      sum_over.add(moved(1), memory, ahead);
      sum_over.add(moved(-1), memory, behind);
      const Vec6 expected = (ahead.wrench - behind.wrench) / (2 * twist[i]);
      EXPECT_LT((here.tangent.col(i) - expected).norm(), 1e-5 * expected.norm() + 1e-3) << i;
    }
  }
}

TEST(TriangleLayer, ThicknessIsTheSumOfItsParts) {
  const Mesh casting = test::sheet(0.01, 20), target = test::ball(0.02, 1.5e-3);
  const auto tree = std::make_shared<TriangleTree>(target);
  const Pose X{Mat3::Identity(), {0, 0, -0.0195}};
  const auto even = [](const Mesh& mesh, double h) {
    return std::make_shared<const ThicknessField>(mesh, std::vector<double>(mesh.vertices.size(), h));
  };
  const LayerThickness parts{1e-3, even(casting, 2e-3), even(target, 3e-3)};
  LayerSum constant, summed;
  LayerQuadrature::Memory memory;
  TriangleLayer(casting, tree, kSearch, kLinear, {6e-3, {}, {}}).add(X, memory, constant);
  TriangleLayer(casting, tree, kSearch, kLinear, parts).add(X, memory, summed);
  EXPECT_LT((constant.wrench - summed.wrench).norm(), 1e-12 * constant.wrench.norm());
}

TEST(TriangleLayer, TrianglesWithoutAreaCarryNothing) {
  Mesh casting = test::sheet(0.01, 10);
  LayerSum clean, dirty;
  LayerQuadrature::Memory memory, other;
  const Mesh target = test::ball(0.02, 1.5e-3);
  const Pose X{Mat3::Identity(), {0, 0, -0.0195}};
  layer(casting, target).add(X, memory, clean);
  casting.triangles.push_back({5, 5, 6});
  casting.triangles.push_back({5, 6, 7});
  layer(casting, target).add(X, other, dirty);
  EXPECT_TRUE(dirty.wrench.allFinite());
  EXPECT_LT((clean.wrench - dirty.wrench).norm(), 1e-12 * clean.wrench.norm());
}

}  // namespace
}  // namespace genu
