#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_formats.h"

namespace genu {
namespace {

std::string read_off_text(const std::string& text, Mesh& mesh) { return read_off(text, mesh); }

const std::string kSquare = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST(MeshOff, ReadsCommentsColoursNormalsAndPolygons) {
  const std::string texts[] = {"OFF\n" + kSquare, "OFF # a square\n# of four corners\n" + kSquare,
                               "COFF\n3 1 3\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2 255 0 0\n",
                               "NOFF 3 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 3 0 1 2"};
  const std::size_t triangles[] = {2, 2, 1, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    Mesh mesh;
    EXPECT_EQ(read_off_text(texts[k], mesh), "") << texts[k];
    EXPECT_EQ(mesh.triangles.size(), triangles[k]) << texts[k];
  }
  Mesh mesh;
  read_off_text(texts[0], mesh);
  EXPECT_EQ(mesh.triangles[0], (std::array{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (std::array{0, 2, 3}));
  EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 0));
}

TEST(MeshOff, SaysWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> bad[] = {{"OFX\n" + kSquare, "\"OFX\" in line 1"},
                                                     {"OFF\n4 1\n0 0 0\n", "truncated"},
                                                     {"OFF\n4 1 0\n0 0 zero\n", "\"zero\" in line 3"},
                                                     {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6"},
                                                     {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "names a vertex"},
                                                     {"OFF BINARY\n", "binary OFF is not read"},
                                                     {"OFF\n" + kSquare + "more", "\"more\" in line 8"},
                                                     {"OFF\n99999999999 1 0\n", "a count from 0"},
                                                     {"OFF\n-4 1 0\n", "\"-4\" in line 2 where a count"},
                                                     {"", "truncated"}};
  for (const auto& [text, said] : bad) {
    Mesh mesh;
    EXPECT_NE(read_off_text(text, mesh).find(said), std::string::npos) << text << ": " << read_off_text(text, mesh);
  }
}

}  // namespace
}  // namespace genu
