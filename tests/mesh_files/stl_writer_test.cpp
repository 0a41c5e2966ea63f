#include "genu/mesh_files/stl_writer.h"

#include <cstring>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

const Mesh kTriangle{{{0.001, 0, 0}, {0.003, 0, 0}, {0.001, 0.002, 0}}, {{0, 1, 2}}};

float number(const std::string& bytes, std::size_t offset) {
  float x = 0;
  std::memcpy(&x, bytes.data() + offset, sizeof x);
  return x;
}

TEST(StlWriter, WritesTheBytesOfTheFormat) {
  test::TemporaryFolder folder;
  ASSERT_EQ(write_stl(kTriangle, folder / "a.stl", 1e-3, "solid as a rock"), "");
  const std::string bytes = test::read_file(folder / "a.stl");
  ASSERT_EQ(bytes.size(), 84u + 50u);
  EXPECT_EQ(bytes.compare(0, 22, "binary solid as a rock"), 0);
  EXPECT_EQ(bytes[80], 1);
  const float expected[12] = {0, 0, 1, 1, 0, 0, 3, 0, 0, 1, 2, 0};
  for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(number(bytes, 84 + 4 * k), expected[k]) << k;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.stl.part"));
}

TEST(StlWriter, AFailureIsSaidAndLeavesWhatIsThere) {
  test::TemporaryFolder folder;
  EXPECT_NE(write_stl(kTriangle, folder / "no/such/a.stl", 1, ""), "");
  std::filesystem::create_directory(folder / "taken.stl");
  EXPECT_NE(write_stl(kTriangle, folder / "taken.stl", 1, ""), "");
  const std::string mine = folder.write("a.stl.part", "mine"), target = folder.write("target.stl", "kept");
  std::filesystem::create_symlink(target, folder / "link.stl");
  EXPECT_NE(write_stl(kTriangle, folder / "link.stl", 1, ""), "");
  EXPECT_EQ(write_stl(kTriangle, folder / "a.stl", 1, ""), "");
  EXPECT_EQ(test::read_file(mine), "mine");
  EXPECT_EQ(test::read_file(target), "kept");
}

TEST(StlWriter, FarFromTheOriginIsWrittenInFull) {
  test::TemporaryFolder folder;
  Mesh far = kTriangle;
  for (Vec3& v : far.vertices) v += Vec3(1000.0000123, 1000, 0);  // 1e6 mm: float32 steps are 0.06 mm
  EXPECT_TRUE(fits_binary_stl(kTriangle, 1e-3));
  EXPECT_FALSE(fits_binary_stl(far, 1e-3));
  EXPECT_NEAR(binary_stl_rounding(far, 1e-3), 0, 5e-5);
  ASSERT_EQ(write_stl(far, folder / "far.stl", 1e-3, "two\nlines"), "");
  EXPECT_EQ(test::read_file(folder / "far.stl").compare(0, 16, "solid two lines\n"), 0);
  Diagnostics out;
  const auto back = read_mesh(folder / "far.stl", 1e-3, out);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->vertices.size(), 3u) << "not welded by the rounding of float32 either";
  for (std::size_t v = 0; v < 3; ++v) EXPECT_LT((back->vertices[v] - far.vertices[v]).norm(), 1e-12);
  Mesh fine = kTriangle;  // edges of 2 nm at 30 mm
  for (Vec3& v : fine.vertices) v = Vec3(0.0301234, 0, 0) + 1e-6 * v;
  EXPECT_FALSE(fits_binary_stl(fine, 1e-3));
}

}  // namespace
}  // namespace genu
