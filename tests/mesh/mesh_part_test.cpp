#include "genu/mesh/mesh_part.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

/// Two squares, of 1 and 4 m^2, and a triangle without area.
Mesh squares() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {7, 0, 0}, {7, 2, 0}, {5, 2, 0}},
          {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {0, 0, 1}}};
}

TEST(MeshPart, KeepsWhatIsAskedFor) {
  const Mesh left = part_of(squares(), [](const Vec3& p, const Vec3& n) { return p.x() < 3 && n.z() > 0; });
  EXPECT_EQ(left.triangles.size(), 2u);
  EXPECT_EQ(left.vertices.size(), 4u);
  EXPECT_DOUBLE_EQ(area_of(left), 1);
  EXPECT_TRUE(part_of(squares(), [](const Vec3&, const Vec3& n) { return n.z() < 0; }).empty());
}

TEST(MeshPart, SheetsComeByArea) {
  const auto sheets = sheets_of(squares(), 0.1);
  ASSERT_EQ(sheets.size(), 2u);
  EXPECT_DOUBLE_EQ(area_of(sheets[0]), 4);
  EXPECT_EQ(sheets_of(squares(), 0.5).size(), 1u);
  EXPECT_DOUBLE_EQ(area_of(largest_sheet(squares())), 4);
  EXPECT_TRUE(largest_sheet({}).empty());
}

}  // namespace
}  // namespace genu
