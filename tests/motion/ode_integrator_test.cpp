#include "genu/motion/ode_integrator.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

/// y'' = -100 y with a root wherever y passes 0.3.
OdeSystem oscillator(double tolerance) {
  OdeSystem s;
  s.size = 2;
  s.roots = 1;
  s.rate = [](double, OdeSystem::Values y, Eigen::Ref<VecX> out) {
    out << y[1], -100 * y[0];
    return true;
  };
  s.weights = [tolerance](OdeSystem::Values, Eigen::Ref<VecX> out) { out << 1 / tolerance, 0.1 / tolerance; };
  s.root_values = [](double, OdeSystem::Values y, double* out) {
    *out = y[0] - 0.3;
    return true;
  };
  return s;
}

TEST(OdeIntegrator, StepsInterpolatesStopsAndFindsRoots) {
  for (const OdeMethod method : {OdeMethod::adams, OdeMethod::bdf}) {
    OdeIntegrator integrator(oscillator(1e-11));
    ASSERT_TRUE(integrator.start(0, Eigen::Vector2d(1, 0), 1, method));
    std::vector<double> roots;
    VecX between;
    double worst = 0, last = 0;
    OdeIntegrator::Step step = OdeIntegrator::Step::taken;
    while (step != OdeIntegrator::Step::stopped) {
      step = integrator.step(1.0);
      ASSERT_NE(step, OdeIntegrator::Step::failed) << integrator.failure();
      const double t = integrator.time(), middle = (last + t) / 2;
      worst = std::max(worst, std::abs(integrator.y()[0] - std::cos(10 * t)));
      integrator.interpolate(middle, between);
      worst = std::max(worst, std::abs(between[0] - std::cos(10 * middle)));
      if (step == OdeIntegrator::Step::root) roots.push_back(integrator.roots()[0] * t);
      last = t;
    }
    EXPECT_EQ(integrator.time(), 1.0);
    EXPECT_LT(worst, 1e-8);
    ASSERT_EQ(roots.size(), 3u);
    EXPECT_NEAR(roots[0], -std::acos(0.3) / 10, 1e-9);
    EXPECT_NEAR(roots[1], (2 * M_PI - std::acos(0.3)) / 10, 1e-9);
    EXPECT_NEAR(roots[2], -(2 * M_PI + std::acos(0.3)) / 10, 1e-9);
    EXPECT_EQ(integrator.counts().starts, 1);
    EXPECT_EQ(integrator.fastest_decay(), 0) << "nothing is damped";
  }
}

TEST(OdeIntegrator, SeesStiffnessAndFailsInWords) {
  OdeSystem s;
  s.size = 1;
  s.rate = [](double t, OdeSystem::Values y, Eigen::Ref<VecX> out) {
    out[0] = -1e5 * (y[0] - std::cos(t));
    return t < 2;
  };
  s.weights = [](OdeSystem::Values, Eigen::Ref<VecX> out) { out.setConstant(1e7); };
  OdeIntegrator integrator(s);
  ASSERT_TRUE(integrator.start(0, VecX::Ones(1), 10, OdeMethod::bdf));
  while (integrator.time() < 1.5) ASSERT_EQ(integrator.step(1.9), OdeIntegrator::Step::taken);
  EXPECT_NEAR(integrator.fastest_decay(), 1e5, 1);
  EXPECT_GT(integrator.last_step(), 1e-3) << "BDF steps over what has decayed";
  OdeIntegrator::Step step = OdeIntegrator::Step::taken;
  while (step == OdeIntegrator::Step::taken) step = integrator.step(10);
  EXPECT_EQ(step, OdeIntegrator::Step::failed);
  EXPECT_LT(integrator.time(), 2);
  EXPECT_FALSE(integrator.failure().empty());
}

}  // namespace
}  // namespace genu
