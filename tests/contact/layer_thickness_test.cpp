// Thickness on the triangles of a mesh: linear, continuous, with its derivative; and what it does to a layer's sum and
// tangent.
#include "genu/contact/layer_thickness.h"

#include <gtest/gtest.h>

#include "contact/layer_shapes.h"
#include "support/layers.h"

namespace genu::layer_tests {
namespace {

/// h0 + slope . x at every vertex: what the field must give back everywhere.
std::shared_ptr<const ThicknessField> sloping(const Mesh& mesh, double h0, const Vec3& slope) {
  std::vector<double> h;
  for (const Vec3& v : mesh.vertices) h.push_back(h0 + slope.dot(v));
  return std::make_shared<const ThicknessField>(mesh, h);
}

/// Something that is linear nowhere, between h0 / 2 and 3/2 h0.
std::shared_ptr<const ThicknessField> wavy(const Mesh& mesh, double h0) {
  std::vector<double> h;
  for (const Vec3& v : mesh.vertices) h.push_back(h0 * (1 + 0.5 * std::sin(300 * v[0]) * std::cos(400 * v[1])));
  return std::make_shared<const ThicknessField>(mesh, h);
}

TEST(LayerThickness, LinearIsReproduced) {
  const Mesh mesh = test::ball(0.02, 2e-3);
  const Vec3 slope(0.03, -0.05, 0.02);
  const auto field = sloping(mesh, 4e-3, slope);
  double worst = 0, gradient = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto v = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[k][i])]; };
    const Vec3 x = 0.2 * v(0) + 0.7 * v(1) + 0.1 * v(2), n = (v(1) - v(0)).cross(v(2) - v(0)).normalized();
    worst = std::max(worst, std::abs(field->at(static_cast<int>(k), x) - 4e-3 - slope.dot(x)));
    gradient = std::max(gradient, (field->gradient(static_cast<int>(k)) - (slope - n * n.dot(slope))).norm());
  }
  EXPECT_LT(worst, 1e-15);
  EXPECT_LT(gradient, 1e-12);
}

TEST(LayerThickness, BesideATriangleNothingIsMadeUp) {
  const Mesh mesh = test::ball(0.02, 2e-3);
  const auto field = sloping(mesh, 4e-3, Vec3(0.03, -0.05, 0.02));
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 7) {
    const auto& t = mesh.triangles[k];
    const auto [low, high] = std::minmax({field->at_vertex(t[0]), field->at_vertex(t[1]), field->at_vertex(t[2])});
    for (const double far : {1e-3, 5e-3, 0.02})
      for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(-1, 2, 3)}) {
        const double h = field->within(static_cast<int>(k), mesh.vertices[static_cast<std::size_t>(t[0])] + far * d);
        EXPECT_GE(h, low);
        EXPECT_LE(h, high);
      }
    EXPECT_NEAR(field->within(static_cast<int>(k), mesh.vertices[static_cast<std::size_t>(t[1])]),
                field->at_vertex(t[1]), 1e-15);
  }
}

/// A plate pressed d into a larger one, the thickness h0 + s x of either: F = M d W ln(h2 / h1) / s.
TEST(LayerThickness, PlateOnAWedge) {
  constexpr double kHalf = 5e-3, kH0 = 3e-3, kSlope = 0.3, kDepth = 0.4e-3;
  const LayerLaw law{LayerLaw::Kind::linear, 38e6};
  const double exact =
      law.confined_modulus * kDepth * 2 * kHalf / kSlope * std::log((kH0 + kSlope * kHalf) / (kH0 - kSlope * kHalf));
  Mesh small = test::sheet(kHalf, 60), large = test::sheet(8e-3, 37);
  for (auto& t : large.triangles) std::swap(t[1], t[2]);  // facing down
  for (const bool on_casting : {false, true}) {
    LayerThickness h;
    (on_casting ? h.casting : h.target) = sloping(on_casting ? small : large, kH0, Vec3::UnitX() * kSlope);
    const TriangleLayer layer(small, std::make_shared<TriangleTree>(large), 2e-3, law, h);
    LayerQuadrature::Memory memory;
    LayerSum sum;
    layer.add({Mat3::Identity(), {0, 0, kDepth}}, memory, sum);
    EXPECT_NEAR(sum.load / exact, 1, 1e-4) << on_casting;
  }
}

TEST(LayerThickness, TangentOfTrianglesIsTheDerivative) {
  const Mesh casting = test::ball(0.02, 1.2e-3), target = test::sheet(0.02, 31);
  for (const auto kind : {LayerLaw::Kind::linear, LayerLaw::Kind::logarithmic}) {
    const LayerThickness h{1e-3, wavy(casting, 3e-3), wavy(target, 2e-3)};
    const TriangleLayer layer(casting, std::make_shared<TriangleTree>(target), 5e-3, {kind, 38e6}, h);
    const Pose X{exp_rotation({0.1, -0.05, 0.3}), {1e-3, 2e-3, 0.0188}};
    LayerQuadrature::Memory memory;
    LayerSum here;
    layer.add(X, memory, here);
    for (int i = 0; i < 6; ++i) {
      Vec6 twist = Vec6::Zero();
      twist[i] = i < 3 ? 1e-9 : 50e-9;  // so small that no ray wanders over an edge
      LayerSum ahead, behind;
      const auto moved = [&](double sign) {
        return X * Pose{exp_rotation(sign * twist.tail<3>()), sign * twist.head<3>()};
      };
      layer.add(moved(1), memory, ahead);
      layer.add(moved(-1), memory, behind);
      const Vec6 expected = (ahead.wrench - behind.wrench) / (2 * twist[i]);
      EXPECT_LT((here.tangent.col(i) - expected).norm(), 1e-5 * expected.norm() + 1e-3) << i;
    }
  }
}

struct SmoothPair {
  std::shared_ptr<const ElasticLayer> layer;
  Mesh a, b;
};

/// A plane a and a bowl b, with thicknesses measured on either.
template <typename Thickness>
SmoothPair smooth_pair(const Bowl& bowl, double edge, LayerLaw::Kind kind, Thickness thickness) {
  const std::shared_ptr<const Surface> a = make_plane({}, false), b = bowl.surface;
  SmoothPair out;
  out.a = a->triangles(edge, Vec3::Zero(), 15e-3), out.b = b->triangles(edge, Vec3::Zero(), 15e-3);
  const auto on_a = thickness(out.a), on_b = thickness(out.b);
  const auto side = [&](const auto& own, const auto& other, const Mesh& mine, const Mesh& theirs, const auto& h,
                        const auto& k) {
    return std::make_shared<const SmoothLayer>(SmoothDepths(
        std::make_shared<const SmoothCells>(mine, own), std::make_shared<const SmoothCells>(theirs, other),
        std::make_shared<const TriangleTree>(theirs), 6e-3, LayerLaw{kind, 1e7}, LayerThickness{1e-3, h, k}));
  };
  out.layer = std::make_shared<const ElasticLayer>(std::vector<ElasticLayer::Side>{
      {true, 0.5, side(a, b, out.a, out.b, on_a, on_b)}, {false, 0.5, side(b, a, out.b, out.a, on_b, on_a)}});
  return out;
}

TEST(LayerThickness, TangentOfSmoothSurfacesIsTheDerivative) {
  constexpr double kStep = 1e-8;
  double worst = 0;
  for (const auto kind : {LayerLaw::Kind::linear, LayerLaw::Kind::logarithmic}) {
    const auto pair = smooth_pair(torus(20e-3, 15e-3), 2e-3, kind, [](const Mesh& m) { return wavy(m, 2e-3); });
    const Pose X_Wa{exp_rotation(Vec3(0.2, -0.1, 0.4)), Vec3(0.1, -0.2, 0.05)};
    const Pose X_Wb = X_Wa * Pose{exp_rotation({0, 0, 0.3}), {0.31e-3, 0.17e-3, -1e-3}};
    ElasticLayer::Memory memory;
    LayerWrench here, plus, minus;
    pair.layer->evaluate(X_Wa, X_Wb, memory, here);
    for (Eigen::Index k = 0; k < 12; ++k) {
      const Vec6 step = kStep * Vec6::Unit(k % 6);
      const auto moved = [&](double sign, LayerWrench& out) {
        pair.layer->evaluate(k < 6 ? retract(X_Wa, sign * step) : X_Wa, k < 6 ? X_Wb : retract(X_Wb, sign * step),
                             memory, out);
      };
      moved(1, plus);
      moved(-1, minus);
      const Vec12 slope = (plus.wrench - minus.wrench) / (2 * kStep);
      worst = std::max(worst, (slope - here.stiffness.col(k)).norm() / here.stiffness.norm());
    }
  }
  std::printf("tangent off by %.1e\n", worst);
  EXPECT_LT(worst, 3e-6);
}

TEST(LayerThickness, EvenFieldsAreTheirSum) {
  const auto even = [](const Mesh& mesh) {
    return std::make_shared<const ThicknessField>(mesh, std::vector<double>(mesh.vertices.size(), 2e-3));
  };
  const Bowl bowl = ellipsoid(40e-3, 20e-3, 25e-3);
  const auto pair = smooth_pair(bowl, 2e-3, LayerLaw::Kind::linear, even);
  const Pressed same = smooth(bowl.surface, 2e-3, 15e-3, {LayerLaw::Kind::linear, 1e7}, 5e-3, 6e-3);
  const Pose X{Mat3::Identity(), {0, 0, -1e-3}};
  const Carried x = carried(*pair.layer, {}, X), y = carried(*same.layer, {}, X);
  EXPECT_NEAR(x.force / y.force, 1, 1e-12);
  EXPECT_NEAR(x.area / y.area, 1, 1e-12);
  EXPECT_NEAR(x.peak / y.peak, 1, 1e-12);
}

TEST(LayerThickness, MemoryChangesNothing) {
  const auto pair =
      smooth_pair(sphere(25e-3), 2e-3, LayerLaw::Kind::linear, [](const Mesh& m) { return wavy(m, 2e-3); });
  ElasticLayer::Memory warm;
  LayerWrench x, y;
  for (int k = 0; k < 30; ++k) {
    const double t = 0.05 * k;
    const Pose X{exp_rotation(Vec3(0.2 * t, -0.3 * t, t)), Vec3(2e-3 * t, -3e-3 * t, -1e-3 * std::cos(3 * t))};
    ElasticLayer::Memory cold;
    pair.layer->evaluate({}, X, warm, x, k % 7 == 0 ? 1 : 0);
    pair.layer->evaluate({}, X, cold, y, k % 7 == 0 ? 1 : 0);
    ASSERT_EQ(x.wrench, y.wrench) << k;
    ASSERT_EQ(x.stiffness, y.stiffness) << k;
  }
}

}  // namespace
}  // namespace genu::layer_tests
