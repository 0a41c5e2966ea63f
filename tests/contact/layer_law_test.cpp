#include "genu/contact/layer_law.h"
#include "genu/contact/tolerances.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(LayerLaw, ConfinedModulus) {
  EXPECT_DOUBLE_EQ(confined_modulus(10e6, 0), 10e6);
  // Lame: lambda + 2 mu
  const double E = 10e6, nu = 0.45, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  EXPECT_NEAR(confined_modulus(E, nu), lambda + 2 * mu, 1e-6);
}

TEST(LayerLaw, SlopesAreDerivatives) {
  for (const auto kind : {LayerLaw::Kind::linear, LayerLaw::Kind::logarithmic}) {
    const LayerLaw law{kind, 38e6};
    const double h = 6e-3, step = 1e-9;
    for (const double d : {-5.9e-3, -1e-3, -1e-5, 0.0, 1e-5, 1e-3, 5e-3, 5.699e-3, 5.701e-3, 9e-3}) {
      const double slope = (law.at(d + step, h).p - law.at(d - step, h).p) / (2 * step);
      EXPECT_NEAR(law.at(d, h).slope / slope, 1, 1e-6) << d;
      EXPECT_TRUE(d == 0 || law.at(d, h).p * d > 0) << d;
    }
  }
}

TEST(LayerLaw, IsSmoothWhereContactBegins) {
  const LayerLaw law{LayerLaw::Kind::logarithmic, 38e6};
  const double h = 6e-3, step = 1e-5;
  const auto bend = [&](double d) { return (law.at(d + step, h).slope - law.at(d - step, h).slope) / (2 * step); };
  EXPECT_NEAR(bend(-2e-5) / bend(2e-5), 1, 0.03);
  EXPECT_NEAR(bend(0) * h * h / 38e6, 1, 1e-3);
}

TEST(LayerLaw, LogarithmicBeginsAsLinearAndIsContinuous) {
  const LayerLaw linear{LayerLaw::Kind::linear, 38e6}, log{LayerLaw::Kind::logarithmic, 38e6};
  EXPECT_NEAR(log.at(1e-8, 6e-3).p / linear.at(1e-8, 6e-3).p, 1, 1e-5);
  EXPECT_NEAR(log.at(3e-3, 6e-3).p, 38e6 * std::log(2), 1e-3);
  const double deepest = kMaxCompression * 6e-3;
  EXPECT_NEAR(log.at(deepest * (1 + 1e-12), 6e-3).p / log.at(deepest * (1 - 1e-12), 6e-3).p, 1, 1e-9);
}

}  // namespace
}  // namespace genu
