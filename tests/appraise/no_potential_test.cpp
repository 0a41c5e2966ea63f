// Which loads and layers are named as causes of flutter.
#include "genu/appraise/no_potential.h"

#include <gtest/gtest.h>

#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "support/scenes.h"

namespace genu {
namespace {

/// The causes of a hinged block with one load, which `keys` describe.
std::vector<std::string> causes(const std::string& keys) {
  Diagnostics out;
  const auto scene = parse_scene(R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.block]
[joint.j]
type = "free"
parent = "ground"
child = "block"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
[load.push]
)" + keys + "[[step]]\nincrements = 1\nload = { push = [0, 1] }\n",
                                 "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  return scene ? without_potential(place(*scene)) : std::vector<std::string>{};
}

TEST(NoPotential, OfDeadLoadsNone) {
  EXPECT_TRUE(causes("body = \"block\"\nforce = [1, 0, 0]\n").empty());
  EXPECT_TRUE(causes("on = \"j.a\"\nvalue = 2\n").empty());
}

TEST(NoPotential, LoadsThatTurnWithABodyAndMomentsAreNamed) {
  EXPECT_EQ(causes("body = \"block\"\nforce = [1, 0, 0]\nframe = \"body\"\n"),
            std::vector<std::string>{"load push (it turns with block)"});
  EXPECT_EQ(causes("body = \"block\"\nmoment = [1, 0, 0]\n"),
            std::vector<std::string>{"load push (a moment that is constant in the world)"});
}

TEST(NoPotential, AScaleOverTheLoadsOwnCoordinateHasOne) {
  const std::string over = "table = [[0, 1], [90, 2]] }\n";
  EXPECT_TRUE(causes("on = \"j.a\"\nvalue = 2\nscale = { over = \"j.a\", " + over).empty());
  EXPECT_EQ(causes("on = \"j.a\"\nvalue = 2\nscale = { over = \"j.b\", " + over).size(), 1u);
  EXPECT_EQ(causes("body = \"block\"\nforce = [1, 0, 0]\nscale = { over = \"j.a\", " + over).size(), 1u);
}

TEST(NoPotential, ManyLayersAreOneCause) {
  PlacedScene scene;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    scene.layers.emplace_back();
    scene.layers.back().pair.name = name;
    scene.layers.back().quadrature = LayerDef::Quadrature::triangles;
  }
  ASSERT_EQ(without_potential(scene).size(), 1u);
  EXPECT_EQ(without_potential(scene)[0].substr(0, 45), "the triangles of cartilage a, b, c and 2 more");
  scene.layers.resize(2);
  EXPECT_EQ(without_potential(scene)[0].substr(0, 33), "the triangles of cartilage a, b (");
  scene.layers.back().quadrature = LayerDef::Quadrature::smooth;
  EXPECT_EQ(without_potential(scene)[0].substr(0, 30), "the triangles of cartilage a (");
}

}  // namespace
}  // namespace genu
