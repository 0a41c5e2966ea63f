// A layer summed over triangles: against the same sum done plainly, against closed forms, and its tangent against
// differences.
#include "genu/contact/triangle_layer.h"

#include <map>

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

TriangleLayer weighted(const Mesh& casting, const Mesh& target, const LayerLaw& law = kLinear,
                       const LayerThickness& thickness = {kLayerThickness, {}, {}}) {
  return TriangleLayer(casting, std::make_shared<TriangleTree>(target), kSearch, law, thickness,
                       std::make_shared<RimCover>(target, thickness.target));
}

/// A part of a ball that bulges up through z = 0, with a ragged border.
Mesh cap() {
  Mesh mesh = test::ball(0.02, 0.9e-3);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    double z = 0;
    for (const int v : t) z += mesh.vertices[at(v)].z() / 3;
    return z < 0.0185;
  });
  return mesh;
}

/// A sheet that casts down into the cap, with its inside up.
Pose over_cap(double x, double y, double turn) {
  return Pose{exp_rotation({0, 0, turn}), {x, y, 0.0182}} * Pose{exp_rotation({M_PI + 0.02, 0.01, 0}), Vec3::Zero()};
}

/// Wrench on the casting body by plain means: each share by a count of points, each depth beside the rim by all border
/// edges.
Vec6 weighted_by_all(const Mesh& casting, const Mesh& target, const Pose& X_TC, const LayerLaw& law) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : target.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++sides[std::minmax(t[i], t[(i + 1) % 3])];
  const TriangleTree tree(target);
  Vec6 wrench = Vec6::Zero();
  for (const auto& t : casting.triangles) {
    const auto v = [&](std::size_t i) -> const Vec3& { return casting.vertices[at(t[i])]; };
    const Vec3 area = 0.5 * (v(1) - v(0)).cross(v(2) - v(0)), x = (v(0) + v(1) + v(2)) / 3;
    const Vec3 o = X_TC * x, d = -(X_TC.R * area.normalized()), across = d.unitOrthogonal(), up = d.cross(across);
    const double radius = std::sqrt(area.norm() / M_PI);
    constexpr int kPoints = 3000;
    double share = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double r = radius * std::sqrt((i + 0.5) / kPoints), turn = 2.399963229728653 * i;
      share += static_cast<bool>(tree.leaving(o + r * (std::cos(turn) * across + std::sin(turn) * up), d, kSearch));
    }
    share /= kPoints;
    auto hit = test::overlap_by_all(target, o, d, kSearch);
    if (!hit && share > 0) {
      double sum = 0, depths = 0;
      for (const auto& [edge, count] : sides) {
        if (count > 1) continue;
        const Vec3 a = target.vertices[at(edge.first)] - o, b = target.vertices[at(edge.second)] - o;
        const Vec3 p = a - a.dot(d) * d, q = b - b.dot(d) * d;
        const double s = std::clamp(-p.dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
        const double off = (p + s * (q - p)).norm();
        if (off >= radius) continue;
        const double weight = std::pow(radius * radius / (off * off) - 1, 2);
        sum += weight;
        depths += weight * (a + s * (b - a)).dot(d);
      }
      hit.distance = sum > 0 ? depths / sum : 0;
    }
    const Vec3 force = -share * std::max(0.0, law.at(hit.distance, kLayerThickness).p) * area;
    wrench.head<3>() += force;
    wrench.tail<3>() += x.cross(force);
  }
  return wrench;
}

TEST(TriangleLayer, AtTheRimIsTheSumOverAllTriangles) {
  const Mesh casting = test::sheet(6e-3, 12), target = cap();
  double worst = 0;
  for (const double x : {0.0, 4e-3, 8e-3}) {
    const Pose X = over_cap(x, 0.3 * x, x * 100);
    LayerSum sum, cut;
    LayerQuadrature::Memory memory, other;
    weighted(casting, target).add(X, memory, sum);
    layer(casting, target).add(X, other, cut);
    const Vec6 expected = weighted_by_all(casting, target, X, kLinear);
    EXPECT_GT(expected.head<3>().norm(), 10);
    EXPECT_GT((sum.wrench - cut.wrench).norm(), 1e-6 * expected.norm());  // there are rays at the rim
    worst = std::max(worst, (sum.wrench - expected).norm() / expected.norm());
  }
  std::printf("largest error %.1e\n", worst);
  EXPECT_LT(worst, 3e-4);
}

TEST(TriangleLayer, AtTheRimIsTheSameWhateverCameBefore) {
  const Mesh casting = test::sheet(6e-3, 14);
  const TriangleLayer sum_over = weighted(casting, cap());
  LayerQuadrature::Memory memory;
  for (int pose = 0; pose < 200; ++pose) {
    const double x = 5e-3 + 3e-3 * std::sin(0.01 * pose * pose);  // steps of all sizes
    const Pose X = over_cap(x, 0.3 * x, 0.5);
    LayerSum known, fresh;
    LayerQuadrature::Memory none;
    sum_over.add(X, memory, known);
    sum_over.add(X, none, fresh);
    ASSERT_EQ(known.wrench, fresh.wrench) << pose;
    ASSERT_EQ(known.tangent, fresh.tangent) << pose;
    double load = 0, area = 0;
    sum_over.visit(X, memory, [&](const LayerPoint& p) {
      load += p.load;
      area += p.area;
      EXPECT_LE(p.area, 72e-6 / 196 * (1 + 1e-9));
      EXPECT_NEAR(p.load, p.pressure * p.area, 1e-15);
    });
    EXPECT_NEAR(load, known.load, 1e-12 * known.load);
  }
}

TEST(TriangleLayer, IsTheSameAwayFromTheRim) {
  const Mesh casting = test::ball(0.02, 1.5e-3), target = test::sheet(0.02, 40);
  const Pose X{exp_rotation({0.1, -0.05, 0.3}), {1e-3, 2e-3, 0.0188}};
  LayerSum one, two;
  LayerQuadrature::Memory memory, other;
  layer(casting, target).add(X, memory, one);
  weighted(casting, target).add(X, other, two);
  EXPECT_EQ(one.wrench, two.wrench);
  EXPECT_EQ(one.tangent, two.tangent);
}

/// A plate held d deep on a block that ends under it slides over the block's edge: K d times the covered area.
TEST(TriangleLayer, ForceIsContinuousAsASheetSlidesOff) {
  constexpr double kPlate = 8e-3, kDeep = 0.5e-3;
  constexpr int kSquares = 20, kSteps = 4000;
  const double K = kLinear.confined_modulus / kLayerThickness;
  const Mesh plate = test::sheet(kPlate, kSquares), block = test::sheet(0.02, 7);
  const TriangleLayer smooth = weighted(plate, block), cut = layer(plate, block);
  struct Largest {
    double step = 0, error = 0, last = 0;
  } of_smooth, of_cut;
  LayerQuadrature::Memory memory, other;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = 0.012 + 0.016 * i / kSteps;  // the plate reaches the edge, and leaves it
    const Pose X = Pose{exp_rotation({0, 0, 0.4}), {x, 0, -kDeep}} * Pose{exp_rotation({M_PI, 0, 0}), Vec3::Zero()};
    // Area of the turned square with x < 0.02, by strips.
    double covered = 0;
    constexpr int kStrips = 400;
    for (int a = 0; a < kStrips && i % 100 == 0; ++a)
      for (int b = 0; b < kStrips; ++b) {
        const Vec3 p = X * Vec3(kPlate * ((2 * a + 1.0) / kStrips - 1), kPlate * ((2 * b + 1.0) / kStrips - 1), 0);
        covered += p.x() < 0.02 ? std::pow(2 * kPlate / kStrips, 2) : 0;
      }
    const auto note = [&](const TriangleLayer& sum_over, LayerQuadrature::Memory& known, Largest& largest) {
      LayerSum sum;
      sum_over.add(X, known, sum);
      if (i > 0) largest.step = std::max(largest.step, std::abs(sum.load - largest.last));
      largest.last = sum.load;
      if (i % 100 == 0)
        largest.error =
            std::max(largest.error, std::abs(sum.load - K * kDeep * covered) / (4 * K * kDeep * kPlate * kPlate));
    };
    note(smooth, memory, of_smooth);
    note(cut, other, of_cut);
  }
  const double whole = 4 * K * kDeep * kPlate * kPlate;
  std::printf("of the whole force: largest step %.2e (cut %.2e), largest error %.2e (cut %.2e)\n",
              of_smooth.step / whole, of_cut.step / whole, of_smooth.error, of_cut.error);
  // Its rate: the plate's width over its area, once and a half as much where rows of triangles pass together.
  EXPECT_LT(of_smooth.step, 1.5 * whole / kSteps * std::sqrt(2.0));
  EXPECT_GT(of_cut.step, whole / (2.1 * kSquares * kSquares));  // one triangle at least
  EXPECT_LT(of_smooth.error, 2e-3);
}

TEST(TriangleLayer, TangentIsTheDerivativeAcrossTheRim) {
  const Mesh casting = test::sheet(6e-3, 14), target = cap();
  std::vector<double> h;
  for (const Vec3& v : target.vertices) h.push_back(3e-3 + 0.1 * v.x() - 0.05 * v.y());
  const LayerThickness measured{3e-3, {}, std::make_shared<const ThicknessField>(target, h)};
  double worst = 0;
  int poses = 0;
  for (const LayerLaw& law : {kLinear, kLogarithmic})
    for (const LayerThickness& thickness : {LayerThickness{kLayerThickness, {}, {}}, measured}) {
      const TriangleLayer sum_over = weighted(casting, target, law, thickness);
      for (int pose = 0; pose < 60; ++pose, ++poses) {
        const Pose X = over_cap(1.7e-4 * pose, 1e-3 * std::sin(pose), 0.37 * pose);
        LayerQuadrature::Memory memory;
        LayerSum here;
        sum_over.add(X, memory, here);
        const double step = 1e-10;
        for (int i = 0; i < 6; ++i) {
          Vec6 twist = Vec6::Zero();
          twist[i] = i < 3 ? step : 50 * step;
          LayerSum ahead, behind;
          const auto moved = [&](double sign) {
            return X * Pose{exp_rotation(sign * twist.tail<3>()), sign * twist.head<3>()};
          };
          sum_over.add(moved(1), memory, ahead);
          sum_over.add(moved(-1), memory, behind);
          const Vec6 expected = (ahead.wrench - behind.wrench) / (2 * twist[i]);
          worst = std::max(worst, (here.tangent.col(i) - expected).norm() / here.tangent.norm());
        }
      }
    }
  std::printf("%d poses, largest error of the tangent %.1e of its norm\n", poses, worst);
  EXPECT_LT(worst, 1e-6);
}

}  // namespace
}  // namespace genu
