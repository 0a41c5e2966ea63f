#include "genu/mesh_files/mesh_notes.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(MeshNotes, CountRepeatsAndNameTheFirstPlace) {
  MeshNotes notes;
  notes.add("a tail", "it is left out");
  notes.add("odd lines", "they are left out", 7);
  notes.add("odd lines", "they are left out", 9);
  notes.add("odd lines", "they are left out", 9);
  const std::vector<std::string> texts{"has a tail: it is left out",
                                       "has odd lines in line 7 and 2 others: they are left out"};
  EXPECT_EQ(notes.texts(), texts);
}

TEST(MeshNotes, CommasAndPointsExcludeEachOther) {
  MeshNotes notes;
  notes.point();
  EXPECT_EQ(notes.problem(), "");
  EXPECT_TRUE(notes.texts().empty());
  notes.comma("1,5", 3);
  notes.comma("2,5", 4);
  EXPECT_NE(notes.problem().find("has \"1,5\" in line 3 and decimal points elsewhere"), std::string::npos);
  EXPECT_EQ(notes.texts().size(), 1u);
}

TEST(MeshNotes, TellOfPolygonsThatCannotBeCut) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}};
  std::vector<Fan> fans;
  add_polygon({0, 1, 2, 3}, mesh, fans);
  MeshNotes notes;
  cut_polygons(mesh, fans, notes);
  ASSERT_EQ(notes.texts().size(), 1u);
  EXPECT_NE(notes.texts()[0].find("1 polygons that cross themselves"), std::string::npos);
}

}  // namespace
}  // namespace genu
