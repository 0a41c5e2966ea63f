// What a layer reports for parts of its contact area: shares of a closed form.
#include "genu/model/layer_report.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/assemble/prepare.h"
#include "genu/model/layer_levels.h"
#include "support/places.h"
#include "support/scene_model.h"
#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kBall = 20e-3, kPressed = 0.5e-3;  // m

/// A ball pressed into a plane, refined to its tolerance; m.
struct PressedBall {
  std::optional<Prepared> prepared;
  State state;

  explicit PressedBall(const std::string& quadrature) {
    const test::TemporaryFolder folder;
    Diagnostics out;
    const std::string floor = "patch = { x = [-9, 9], y = [-9, 9] }";
    prepared =
        prepare(folder.write("scene.toml", test::bone_on_ground("{ z = 0 }") +
                                               test::surface("ball", "bone", "sphere", "radius = 20") +
                                               test::surface("floor", "ground", "plane", floor) +
                                               test::layer("foot", "ball", "floor", quadrature) + test::step("")),
                out);
    EXPECT_TRUE(prepared) << test::messages(out);
    state = start_state(prepared->model);
    state.poses[1].p = Vec3(0.3e-3, 0.1e-3, kBall - kPressed);
    Linearization here;
    do {
      linearize_forces(prepared->model, state, Target{}, here);
    } while (raise_layer_levels(prepared->model, here, state));
  }

  /// Split by a plane across x, `offset` (m) from the middle of contact.
  LayerReport split(double offset) const {
    using C = RegionDef::Comparison;
    const double at = state.poses[1].p.x() + offset;
    const std::vector<RegionDef> regions{{"left", {{0, C::less, at}}}, {"right", {{0, C::greater_equal, at}}}};
    ElasticLayer::Memory memory;
    return report_layer(prepared->model, regions, state, 0, memory, nullptr);
  }
};

/// Share of a load that falls as 1 - (r / a)^2 in what lies beyond x = s a.
double share_beyond(double s) {
  // Across x the load is 4/3 (1 - x^2)^(3/2) of pi / 2.
  const auto primitive = [](double x) {
    const double root = std::sqrt(1 - x * x);
    return (x * root * (5 - 2 * x * x) + 3 * std::asin(x)) / 8;
  };
  return (primitive(1) - primitive(s)) * 4 / 3 / (M_PI / 2);
}

TEST(RegionShares, RegionsShareASmoothContactAsTheirBorderCutsIt) {
  const PressedBall ball("");
  const double radius = std::sqrt(2 * kBall * kPressed);  // of contact, m, but for the sphere's fourth order
  for (const double s : {-0.7, -0.31, -0.05, 0.0, 0.02, 0.11, 0.4, 0.63}) {
    const LayerReport report = ball.split(s * radius);
    const double all = report.total.force.norm(), right = report.regions[1].force.norm();
    EXPECT_NEAR(report.regions[0].force.norm() + right, all, 2e-3 * all);  // the normals of both are not quite the same
    EXPECT_LT((report.regions[0].force + report.regions[1].force - report.total.force).norm(), 1e-4 * all);
    EXPECT_NEAR(report.regions[0].area + report.regions[1].area, report.total.area, 1e-12 * report.total.area);
    EXPECT_NEAR(right / all, share_beyond(s), 0.005) << s;
  }
}

TEST(RegionShares, ASliverPressesAndLiesInItsRegion) {
  const PressedBall ball("");
  const double radius = std::sqrt(2 * kBall * kPressed);
  for (double s = 0.8; s < 1.1; s += 0.013) {
    const LayerTotals sliver = ball.split(s * radius).regions[1];
    EXPECT_GE(sliver.area, 0) << s;
    EXPECT_GE(sliver.force.z() * ball.split(0).total.force.z(), 0) << s;
    EXPECT_GE(sliver.max_pressure * (1 + 1e-9), sliver.mean_pressure) << s;
    EXPECT_EQ(sliver.points > 0, sliver.area > 0) << s;
    if (sliver.points > 0) {
      EXPECT_GE(sliver.centre.x(), ball.state.poses[1].p.x() + s * radius - 1e-12) << s;
    }
  }
}

TEST(RegionShares, BandsHaveAllOfItTogether) {
  const PressedBall ball("");
  using C = RegionDef::Comparison;
  for (const double half : {0.02e-3, 0.1e-3, 0.4e-3, 2e-3}) {
    const double x = ball.state.poses[1].p.x();
    ElasticLayer::Memory memory;
    const std::vector<RegionDef> regions{{"left", {{0, C::less, x - half}}},
                                         {"band", {{0, C::greater_equal, x - half}, {0, C::less, x + half}}},
                                         {"right", {{0, C::greater_equal, x + half}}}};
    const LayerReport report = report_layer(ball.prepared->model, regions, ball.state, 0, memory, nullptr);
    double area = 0;
    for (const LayerTotals& part : report.regions) area += part.area;
    if (report.regions[1].points > 0) {
      EXPECT_NEAR(area, report.total.area, 1e-9 * area) << half;
    }
  }
}

TEST(RegionShares, SharesOfRegionsAreContinuous) {
  const PressedBall ball("");
  const double all = ball.split(0).total.force.norm(), step = 2e-6;
  for (int i = -40; i < 40; ++i) {
    const double here = ball.split(i * step).regions[1].force.norm(),
                 next = ball.split((i + 1) * step).regions[1].force.norm();
    // At most a diameter's pressure times the step, twice: nodes are not spread evenly.
    EXPECT_LT(std::abs(next - here), 2 * 0.6 * all * step / std::sqrt(2 * kBall * kPressed)) << i;
  }
}

TEST(RegionShares, TrianglesBelongToTheRegionOfTheirCentre) {
  const PressedBall ball("quadrature = \"triangles\"\ncast_from = \"floor\"");
  const LayerReport report = ball.split(0.1e-3);
  EXPECT_EQ(report.regions[0].points + report.regions[1].points, report.total.points);
  EXPECT_LT((report.regions[0].force + report.regions[1].force - report.total.force).norm(),
            1e-12 * report.total.force.norm());
}

}  // namespace
}  // namespace genu
