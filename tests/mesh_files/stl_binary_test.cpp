// Binary STL whose size and header do not agree: what tells that all triangles are there, and what does not.
#include "genu/mesh_files/stl_binary.h"

#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "support/text.h"

namespace genu {
namespace {

using test::contains;

std::string number(std::uint32_t n) {
  std::string out(4, '\0');
  std::memcpy(out.data(), &n, 4);
  return out;
}

/// Triangle k of a strip, with `attribute` bytes of payload.
std::string record(int k, std::size_t attribute = 0) {
  const auto x = static_cast<float>(k);
  const float values[12] = {0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0};
  std::string out(48, '\0');
  std::memcpy(out.data(), values, 48);
  return out + static_cast<char>(attribute) + '\0' + std::string(attribute, 'p');
}

std::string strip(std::uint32_t promised, int triangles, std::size_t attribute = 0) {
  std::string out = std::string(80, ' ') + number(promised);
  for (int k = 0; k < triangles; ++k) out += record(k, attribute);
  return out;
}

/// The only note of what is read; empty where there is none.
std::string note(const std::string& bytes, std::size_t triangles) {
  Mesh mesh;
  MeshNotes notes;
  EXPECT_EQ(read_binary_stl(bytes, mesh, notes), "");
  EXPECT_EQ(mesh.triangles.size(), triangles);
  EXPECT_EQ(mesh.vertices.size(), 3 * triangles);
  EXPECT_LE(notes.texts().size(), 1u);
  EXPECT_EQ(mesh.vertices[3 * (triangles - 1) + 2].y(), 1) << "the last triangle is one";
  return notes.texts().empty() ? "" : notes.texts()[0];
}

std::string binary_problem(const std::string& bytes) {
  Mesh mesh;
  MeshNotes notes;
  return read_binary_stl(bytes, mesh, notes);
}

TEST(StlBinary, ASizeThatFitsIsRead) {
  EXPECT_EQ(note(strip(3, 3), 3), "");
  EXPECT_TRUE(fits_binary_stl(strip(3, 3)));
  EXPECT_FALSE(fits_binary_stl(strip(3, 3) + "x"));
  EXPECT_FALSE(fits_binary_stl("solid"));
}

TEST(StlBinary, TheSizeTellsACountThatIsNotFilledIn) {
  EXPECT_EQ(note(strip(0, 3), 3), "has 0 as its count of triangles: its size tells that there are 3, which are read");
  EXPECT_TRUE(contains(note(strip(0xffffffff, 3), 3), "has 4294967295 as its count"));
  EXPECT_TRUE(contains(binary_problem(strip(0, 3).substr(0, 84 + 130)), "is a binary STL of 0 triangles"));
  EXPECT_TRUE(contains(binary_problem(strip(0xffffffff, 3).substr(0, 84 + 130)), "truncated"));
}

TEST(StlBinary, BytesAfterTheLastTriangleAreLeftOut) {
  for (const std::size_t more : {1, 2, 49, 50, 77, 100})
    EXPECT_EQ(note(strip(3, 3) + std::string(more, '\0'), 3),
              "has " + std::to_string(more) + " bytes after its last triangle: they are left out");
  EXPECT_TRUE(contains(binary_problem(strip(3, 3) + std::string(151, '\0')), "damaged or no STL at all"));
}

TEST(StlBinary, TrianglesAfterThePromisedOnesAreRead) {
  EXPECT_EQ(note(strip(3, 5), 5), "has 3 triangles by its header and 5 by its size: the size is believed");
  EXPECT_TRUE(contains(note(strip(3, 3) + record(1000), 3), "50 bytes after")) << "far from the others: no triangle";
}

TEST(StlBinary, AttributesSayHowManyBytesFollow) {
  EXPECT_EQ(note(strip(3, 3, 4), 3), "");
  EXPECT_EQ(note(strip(2, 1, 60) + record(1, 3), 2), "");
  const std::string whole = strip(3, 3, 4);
  for (const std::size_t cut : {1, 5, 60}) EXPECT_NE(binary_problem(whole.substr(0, 84 + 150 - cut)), "");
}

TEST(StlBinary, SeveralFilesInOneAreOneSurface) {
  EXPECT_EQ(note(strip(3, 3) + strip(2, 2) + strip(5, 5), 10),
            "has 3 binary STL files one after the other: read as one surface");
}

TEST(StlBinary, EveryTruncationIsRefused) {
  const std::string whole = strip(3, 3);
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(binary_problem(whole.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace genu
