#include "genu/mesh_files/ply_header.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(PlyHeader, SaysWhatFollowsAndWhere) {
  const std::string text =
      "ply\r\nformat binary_big_endian 1.0\r\nobj_info x\r\nelement vertex 7\r\nproperty float32 x\r\n"
      "property list ushort uint8 tags\r\nend_header\r\nDATA";
  PlyHeader header;
  ASSERT_EQ(read_ply_header(text, header), "");
  EXPECT_TRUE(header.big_endian && !header.ascii);
  EXPECT_EQ(text.substr(header.size), "DATA");
  EXPECT_EQ(header.lines, 7u);
  ASSERT_EQ(header.elements.size(), 1u);
  EXPECT_EQ(header.elements[0].count, 7u);
  EXPECT_EQ(header.elements[0].index("tags"), 1);
  EXPECT_EQ(header.elements[0].index("y"), -1);
  EXPECT_TRUE(header.elements[0].properties[1].list);
  EXPECT_EQ(size_of(header.elements[0].properties[1].count_type), 2u);
  EXPECT_EQ(size_of(PlyType::float64) + size_of(PlyType::int8) + size_of(PlyType::float32), 13u);
}

TEST(PlyHeader, SaysWhatIsMissing) {
  PlyHeader header;
  EXPECT_NE(read_ply_header("plx\n", header).find("does not start with \"ply\""), std::string::npos);
  EXPECT_NE(read_ply_header("ply\nend_header\n", header).find("without \"format\""), std::string::npos);
  EXPECT_NE(read_ply_header("ply\nformat ascii 1.0\nproperty float x\n", header).find("line 3"), std::string::npos);
  EXPECT_NE(read_ply_header("ply\nformat ascii 1.0\n", header).find("end_header"), std::string::npos);
}

}  // namespace
}  // namespace genu
