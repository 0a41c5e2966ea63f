// Words that assimp would read as the number 0.
#include <gtest/gtest.h>

#include "genu/geometry/mesh_formats.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(MeshAssimp, WordsThatAreNoNumbersAreNamedWithTheirLine) {
  const test::TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string obj = "# made by hand\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nvn 0 0 1\nusemtl x\nf 1/2/3 2//3 3\n";
  EXPECT_EQ(check_numbers(folder.write("a.ply", ply)), "");
  EXPECT_EQ(check_numbers(folder.write("a.obj", obj)), "");
  EXPECT_EQ(check_numbers(folder.write("b.ply", "ply\nformat binary_little_endian 1.0\nend_header\n\x01junk")), "");
  const auto broken = [](std::string text, const std::string& piece, const std::string& by) {
    return text.replace(text.find(piece), piece.size(), by);
  };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(check_numbers(folder.write("c.ply", broken(ply, "1 0 0\n", "1 O 0\n"))), "in line 11 has \"O\"");
  says(check_numbers(folder.write("c.obj", broken(obj, "v 1 0 0 1", "v 1 zero 0"))), "in line 3 has \"zero\"");
  says(check_numbers(folder.write("d.obj", broken(obj, "v 1 0 0 1", "v 1 0"))), "in line 3 has fewer than three");
  says(check_numbers(folder.write("e.obj", broken(obj, "2//3", "b//3"))), "in line 7 has \"b//3\"");
}

}  // namespace
}  // namespace genu
