// What a file says of a solid, part by part, is what its function is.
#include "genu/assemble/build_solid.h"

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

SolidField solid_of(const std::string& parts) {
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto scene =
      read_surface_file(folder.write("s.toml",
                                     "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[solid.s]\n"
                                     "parts = [" +
                                         parts + "]\n"),
                        out);
  EXPECT_TRUE(scene) << test::messages(out);
  return make_solid(scene->solids.at(0));
}

/// How far the surface is from the origin along x, y, z (mm), which lies inside.
Vec3 reach(const SolidField& solid) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const auto inside = [&](double mm) { return solid(1e-3 * mm * Vec3::Unit(k)).f < 0; };
    double high = 0;
    while (high < 200 && inside(high)) high += 0.5;  // to where it ends first
    double low = high - 0.5;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (inside(middle) ? low : high) = middle;
    }
    out[k] = low;
  }
  return out;
}

TEST(BuildSolid, EveryShapeHasItsSizes) {
  const auto expect = [](const std::string& part, const Vec3& sizes) {
    EXPECT_LT((reach(solid_of(part)) - sizes).norm(), 1e-9) << part;
  };
  expect("{ shape = \"sphere\", radius = 20 }", {20, 20, 20});
  expect("{ shape = \"sphere\", radius = 20, origin = [5, 0, 0] }", {25, std::sqrt(375.0), std::sqrt(375.0)});
  expect("{ shape = \"ellipsoid\", radii = [20, 30, 40] }", {20, 30, 40});
  expect("{ shape = \"ellipsoid\", radii = [20, 30, 40], x_axis = [0, 1, 0] }", {30, 20, 40});
  expect("{ shape = \"rod\", from = [0, -10, 0], to = [0, 50, 0], radii = [9, 9] }", {9, 59, 9});
  expect("{ shape = \"rod\", from = [0, 0, 0], to = [0, 50, 0], radii = [9, 6] }", {9, 56, 9});
  expect("{ shape = \"torus\", major_radius = 15, minor_radius = 5, origin = [15, 0, 0] }",
         {5, std::sqrt(400.0 - 225), 5});
  expect("{ shape = \"box\", size = [10, 20, 30], rounding = 2 }", {5, 10, 15});
  expect("{ shape = \"sphere\", radius = 20 }, { shape = \"half_space\", origin = [0, 0, 7], operation = \"keep\" }",
         {20, 20, 7});
  expect(
      "{ shape = \"sphere\", radius = 20 }, { shape = \"sphere\", radius = 5, origin = [20, 0, 0], operation = "
      "\"cut\" }",
      {15, 20, 20});
}

}  // namespace
}  // namespace genu
