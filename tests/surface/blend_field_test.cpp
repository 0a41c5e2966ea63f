// The blend's implicit function: derivatives against differences, smoothness, and the orders of its convergence.
#include "genu/surface/blend_field.h"

#include <cstdio>

#include "support/blend_torus.h"
#include "support/finite_difference.h"

namespace genu::test {
namespace {

struct Errors {
  double position = 0, normal = 0, curvature = 0;
};

/// Rms errors (m, rad, 1/m) of a torus's blend over points drawn evenly in both angles.
Errors torus_errors(const BlendSurface& surface) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(0, kTwoPi);
  Errors sum;
  const int count = 1500;
  for (int k = 0; k < count; ++k) {
    SurfacePoint point;
    const double around = angle(random), across = angle(random);
    EXPECT_TRUE(surface.project(torus_point(around, across), point));
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

TEST(BlendField, GradientAndHessianAgreeWithDifferences) {
  for (int degree : {2, 3, 4}) {
    const auto surface = build(jittered_torus(kMajor, kMinor, 1e-3), fitted(3e-3, degree));
    std::mt19937 random(degree);
    std::uniform_real_distribution<double> angle(0, kTwoPi), off(-0.6e-3, 0.6e-3);
    double worst_gradient = 0, worst_hessian = 0;
    for (int k = 0; k < 300; ++k) {
      const double around = angle(random), across = angle(random);
      const Vec3 x = torus_point(around, across, off(random));
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

TEST(BlendField, ConvergesWithTheOrdersOfItsDegree) {
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

TEST(BlendField, CurvatureIsContinuousAlongAPath) {
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
  // Three decades: 20 um to 20 nm.
  double coarse = largest_jump(2000);
  for (int steps : {20000, 200000, 2000000}) {
    const double fine = largest_jump(steps);
    std::printf("largest jump of curvature %.3e 1/m in %d steps, %.2f times less than in a tenth of them\n", fine,
                steps, coarse / fine);
    EXPECT_GT(coarse / fine, 9);
    EXPECT_LT(coarse / fine, 11);
    coarse = fine;
  }
}

}  // namespace
}  // namespace genu::test
