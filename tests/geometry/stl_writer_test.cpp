#include "genu/geometry/stl_writer.h"

#include <cstring>

#include <gtest/gtest.h>

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

TEST(StlWriter, AFailureIsSaidAndLeavesTheOldFile) {
  test::TemporaryFolder folder;
  EXPECT_NE(write_stl(kTriangle, folder / "no/such/a.stl", 1, "").find("cannot be opened"), std::string::npos);
  std::filesystem::create_directory(folder / "taken.stl");
  EXPECT_NE(write_stl(kTriangle, folder / "taken.stl", 1, "").find("cannot be replaced"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "taken.stl.part"));

  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full to play a full disk";
  const std::string old = folder.write("full.stl", "old");
  std::filesystem::create_symlink("/dev/full", folder / "full.stl.part");
  EXPECT_NE(write_stl(kTriangle, old, 1, "").find("disk full"), std::string::npos);
  EXPECT_EQ(test::read_file(old), "old");
}

}  // namespace
}  // namespace genu
