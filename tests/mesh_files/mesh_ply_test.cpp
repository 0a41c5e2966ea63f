// PLY in all its encodings, and the place of what is wrong with it.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_formats.h"
#include "support/text.h"

namespace genu {
namespace {

using test::with_first;

const std::string kHead =
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kAscii =
    "ply\nformat ascii 1.0\ncomment by hand\n" + kHead + "0 0 0 1\n0.1 0 0 2\n1 1 0 3\n0 1 0 4\n3 0 1 2\n4 0 1 2 3\n";

template <class T>
void append(std::string& bytes, T value, bool big) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

std::string binary(bool big) {
  std::string out = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kHead;
  for (const Vec3& v : {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) {
    for (int k = 0; k < 3; ++k) append(out, v[k], big);
    append(out, std::uint8_t{7}, big);
  }
  for (const std::vector<int>& face : {std::vector{0, 1, 2}, std::vector{0, 1, 2, 3}}) {
    append(out, static_cast<std::uint8_t>(face.size()), big);
    for (const std::int32_t v : face) append(out, v, big);
  }
  return out;
}

std::string read_ply_text(const std::string& text, Mesh& mesh) {
  MeshNotes notes;
  return read_ply(text, mesh, notes);
}

TEST(MeshPly, EveryEncodingGivesTheSameDoubles) {
  std::string crlf;
  for (const char c : kAscii) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text : {kAscii, crlf, binary(false), binary(true)}) {
    Mesh mesh;
    ASSERT_EQ(read_ply_text(text, mesh), "");
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.vertices[1].x(), 0.1) << "not rounded to float32";
    const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(mesh.triangles, triangles);
  }
}

TEST(MeshPly, StripsTurnEveryOtherTriangle) {
  Mesh mesh;
  ASSERT_EQ(read_ply_text(with_first(with_first(kAscii, "element face 2", "element tristrips 1"),
                                     "3 0 1 2\n4 0 1 2 3\n", "8 0 1 2 3 -1 0 1 3\n"),
                          mesh),
            "");
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {1, 3, 2}, {0, 1, 3}};
  EXPECT_EQ(mesh.triangles, triangles);
}

TEST(MeshPly, WhatDiffersFromTheFormatIsNoted) {
  const auto says = [](const std::string& text, const std::string& note) {
    Mesh mesh;
    MeshNotes notes;
    EXPECT_EQ(read_ply(text, mesh, notes), "");
    const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(mesh.triangles, triangles);
    ASSERT_EQ(notes.texts().size(), 1u) << text;
    EXPECT_EQ(notes.texts()[0], note);
  };
  says(with_first(kAscii, "3 0 1 2\n4 0 1 2 3\n", "3 0 1 2 255 0 0\n4 0 1 2 3 255 0 0\n"),
       "has more numbers than its header declares in line 16 and 1 others: what follows those is left out");
  says(with_first(kAscii, "1 1 0 3", "1 1 0 3 4 5"),
       "has more numbers than its header declares in line 14: what follows those is left out");
  says(kAscii + "3 0 1 2\n",
       "has \"3\" after all that its header promises in line 18: it and what follows are left out");
  says(binary(false) + "more", "has 4 bytes after all that its header promises: they are left out");
  says(kAscii.substr(0, kAscii.size() - 1),
       "has no line end after its last number: if the file was cut there, that number is wrong");
  says(with_first(kAscii, "1 1 0 3", "1,0 1,0 0,0 3"),
       "has decimal commas in line 14 and 2 others: read as decimal points");
}

TEST(MeshPly, ConcaveFacesAreCutFromTheReflexCorner) {
  Mesh mesh;
  ASSERT_EQ(read_ply_text(with_first(with_first(kAscii, "1 1 0 3", "0.05 0.05 0 3"), "4 0 1 2 3", "4 1 2 3 0"), mesh),
            "");
  for (std::size_t k : {1, 2}) {
    const auto& t = mesh.triangles[k];
    EXPECT_TRUE(t[0] == 2 || t[1] == 2 || t[2] == 2);
  }
}

TEST(MeshPly, NamesThePlaceOfWhatIsWrong) {
  const auto says = [](const std::string& text, const std::string& part) {
    Mesh mesh;
    const std::string problem = read_ply_text(text, mesh);
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  };
  says(with_first(kAscii, "property double z\n", ""), "without the property \"z\"");
  says(with_first(kAscii, "vertex_indices", "colours"), "without a list \"vertex_indices\"");
  says(with_first(kAscii, "element vertex 4", "element vertex -4"), "has \"-4\" in line 4 where a count");
  says(with_first(kAscii, "element vertex 4", "element vertex 18446744073709551621"), "in line 4 where a count");
  says(with_first(kAscii, "ascii", "middle"), "has \"middle\" in line 2");
  says(with_first(kAscii, "uchar int", "float int"), "in line 10");
  says(with_first(kAscii, "0.1 0 0 2", "0.1 O 0 2"), "has \"O\" in line 13");
  says(with_first(kAscii, "0.1 0 0 2", "0.1 0 0"), "too few numbers in line 13");
  says(with_first(kAscii, "0.1 0 0 2", "1e300 0 0 2"), "coordinate (finite, at most 1e9) in line 13");
  says(with_first(kAscii, "3 0 1 2\n", "3 0 1 4\n"), "does not have in line 16");
  says(with_first(kAscii, "3 0 1 2\n", "3 0 1 -1\n"), "does not have in line 16");
  says(with_first(kAscii, "3 0 1 2\n", "3 0 1 1.5\n"), "does not have in line 16");
  says(with_first(kAscii, "3 0 1 2\n", "2 0 1\n"), "fewer than three corners in line 16");
  says(with_first(kAscii, "3 0 1 2\n", "-3 0 1 2\n"), "fewer than no entries in line 16");
  // A list that promises two thousand million entries asks for no memory.
  says(with_first(with_first(kAscii, "uchar red", "list int int red"), "0 0 0 1\n", "0 0 0 2000000000 1\n"),
       "too few numbers in line 12");
  const std::string bytes = binary(true);
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    Mesh mesh;
    EXPECT_NE(read_ply_text(bytes.substr(0, size), mesh), "") << size;
  }
}

}  // namespace
}  // namespace genu
