// OBJ: what it holds, and the line of what is wrong with it.
#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_formats.h"
#include "support/text.h"

namespace genu {
namespace {

using test::with_first;

const std::string kObj = "# made by hand\nv 0 0 0\nv 1 0 0 1\nv 0 1 0 0.5 0.5 1\nvn 0 0 1\nusemtl x\nf 1/2/3 2//3 3\n";

std::string problem(const std::string& text) {
  Mesh mesh;
  return read_obj(text, mesh);
}

Mesh good_obj(const std::string& text) {
  Mesh mesh;
  EXPECT_EQ(read_obj(text, mesh), "");
  return mesh;
}

TEST(MeshObj, ReadsVerticesAndFacesOfAnyLineEnds) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : kObj) text += c == '\n' ? end : std::string(1, c);
    const Mesh mesh = good_obj(text);
    EXPECT_EQ(mesh.vertices, corners);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.triangles[0], (std::array{0, 1, 2}));
  }
  EXPECT_EQ(good_obj(with_first(kObj, "f 1/2/3 2//3 3", "f -3 \\\n-2 -1")).triangles[0], (std::array{0, 1, 2}));
  EXPECT_EQ(good_obj("f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n").triangles.size(), 2u)
      << "vertices may come later";
  EXPECT_EQ(good_obj(with_first(kObj, "v 1 0 0 1", "v 1.00000000000001 0 0")).vertices[1].x(), 1.00000000000001)
      << "doubles";
}

TEST(MeshObj, NamesTheLineOfWhatIsWrong) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(problem(text).find(part), std::string::npos) << problem(text);
  };
  says(with_first(kObj, "v 1 0 0 1", "v 1 zero 0"), "in line 3 has \"zero\"");
  says(with_first(kObj, "v 1 0 0 1", "v 1 0"), "in line 3 has fewer than three");
  says(with_first(kObj, "v 1 0 0 1", "v 1 0 0 0.5"), "in line 3 has a vertex with a weight");
  says(with_first(kObj, "v 1 0 0 1", "v 1e30 0 0"), "in line 3 has \"1e30\"");
  says(with_first(kObj, "v 1 0 0 1", "v nan 0 0"), "in line 3 has \"nan\"");
  says(with_first(kObj, "2//3", "b//3"), "in line 7 has \"b//3\"");
  says(with_first(kObj, "2//3", "/3"), "in line 7 has \"/3\"");
  says(with_first(kObj, "2//3", "0"), "in line 7 names vertex 0");
  says(with_first(kObj, "2//3", "-4"), "in line 7 names vertex -4");
  says(with_first(kObj, "2//3", "9"), "in line 7 names vertex 9 of 3");
  says(with_first(kObj, " 3\n", "\n"), "in line 7 has a face of fewer than three");
}

}  // namespace
}  // namespace genu
