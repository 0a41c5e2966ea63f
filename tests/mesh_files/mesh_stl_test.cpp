// ASCII STL word by word: nothing is passed over in silence. (Binary files: mesh_reader_test.)
#include <algorithm>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

std::string read_stl_text(const std::string& text, Mesh& mesh) { return read_stl(text, mesh); }

TEST(MeshStl, ReadsWhatExportersWrite) {
  const std::string texts[] = {"solid\n" + kFacet + "endsolid\n",
                               "solid a name of facets\r\n" + kFacet + "endsolid a name",
                               "SOLID x\n" + kFacet + "ENDSOLID x\nsolid y\n" + kFacet + "endsolid y\n",
                               "solid\nfacet normal nan nan nan\nouter loop vertex -1e-3 +2 .5 vertex 1. 0 1E2 vertex "
                               "0 1e-400 0 endloop endfacet endsolid\n"};
  const std::size_t counts[] = {1, 1, 2, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    Mesh mesh;
    EXPECT_EQ(read_stl_text(texts[k], mesh), "") << texts[k];
    EXPECT_EQ(mesh.triangles.size(), counts[k]) << texts[k];
  }
  Mesh mesh;
  read_stl_text(texts[3], mesh);
  EXPECT_EQ(mesh.vertices[0], Vec3(-1e-3, 2, 0.5));
}

TEST(MeshStl, GarbageIsNamedWithItsLine) {
  const std::pair<std::string, std::string> bad[] = {{"0 1 0\n endloop", "0 x 0\n endloop"},
                                                     {"0 1 0\n endloop", "0 1\n endloop"},
                                                     {"0 1 0\n endloop", "0 1 0 0\n endloop"},
                                                     {"vertex 0 1 0", "vertx 0 1 0"},
                                                     {"normal 0 0 1", "normal 0 0"},
                                                     {"endfacet", "endfacet rubbish"},
                                                     {"vertex 0 1 0", "vertex 0 1.5.2 0"},
                                                     {"vertex 0 1 0", "vertex 0 1e400 0"},
                                                     {"endfacet", "end facet"},
                                                     {"vertex 1 0 0\n", ""},
                                                     {"vertex 0 1 0", "vertex 0 1e30 0"},
                                                     {"endloop", "vertex 1 1 0\nendloop"},
                                                     {"endfacet", std::string("end\0facet", 9)}};
  for (const auto& [piece, replacement] : bad) {
    std::string text = "solid\n" + kFacet + kFacet + "endsolid\n";
    text.replace(text.rfind(piece), piece.size(), replacement);
    Mesh mesh;
    const std::string problem = read_stl_text(text, mesh);
    EXPECT_NE(problem.find("in line 1"), std::string::npos) << replacement << ": " << problem;
  }
}

TEST(MeshStl, AsciiIsKnownBehindMarksLongTitlesAndAnyLineEnds) {
  const test::TemporaryFolder folder;
  const std::string plain = "solid a\n" + kFacet + "endsolid a\n";
  std::string carriage = plain;
  std::replace(carriage.begin(), carriage.end(), '\n', '\r');
  const std::string title = "solid " + std::string(5000, 'x') + std::string(3, '\0') + plain.substr(7);
  for (const std::string& text : {"\xef\xbb\xbf" + plain, carriage, title}) {
    Diagnostics out;
    const auto mesh = read_mesh(folder.write("a.stl", text), 1, out);
    ASSERT_TRUE(mesh) << to_string(out.items()[0]);
    EXPECT_EQ(mesh->triangles.size(), 1u);
  }
  Diagnostics out;
  EXPECT_FALSE(read_mesh(folder.write("b.stl", "solid facet" + std::string(200, '\0')), 1, out));
  EXPECT_NE(to_string(out.items()[0]).find("is a binary STL"), std::string::npos);
}

TEST(MeshStl, EveryTruncationIsRefused) {
  const std::string text = "solid\n" + kFacet + kFacet + "endsolid";
  for (std::size_t size = 1; size < text.size(); ++size) {
    Mesh mesh;
    EXPECT_NE(read_stl_text(text.substr(0, size), mesh), "") << size;
  }
}

}  // namespace
}  // namespace genu
