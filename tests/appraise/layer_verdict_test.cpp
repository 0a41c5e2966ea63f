#include "genu/appraise/layer_verdict.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

PlacedScene scene_with_layer() {
  PlacedScene scene;
  LayerDef layer;
  layer.pair.name = "tf";
  layer.quadrature = LayerDef::Quadrature::triangles;
  layer.cast_from = 0;
  scene.surfaces.resize(1);
  scene.surfaces[0].name = "tibia";
  scene.layers.push_back(layer);
  return scene;
}

JointModel model_with_layer() {
  JointModel model;
  model.layers.push_back({"tf", 0, 1, nullptr, nullptr, nullptr});
  model.layers[0].thinnest = model.layers[0].thickest = 6e-3;
  model.layers[0].search_depth = 4e-3;
  return model;
}

/// Of a layer 6 mm thick.
ResultTable poses(const std::vector<std::pair<double, double>>& depth_and_points) {
  ResultTable table;
  table.add_column("tf.max_depth_mm");
  table.add_column("tf.max_strain");
  table.add_column("tf.points");
  for (const auto& [depth, points] : depth_and_points) {
    table.add_row();
    table.set("tf.max_depth_mm", depth);
    table.set("tf.max_strain", depth / 6);
    table.set("tf.points", points);
  }
  return table;
}

TEST(LayerVerdict, SaysNothingWhereAllIsWell) {
  EXPECT_TRUE(layer_sentences(scene_with_layer(), model_with_layer(), poses({{0.4, 300}, {0, 0}, {0.5, 50}})).empty());
}

TEST(LayerVerdict, FewTrianglesAreTooFew) {
  const auto said = layer_sentences(scene_with_layer(), model_with_layer(), poses({{0.1, 60}, {0.1, 49}, {0.1, 12}}));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("in 2 of 3 rows fewer than 50 triangles of tibia carry the load (12 in row 3)"),
            std::string::npos)
      << said[0];
}

/// The pieces of a meniscus: one sentence, with the worst of them.
TEST(LayerVerdict, ManyLayersWithTooFewAreNamedAtOnce) {
  PlacedScene scene;
  JointModel model;
  ResultTable table;
  const std::vector<std::string> names = {"a", "b", "c", "d", "e"};
  const double points[][5] = {{60, 40, 30, 20, 49}, {70, 45, 10, 0, 49}};
  for (std::size_t k = 0; k < names.size(); ++k) {
    scene.layers.push_back(scene_with_layer().layers[0]);
    scene.layers[k].pair.name = names[k];
    scene.layers[k].cast_from = static_cast<int>(k);
    scene.surfaces.emplace_back().name = "sheet_" + names[k];
    model.layers.push_back(model_with_layer().layers[0]);
    for (const char* column : {".max_depth_mm", ".max_strain", ".points"}) table.add_column(names[k] + column);
  }
  for (const auto& row : points) {
    table.add_row();
    for (std::size_t k = 0; k < names.size(); ++k) {
      table.set(names[k] + ".max_depth_mm", 0.1);
      table.set(names[k] + ".max_strain", 0.02);
      table.set(names[k] + ".points", row[k]);
    }
  }
  const auto said = layer_sentences(scene, model, table);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(
      said[0].find("too coarse for 4 layers: in up to 2 of 2 rows (b) fewer than 50 triangles of a mesh carry the "
                   "load (10 of sheet_c in row 2)"),
      std::string::npos)
      << said[0];
}

TEST(LayerVerdict, DeeperThanTheLawOrTheRays) {
  auto said = layer_sentences(scene_with_layer(), model_with_layer(), poses({{5.8, 300}, {0.1, 60}}));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("pressed by 97 % of its thickness in row 1"), std::string::npos) << said[0];
  said = layer_sentences(scene_with_layer(), model_with_layer(), poses({{3.9, 300}}));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("all of its search depth"), std::string::npos) << said[0];
}

}  // namespace
}  // namespace genu
