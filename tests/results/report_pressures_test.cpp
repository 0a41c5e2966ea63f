// Maps of the page add up to what results.csv says of the layer, and leave rows out where they would be too long.
#include "genu/results/report_pressures.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/model/layer_report.h"
#include "support/scene_model.h"

namespace genu {
namespace {

test::SceneModel soft_ball() {
  return test::scene_model(test::bone_on_ground("{ z = 19 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                           test::surface("floor", "ground", "plane") +
                           "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\n"
                           "poisson = 0.4\nthickness = 4\nquadrature = \"smooth\"\n" +
                           test::step(""));
}

struct Case {
  test::SceneModel scene = soft_ball();
  std::vector<State> states;
  std::vector<const State*> shown;
  std::vector<ReportMesh> meshes{2};

  Case() {
    for (int k = 0; k < 4; ++k) {
      states.push_back(reference_state(scene.model));
      states.back().poses[1].p = Vec3(1e-3 * k, 0, k == 3 ? 0.03 : 0.019);  // the last does not touch
    }
    for (int k = 0; k < 4; ++k) shown.push_back(k == 1 ? nullptr : &states[static_cast<std::size_t>(k)]);
  }
  std::vector<ReportPressure> maps(std::size_t most = kMostPressureSamples) const {
    return report_pressures(scene.scene, scene.model, shown, meshes, most);
  }
};

TEST(ReportPressures, BothSurfacesWhereTheyAreInContact) {
  const Case c;
  const auto maps = c.maps();
  ASSERT_EQ(maps.size(), 2u);
  for (const ReportPressure& map : maps) {
    EXPECT_EQ(map.contact, "foot");
    EXPECT_EQ(map.surface, map.body == 1 ? "ball" : "floor");
    EXPECT_EQ(map.mesh, -1);
    EXPECT_EQ(map.every, 1u);
    ASSERT_EQ(map.rows.size(), 4u);
    EXPECT_TRUE(map.rows[1].empty());
    EXPECT_TRUE(map.rows[3].empty());
    for (const std::size_t row : {0, 2}) {
      ElasticLayer::Memory memory;
      const LayerTotals total = report_layer(c.scene.model, {}, c.states[row], 0, memory).total;
      double area = 0, peak = 0;
      Vec3 centre = Vec3::Zero();
      double sum = 0;
      for (const auto& sample : map.rows[row]) {
        const auto site = static_cast<std::size_t>(sample.site);
        const double share = map.radii[site] * map.radii[site] * M_PI;
        area += share;
        peak = std::max(peak, sample.pressure);
        centre += share * sample.pressure * map.places[site];
        sum += share * sample.pressure;
      }
      EXPECT_NEAR(peak, total.max_pressure, 0.02 * total.max_pressure);
      EXPECT_NEAR(area, total.area, 0.1 * total.area);  // sites at the edge stand with all of their area
      const Vec3 expected = map.body == 1 ? total.centre_a : total.centre;
      const double place = (centre / sum - expected + own_origin(c.scene.model, map.body)).head<2>().norm();
      EXPECT_LT(place, 1e-4) << map.surface << " row " << row;
    }
  }
}

TEST(ReportPressures, ALongResultLeavesRowsOut) {
  const Case c;
  std::size_t all = 0;
  for (const ReportPressure& map : c.maps())
    for (const auto& row : map.rows) all += row.size();
  const auto few = c.maps(all - 1);
  ASSERT_EQ(few.size(), 2u);
  for (const ReportPressure& map : few) {
    EXPECT_EQ(map.every, 2u);
    EXPECT_FALSE(map.rows[0].empty());
    EXPECT_FALSE(map.rows[2].empty());
    EXPECT_TRUE(map.rows[1].empty() && map.rows[3].empty());
  }
}

TEST(ReportPressures, NoneWithoutCartilage) {
  const test::SceneModel scene =
      test::scene_model(test::bone_on_ground("{ z = 20 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                        test::surface("floor", "ground", "plane") +
                        "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"rigid\"\n" + test::step(""));
  const State state = reference_state(scene.model);
  EXPECT_TRUE(report_pressures(scene.scene, scene.model, {&state}, std::vector<ReportMesh>(2)).empty());
}

}  // namespace
}  // namespace genu
