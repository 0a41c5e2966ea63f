// The blend against finite differences, against shapes it must converge to, and against itself moved or rebuilt.
#include "genu/geometry/blend_surface.h"

#include <cstdio>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "geometry/blend_meshes.h"
#include "support/finite_difference.h"

namespace genu {
namespace {

using test::jittered_patch;
using test::jittered_torus;

constexpr double kMajor = 15e-3, kMinor = 5e-3;

std::unique_ptr<BlendSurface> build(Mesh mesh, BlendOptions options = {}) {
  Diagnostics diagnostics;
  auto surface = BlendSurface::build(std::move(mesh), options, "surface", diagnostics);
  for (const Diagnostic& d : diagnostics.items()) ADD_FAILURE() << to_string(d);
  return surface;
}

BlendOptions fitted(double radius, int degree = 3) {
  BlendOptions options;
  options.fit_radius = radius;
  options.degree = degree;
  return options;
}

Vec3 torus_point(double a, double b, double off = 0) {
  const Vec3 out(std::cos(a), std::sin(a), 0);
  return kMajor * out + (kMinor + off) * (std::cos(b) * out + std::sin(b) * Vec3::UnitZ());
}

Mat3 tensor(const SurfacePoint& point) { return point.T * point.S * point.T.transpose(); }

struct Errors {
  double position = 0, normal = 0, curvature = 0;
};

/// Rms errors (m, rad, 1/m) of a torus's blend over points drawn evenly in both angles.
Errors torus_errors(const BlendSurface& surface) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(0, test::kTwoPi);
  Errors sum;
  const int count = 1500;
  for (int k = 0; k < count; ++k) {
    SurfacePoint point;
    EXPECT_TRUE(surface.project(torus_point(angle(random), angle(random)), point));
    const Vec3 out = Vec3(point.p.x(), point.p.y(), 0).normalized();
    const Vec3 arm = point.p - kMajor * out, n = arm.normalized(), round = Vec3::UnitZ().cross(out);
    const Vec3 meridian = n.cross(round);
    const double rho = kMajor + kMinor * n.dot(out);
    const Mat3 S = -meridian * meridian.transpose() / kMinor - round * round.transpose() * n.dot(out) / rho;
    sum.position += std::pow(arm.norm() - kMinor, 2);
    sum.normal += (point.n - n).squaredNorm();
    sum.curvature += (tensor(point) - S).squaredNorm();
  }
  return {std::sqrt(sum.position / count), std::sqrt(sum.normal / count), std::sqrt(sum.curvature / count)};
}

/// Slope of log error over log edge by least squares.
double order(const std::vector<double>& edges, const std::vector<double>& errors) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const double n = static_cast<double>(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double a = std::log(edges[i]), b = std::log(errors[i]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

TEST(BlendSurface, GradientAndHessianAgreeWithDifferences) {
  for (int degree : {2, 3, 4}) {
    const auto surface = build(jittered_torus(kMajor, kMinor, 1e-3), fitted(3e-3, degree));
    std::mt19937 random(degree);
    std::uniform_real_distribution<double> angle(0, test::kTwoPi), off(-0.6e-3, 0.6e-3);
    double worst_gradient = 0, worst_hessian = 0;
    for (int k = 0; k < 300; ++k) {
      const Vec3 x = torus_point(angle(random), angle(random), off(random));
      double f, value;
      Vec3 gradient, first;
      Mat3 hessian;
      ASSERT_TRUE(surface->implicit(x, f, gradient, hessian));
      ASSERT_TRUE(surface->implicit(x, value, first));
      EXPECT_NEAR(value, f, 1e-16);
      EXPECT_LT((first - gradient).norm(), 1e-12);
      const auto value_at = [&](const Eigen::VectorXd& y) {
        double v = 0;
        EXPECT_TRUE(surface->implicit(Vec3(y), v));
        return Eigen::VectorXd(Eigen::VectorXd::Constant(1, v));
      };
      const auto gradient_at = [&](const Eigen::VectorXd& y) {
        double v = 0;
        Vec3 g = Vec3::Zero();
        EXPECT_TRUE(surface->implicit(Vec3(y), v, g));
        return Eigen::VectorXd(g);
      };
      const Eigen::MatrixXd numeric_gradient = test::jacobian(value_at, x, 2e-6);
      const Eigen::MatrixXd numeric_hessian = test::jacobian(gradient_at, x, 2e-6);
      worst_gradient = std::max(worst_gradient, (numeric_gradient.transpose() - gradient).norm());
      worst_hessian = std::max(worst_hessian, (numeric_hessian - hessian).norm() / (1 + hessian.norm()));
    }
    std::printf("degree %d: gradient %.1e, relative Hessian %.1e\n", degree, worst_gradient, worst_hessian);
    EXPECT_LT(worst_gradient, 1e-8);
    EXPECT_LT(worst_hessian, 1e-6);
  }
}

TEST(BlendSurface, ConvergesWithTheOrdersOfItsDegree) {
  const std::vector<double> edges = {1e-3, 0.7e-3, 0.5e-3, 0.35e-3};
  for (int degree : {2, 3, 4}) {
    std::vector<double> position, normal, curvature;
    for (double edge : edges) {
      const auto surface = build(jittered_torus(kMajor, kMinor, edge), fitted(3 * edge, degree));
      const Errors e = torus_errors(*surface);
      std::printf("degree %d edge %.2f mm: position %.2e m, normal %.2e rad, curvature %.2e 1/m\n", degree, 1e3 * edge,
                  e.position, e.normal, e.curvature);
      position.push_back(e.position);
      normal.push_back(e.normal);
      curvature.push_back(e.curvature);
    }
    const double p = order(edges, position), n = order(edges, normal), c = order(edges, curvature);
    std::printf("degree %d: orders %.2f %.2f %.2f\n", degree, p, n, c);
    EXPECT_GT(p, degree + 0.7);
    EXPECT_GT(n, degree - 0.3);
    EXPECT_GT(c, degree - 1.3);
  }
}

TEST(BlendSurface, CurvatureIsContinuousAlongAPath) {
  const auto surface = build(jittered_torus(kMajor, kMinor, 2e-3), fitted(5e-3));
  const auto largest_jump = [&](int steps) {
    double largest = 0;
    Mat3 last;
    for (int k = 0; k <= steps; ++k) {
      SurfacePoint point;
      const double s = static_cast<double>(k) / steps;
      EXPECT_TRUE(surface->project(torus_point(2 * s, 5 * s), point));
      if (k > 0) largest = std::max(largest, (tensor(point) - last).norm());
      last = tensor(point);
    }
    return largest;
  };
  double coarse = largest_jump(4000);
  for (int steps : {16000, 64000}) {
    const double fine = largest_jump(steps);
    std::printf("largest jump of curvature %.3e 1/m in %d steps, %.2f times less than in a quarter of them\n", fine, steps,
                coarse / fine);
    EXPECT_GT(coarse / fine, 3.6);
    coarse = fine;
  }
}

TEST(BlendSurface, ProjectsOntoItselfAndFollowsTangentSteps) {
  const auto surface = build(jittered_torus(kMajor, kMinor, 1e-3), fitted(3e-3));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(0, test::kTwoPi), off(-0.5e-3, 0.5e-3);
  double worst_value = 0, worst_normal = 0;
  for (int k = 0; k < 300; ++k) {
    SurfacePoint point;
    ASSERT_TRUE(surface->project(torus_point(angle(random), angle(random), off(random)), point));
    const auto gap = surface->gap(point.p);
    ASSERT_TRUE(gap);
    worst_value = std::max(worst_value, std::abs(*gap));
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3 slope = test::derivative([&](double s) {
        SurfacePoint to;
        EXPECT_TRUE(surface->retract(point, s * Vec2::Unit(axis), to));
        return Vec3(to.n);
      }, 1e-5);
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

TEST(BlendSurface, SmoothsANoisySphere) {
  const double radius = 20e-3, noise = 15e-6;
  const auto surface = build(test::noisy_sphere(radius, 5, noise));
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
  std::printf("h %.2f mm, fit radius %.2f mm, noise seen %.1f um, position error %.1f um, relative curvature error %.3f (%s)\n",
              1e3 * facts.median_edge, 1e3 * facts.fit_radius, 1e6 * facts.noise_rms, 1e6 * position, curvature,
              facts.why.c_str());
  EXPECT_NEAR(facts.noise_rms, noise, 0.2 * noise);
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
  const auto shell = build(test::joined(jittered_patch(15e-3, 1e-3, top), jittered_patch(15e-3, 1e-3, bottom, true, 4)), fitted(5e-3));
  const auto single = build(jittered_patch(15e-3, 1e-3, top), fitted(5e-3));
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
  EXPECT_LT(worst, 1e-15);
}

TEST(BlendSurface, DoesNotDependOnTheFrame) {
  const Mesh mesh = jittered_torus(kMajor, kMinor, 1e-3, 5e-6);
  const Pose pose{exp_rotation(Vec3(0.4, -1.1, 0.7)), Vec3(1, -0.3, 0.5)};
  const auto here = build(mesh), there = build(test::moved(mesh, pose));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> angle(0, test::kTwoPi), off(-0.5e-3, 0.5e-3);
  double worst = 0, worst_curvature = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 x = torus_point(angle(random), angle(random), off(random));
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
  EXPECT_NEAR(area, test::kTwoPi * kMajor * test::kTwoPi * kMinor, 0.02 * area);
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
  refused(good, fitted(1e-3, 5), "must be 2, 3 or 4");
  refused({{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}}}, {}, "too few vertices");
  refused({{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 3}}}, {}, "does not have");
  refused({{Vec3::Zero(), Vec3::UnitX(), Vec3::Constant(std::nan(""))}, {{0, 1, 2}}}, {}, "not finite");
  refused({{Vec3::Zero(), Vec3::UnitX(), 2 * Vec3::UnitX()}, {{0, 1, 2}}}, {}, "no area");
}

}  // namespace
}  // namespace genu
