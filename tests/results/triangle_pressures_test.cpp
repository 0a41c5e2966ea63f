// Triangle by triangle what the layer reports as a whole.
#include "genu/results/triangle_pressures.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "genu/model/layer_report.h"
#include "support/scene_model.h"

namespace genu {
namespace {

test::SceneModel pressed_ball() {
  return test::scene_model(test::bone_on_ground("{ z = 19 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                           test::surface("floor", "ground", "plane") +
                           "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\n"
                           "poisson = 0.4\nthickness = 4\nquadrature = \"triangles\"\ncast_from = \"ball\"\n" +
                           test::step(""));
}

TEST(TrianglePressures, AreThoseTheLayerReports) {
  test::SceneModel ball = pressed_ball();
  EXPECT_TRUE(PressureFinder(ball.scene, ball.model).surfaces().empty()) << "a formula has no triangles of a file";
  ball.scene.surfaces[0].shape = SurfaceDef::Shape::mesh;  // what casts are triangles either way
  PressureFinder finder(ball.scene, ball.model);
  EXPECT_EQ(finder.surfaces(), std::vector<int>{0});
  const State state = reference_state(ball.model);
  const auto found = finder.at(state, {});
  ASSERT_EQ(found.size(), 1u);
  ElasticLayer::Memory memory;
  const LayerTotals total = report_layer(ball.model, {}, state, 0, memory).total;
  ASSERT_GT(total.points, 20);
  EXPECT_EQ(*std::max_element(found[0].pressure.begin(), found[0].pressure.end()), total.max_pressure);
  EXPECT_EQ(*std::max_element(found[0].depth.begin(), found[0].depth.end()), total.max_depth);
  EXPECT_EQ(found[0].pressure.size() -
                static_cast<std::size_t>(std::count(found[0].pressure.begin(), found[0].pressure.end(), 0.0)),
            static_cast<std::size_t>(total.points));
}

}  // namespace
}  // namespace genu
