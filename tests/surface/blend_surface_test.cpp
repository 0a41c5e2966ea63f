// The blend against finite differences, against shapes it must converge to, and against itself moved or rebuilt.
#include "genu/surface/blend_surface.h"

#include <cstdio>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/blend_meshes.h"
#include "support/blend_torus.h"
#include "support/finite_difference.h"

namespace genu::test {
namespace {

TEST(BlendSurface, ProjectsOntoItselfAndFollowsTangentSteps) {
  const auto surface = build(jittered_torus(kMajor, kMinor, 1e-3), fitted(3e-3));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(0, kTwoPi), off(-0.5e-3, 0.5e-3);
  double worst_value = 0, worst_normal = 0;
  for (int k = 0; k < 300; ++k) {
    SurfacePoint point;
    const double around = angle(random), across = angle(random);
    ASSERT_TRUE(surface->project(torus_point(around, across, off(random)), point));
    const auto gap = surface->gap(point.p);
    ASSERT_TRUE(gap);
    worst_value = std::max(worst_value, std::abs(*gap));
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3 slope = test::derivative(
          [&](double s) {
            SurfacePoint to;
            EXPECT_TRUE(surface->retract(point, s * Vec2::Unit(axis), to));
            return Vec3(to.n);
          },
          1e-5);
      worst_normal = std::max(worst_normal, (slope + point.T * point.S.col(axis)).norm());
    }
  }
  std::printf("f on the surface %.1e m, dn + T S ds %.1e 1/m\n", worst_value, worst_normal);
  EXPECT_LT(worst_value, 1e-16);
  EXPECT_LT(worst_normal, 1e-3);  // of 250 1/m
  SurfacePoint point;
  EXPECT_FALSE(surface->project(Vec3::Zero(), point));
  EXPECT_FALSE(surface->gap(Vec3(1, 2, 3)));
  EXPECT_FALSE(surface->project(Vec3::Constant(std::nan("")), point));
}

TEST(BlendSurface, RoughStepsErByThirdOrderAndComeToTheSurface) {
  const auto surface = build(jittered_torus(kMajor, kMinor, 1e-3), fitted(3e-3));
  double place[2] = {0, 0}, bend[2] = {0, 0};
  for (int k = 0; k < 100; ++k) {
    SurfacePoint from, rough, exact;
    ASSERT_TRUE(surface->project(torus_point(k, 1.7 * k), from));
    for (int half = 0; half < 2; ++half) {
      const Vec2 ds = 1e-3 / (1 << half) * Vec2(std::cos(k), std::sin(k));
      ASSERT_TRUE(surface->retract_roughly(from, ds, rough));
      ASSERT_TRUE(surface->retract(from, ds, exact));
      place[half] = std::max(place[half], (rough.p - exact.p).norm());
      bend[half] = std::max(bend[half], (tensor(rough) - tensor(exact)).norm());
    }
    ASSERT_TRUE(surface->retract_roughly(rough, Vec2::Zero(), rough));
    EXPECT_LT(std::abs(surface->gap(rough.p).value()), 1e-14);
  }
  std::printf("place %.1e and %.1e m, shape operator %.1e and %.1e 1/m\n", place[0], place[1], bend[0], bend[1]);
  EXPECT_LT(place[0], 1e-10);
  EXPECT_LT(place[1], place[0] / 8);
  EXPECT_LT(bend[0], 1);  // of 250
  EXPECT_LT(bend[1], bend[0] / 4);
}

TEST(BlendSurface, SmoothsANoisySphere) {
  const double radius = 20e-3, noise = 15e-6;
  const auto surface = build(noisy_sphere(radius, 5, noise));
  const BlendFacts& facts = surface->facts();
  double position = 0, curvature = 0;
  for (const Vec3& at : surface->node_positions()) {
    SurfacePoint point;
    ASSERT_TRUE(surface->project(at, point));
    position += std::pow(point.p.norm() - radius, 2);
    curvature += (point.S + Mat2::Identity() / radius).squaredNorm() / 2;
  }
  position = std::sqrt(position / facts.node_count);
  curvature = std::sqrt(curvature / facts.node_count) * radius;
  std::printf(
      "h %.2f mm, fit radius %.2f mm, noise seen %.1f um, position error %.1f um, relative curvature error %.3f"
      " (%s)\n",
      1e3 * facts.median_edge, 1e3 * facts.fit_radius, 1e6 * facts.noise.rms, 1e6 * position, curvature,
      facts.why.c_str());
  EXPECT_NEAR(facts.noise.rms, noise, 0.2 * noise);
  EXPECT_LT(position, 0.5 * noise);
  EXPECT_LT(curvature, 0.15);
}

TEST(BlendSurface, IsTheSameForAnyNumberOfThreads) {
  std::vector<std::vector<double>> values;
  for (std::size_t threads : {1, 2, 7}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const auto surface = build(jittered_torus(kMajor, kMinor, 0.8e-3, 10e-6));
    std::vector<double>& all = values.emplace_back(1, surface->facts().fit_radius);
    for (const Vec3& x : surface->node_positions()) {
      SurfacePoint point;
      ASSERT_TRUE(surface->project(x, point));
      all.insert(all.end(), {point.p.x(), point.p.y(), point.p.z(), point.S(0, 0), point.S(0, 1)});
    }
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(values[0], values[2]);
}

TEST(BlendSurface, FacesOfAThinShellDoNotMix) {
  const double gap = 2e-3;
  const auto top = [](double x, double y) { return 4 * x * x - 3 * y * y; };
  const auto bottom = [=](double x, double y) { return top(x, y) - gap; };
  const Mesh upper = jittered_patch(15e-3, 1e-3, top), lower = jittered_patch(15e-3, 1e-3, bottom, true, 4);
  const auto shell = build(joined(upper, lower), fitted(5e-3));
  const auto single = build(upper, fitted(5e-3));
  EXPECT_EQ(shell->facts().sheet_count, 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(-10e-3, 10e-3), off(-0.6e-3, 0.6e-3);
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    const double x = across(random), y = across(random);
    const Vec3 at(x, y, top(x, y) + off(random));
    const auto a = shell->gap(at), b = single->gap(at);
    ASSERT_TRUE(a && b);
    worst = std::max(worst, std::abs(*a - *b));
    const auto under = shell->gap(Vec3(x, y, bottom(x, y) - 0.1e-3));
    ASSERT_TRUE(under);
    EXPECT_NEAR(*under, 0.1e-3, 2e-6);
  }
  std::printf("shell against its upper face alone: %.1e m\n", worst);
  // Nodes stand elsewhere on the shell than on its face alone: the same surface to the order of the fits. A face that
  // mixed with the other one would err by a millimetre.
  EXPECT_LT(worst, 1e-8);
}

TEST(BlendSurface, DoesNotDependOnTheFrame) {
  const Mesh mesh = jittered_torus(kMajor, kMinor, 1e-3, 5e-6);
  const Pose pose{exp_rotation(Vec3(0.4, -1.1, 0.7)), Vec3(1, -0.3, 0.5)};
  const auto here = build(mesh), there = build(moved(mesh, pose));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> angle(0, kTwoPi), off(-0.5e-3, 0.5e-3);
  double worst = 0, worst_curvature = 0;
  for (int k = 0; k < 500; ++k) {
    const double around = angle(random), across = angle(random);
    const Vec3 x = torus_point(around, across, off(random));
    const auto a = here->gap(x), b = there->gap(pose * x);
    ASSERT_TRUE(a && b);
    worst = std::max(worst, std::abs(*a - *b));
    SurfacePoint p, q;
    ASSERT_TRUE(here->project(x, p) && there->project(pose * x, q));
    worst_curvature = std::max(worst_curvature, (pose.R * tensor(p) * pose.R.transpose() - tensor(q)).norm());
  }
  std::printf("moved by 1 m: gap %.1e m, curvature %.1e 1/m\n", worst, worst_curvature);
  EXPECT_LT(worst, 1e-14);
  EXPECT_LT(worst_curvature, 1e-7);
}

TEST(BlendSurface, NodesCoverTheSurfaceEvenly) {
  const auto surface = build(jittered_torus(kMajor, kMinor, 0.5e-3), fitted(4e-3));
  const BlendFacts& facts = surface->facts();
  double farthest = 0;
  for (const Vec3& v : surface->mesh().vertices) {
    double nearest = 1;
    for (const Vec3& node : surface->node_positions()) nearest = std::min(nearest, (node - v).norm());
    farthest = std::max(farthest, nearest);
  }
  std::printf("%d nodes; farthest vertex %.2f spacings away\n", facts.node_count, farthest / facts.node_spacing);
  EXPECT_LT(farthest, 1.05 * facts.node_spacing);
  const SampleSet samples = surface->samples(0, Vec3::Zero(), 0);
  double area = 0;
  for (int i = 0; i < samples.size(); ++i) {
    EXPECT_GE(surface->node_neighbours(i).size(), 4u);
    area += samples.areas[i];
  }
  EXPECT_NEAR(area, kTwoPi * kMajor * kTwoPi * kMinor, 0.02 * area);
}

TEST(BlendSurface, KnowsHowFarItsEdgeIs) {
  const double half = 10e-3;
  const auto square = build(jittered_patch(half, 1e-3, [](double, double) { return 0.0; }), fitted(3e-3));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-1.08 * half, 1.08 * half);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const double x = across(random), y = across(random);
    const double dx = std::abs(x) - half, dy = std::abs(y) - half;
    const double outside = Vec2(std::max(dx, 0.0), std::max(dy, 0.0)).norm();
    const double exact = outside > 0 ? -outside : std::min(-std::max(dx, dy), square->edge_cap());
    worst = std::max(worst, std::abs(square->edge_distance(Vec3(x, y, 0)) - exact));
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_EQ(build(jittered_torus(kMajor, kMinor, 1e-3))->edge_distance(torus_point(1, 2)),
            std::numeric_limits<double>::infinity());
}

/// A torus of even rows of vertices, `around` of them round the axis and `tube` round the tube.
Mesh even_torus(double major, double minor, int around, int tube) {
  Mesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < tube; ++j) {
      const double a = kTwoPi * i / around, b = kTwoPi * j / tube, rho = major + minor * std::cos(b);
      mesh.vertices.emplace_back(rho * std::cos(a), rho * std::sin(a), minor * std::sin(b));
      const int right = (i + 1) % around * tube, here = i * tube, up = (j + 1) % tube;
      mesh.triangles.push_back({here + j, right + j, right + up});
      mesh.triangles.push_back({here + j, right + up, here + up});
    }
  return mesh;
}

/// Worst distance (m) of the nodes from the torus that `pose` moves.
double worst_node(const BlendSurface& surface, double major, double minor, const Pose& pose) {
  double worst = 0;
  for (const Vec3& node : surface.node_positions()) {
    const Vec3 p = pose.inverse() * node;
    worst = std::max(worst, std::abs(std::hypot(std::hypot(p.x(), p.y()) - major, p.z()) - minor));
  }
  return worst;
}

TEST(BlendSurface, BulgesNowhereBetweenEvenRowsOfVertices) {
  // Three rows within the fit's radius leave a cubic undetermined. In a frame that is turned against them no single
  // monomial is, and the fit went through every vertex and a millimetre past the facets between them.
  constexpr double kMajor67 = 10.706653867667551e-3, kMinor67 = 6.584564307765891e-3;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> turn(-M_PI, M_PI), length(5e-3, 20e-3), part(0.25, 0.7);
  const auto turned = [&] {
    return Pose{exp_rotation({turn(random), turn(random), turn(random)}), {0.02, 0.01, -0.01}};
  };
  for (int draw = 0; draw < 12; ++draw) {
    const Pose pose = turned();
    const auto surface = build(moved(even_torus(kMajor67, kMinor67, 54, 34), pose));
    EXPECT_LT(worst_node(*surface, kMajor67, kMinor67, pose), 0.03e-3) << draw;
  }
  for (int draw = 0; draw < 20; ++draw) {
    const double major = length(random), minor = part(random) * major, edge = 0.2 * minor;
    const Pose pose = turned();
    const auto around = static_cast<int>(kTwoPi * major / edge), tube = static_cast<int>(kTwoPi * minor / edge);
    const auto surface = build(moved(even_torus(major, minor, around, tube), pose));
    EXPECT_LT(worst_node(*surface, major, minor, pose), 0.05 * edge) << major << " " << minor;
  }
}

TEST(BlendSurface, RefusesWhatItCannotUse) {
  const auto refused = [](Mesh mesh, BlendOptions options, const std::string& rule) {
    Diagnostics diagnostics;
    EXPECT_EQ(BlendSurface::build(std::move(mesh), options, "femur", diagnostics), nullptr);
    ASSERT_TRUE(diagnostics.has_errors());
    EXPECT_NE(to_string(diagnostics.items()[0]).find(rule), std::string::npos) << to_string(diagnostics.items()[0]);
  };
  const Mesh good = jittered_torus(kMajor, kMinor, 2e-3);
  refused({}, {}, "no triangles");
  refused(good, fitted(-1), "femur.fit_radius");
  refused(good, fitted(1e-6), "median edge");
  refused(good, fitted(3e-3, 5), "must be 2, 3 or 4");
  refused({{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}}}, {}, "too few vertices");
  refused({{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 3}}}, {}, "does not have");
  refused({{Vec3::Zero(), Vec3::UnitX(), Vec3::Constant(std::nan(""))}, {{0, 1, 2}}}, {}, "not finite");
  refused({{Vec3::Zero(), Vec3::UnitX(), 2 * Vec3::UnitX()}, {{0, 1, 2}}}, {}, "no area");
}

}  // namespace
}  // namespace genu::test
