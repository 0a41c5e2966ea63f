#include "genu/mesh_files/mesh_writer.h"

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "support/fitted_shapes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(MeshWriter, EveryFormatReadsBack) {
  const test::TemporaryFolder folder;
  const Mesh mesh =
      chart_mesh({false, test::some_frame()}, {-0.01, 0.01, -0.01, 0.01}, test::plateau_terms(), false, 2e-3);
  for (const char* name : {"a.stl", "a.ply", "a.obj"}) {
    const std::string path = folder / name;
    ASSERT_EQ(write_mesh(mesh, path, 1e-3, "two\nlines"), "");
    const std::string bytes = test::read_file(path);
    ASSERT_EQ(write_mesh(mesh, path, 1e-3, "two\nlines"), "");
    EXPECT_EQ(bytes, test::read_file(path));
    Diagnostics out;
    const auto back = read_mesh(path, 1e-3, out);
    ASSERT_TRUE(back) << name;
    ASSERT_EQ(back->vertices.size(), mesh.vertices.size()) << name;
    ASSERT_EQ(back->triangles.size(), mesh.triangles.size()) << name;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])],
                   b = back->vertices[static_cast<std::size_t>(back->triangles[t][k])];
        EXPECT_LT((a - b).norm(), std::string(name) == "a.stl" ? 4e-9 : 1e-15) << name;  // STL is float32
      }
  }
}

TEST(MeshWriter, KnowsItsOwnFilesAgain) {
  const test::TemporaryFolder folder;
  Mesh mesh{{{0.001, 0, 0}, {0.003, 0, 0}, {0.001, 0.002, 0}}, {{0, 1, 2}}};
  for (const double away : {0.0, 1000.0})
    for (const char* name : {"a.stl", "a.ply", "a.obj", "A.STL"}) {
      for (Vec3& v : mesh.vertices) v.x() += away;
      ASSERT_EQ(write_mesh(mesh, folder / name, 1e-3, "genu mesh: x"), "");
      EXPECT_TRUE(has_title(folder / name, "genu mesh: ")) << name;
      EXPECT_FALSE(has_title(folder / name, "genu mesh-check")) << name;
    }
  EXPECT_FALSE(has_title(folder.write("b.stl", "solid measured\n genu mesh: \nendsolid\n"), "genu mesh: "));
  EXPECT_FALSE(has_title(folder / "none.stl", "genu mesh: "));
}

TEST(MeshWriter, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"a.off", "scene.toml", "a", ""})
    EXPECT_NE(why_not_writable(folder / name), "") << name;
  EXPECT_EQ(why_not_writable(folder / "a.stl"), "");
  EXPECT_EQ(why_not_writable(folder.write("old.PLY", "old")), "");
  std::filesystem::create_symlink(folder / "old.PLY", folder / "link.ply");
  std::filesystem::create_directory(folder / "folder.obj");
  EXPECT_NE(why_not_writable(folder / "link.ply"), "");
  EXPECT_NE(why_not_writable(folder / "folder.obj"), "");
  EXPECT_NE(write_mesh({}, folder / "link.ply", 1, ""), "");
  EXPECT_NE(write_mesh({}, folder / "a.off", 1, ""), "");
  EXPECT_NE(write_ply({}, folder / "none/a.ply", 1, ""), "");
  EXPECT_NE(write_obj({}, folder / "none/a.obj", 1, ""), "");
}

}  // namespace
}  // namespace genu
