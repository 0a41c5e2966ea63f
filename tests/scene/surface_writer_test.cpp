#include "genu/scene/surface_writer.h"

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "genu/scene/region_text.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

SurfaceDef polynomial(bool cylindrical) {
  SurfaceDef def;
  def.name = "condyle";
  def.shape = cylindrical ? SurfaceDef::Shape::cylindrical_polynomial : SurfaceDef::Shape::polynomial;
  def.placement = {exp_rotation(Vec3(0.3, 1, -2)), Vec3(0.01, -0.02, 1.0 / 300)};
  def.inside = cylindrical;
  def.terms = {{0, 0, 0.021}, {1, 0, -0.001}, {0, 1, 0.1 / 3}, {2, 3, 1e4 / 7}};
  SurfaceDef::Patch patch;
  patch.box[cylindrical ? 2 : 1] = std::pair(-0.011, 0.012);
  (cylindrical ? patch.theta : patch.box[0]) = std::pair(-0.5, 0.75);
  def.patch = patch;
  return def;
}

TEST(SurfaceWriter, WhatItWritesReadsBack) {
  const test::TemporaryFolder folder;
  for (const bool cylindrical : {false, true}) {
    for (const bool millimetres : {false, true}) {
      const SurfaceDef def = polynomial(cylindrical);
      const std::string header =
          std::string("format = 1\nunits = { length = \"") + (millimetres ? "mm" : "m") + "\", angle = \"rad\" }\n";
      Diagnostics out;
      const auto scene = read_surface_file(
          folder.write("s.toml", header + polynomial_table(def, "femur", millimetres ? 1e-3 : 1, 1)), out);
      for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
      ASSERT_TRUE(scene);
      ASSERT_EQ(scene->surfaces.size(), 1u);
      EXPECT_EQ(scene->bodies.at(0).name, "femur");
      const SurfaceDef& back = scene->surfaces[0];
      EXPECT_EQ(back.shape, def.shape);
      EXPECT_EQ(back.inside, def.inside);
      EXPECT_LT((back.placement.p - def.placement.p).norm(), 1e-16);
      EXPECT_LT((back.placement.R - def.placement.R).norm(), 1e-14);
      ASSERT_EQ(back.terms.size(), def.terms.size());
      for (std::size_t k = 0; k < def.terms.size(); ++k) EXPECT_NEAR(back.terms[k].c / def.terms[k].c, 1, 1e-14);
      EXPECT_NEAR((cylindrical ? back.patch->theta : back.patch->box[0])->second, 0.75, 1e-12);
      EXPECT_NEAR(back.patch->box[cylindrical ? 2 : 1]->first, -0.011, 1e-14);
    }
  }
}

TEST(SurfaceFile, HasSurfacesAndNothingElse) {
  const test::TemporaryFolder folder;
  const std::string good = "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n" +
                           polynomial_table(polynomial(false), "femur", 1e-3, 1);
  Diagnostics out;
  EXPECT_FALSE(read_surface_file(folder.write("a.toml", good + "[ligament.a]\nlaw = \"spring\"\n"), out));
  EXPECT_FALSE(read_surface_file(folder.write("b.toml", good + "[surface.c]\nbody = \"x\"\nshape = \"cube\"\n"), out));
  EXPECT_FALSE(read_surface_file(folder / "none.toml", out));
  EXPECT_EQ(out.count(Diagnostic::Severity::error), 3u);
  Diagnostics whole;  // a scene is read as one, with everything a scene needs
  EXPECT_FALSE(read_surface_file(folder.write("c.toml", good + "[body.femur]\nfixed = true\n"), whole));
  EXPECT_GT(whole.count(Diagnostic::Severity::error), 1u);
}

TEST(RegionText, IsReadInItsUnit) {
  const auto found = parse_region(" z >= -2 and x<5", 1e-3);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 2u);
  EXPECT_DOUBLE_EQ(found->at(0).value, -0.002);
  EXPECT_EQ(found->at(1).axis, 0);
  for (const char* bad : {"", "z", "z <", "q < 3", "z < 3 or x < 2", "z < inf"})
    EXPECT_FALSE(parse_region(bad, 1)) << bad;
}

}  // namespace
}  // namespace genu
