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

std::string read_stl_text(const std::string& text, Mesh& mesh) {
  MeshNotes notes;
  return read_stl(text, mesh, notes);
}

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

/// The notes of a text that is read, its triangles counted.
std::vector<std::string> notes_of(const std::string& text, std::size_t triangles) {
  Mesh mesh;
  MeshNotes notes;
  EXPECT_EQ(read_stl(text, mesh, notes), "") << text;
  EXPECT_EQ(mesh.triangles.size(), triangles) << text;
  return notes.texts();
}

std::string with_all(std::string text, const std::string& piece, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; at += by.size())
    text.replace(at, piece.size(), by);
  return text;
}

TEST(MeshStl, WhatIsNotNeededIsNotParsed) {
  const std::string whole = "solid a\n" + kFacet + kFacet + "endsolid a\n";
  for (const char* end : {"loop", "facet", "solid"})
    EXPECT_TRUE(notes_of(with_all(whole, std::string("end") + end, std::string("END ") + end), 2).empty());
  for (const char* normal : {"normal -1.#IND00e+000 1.#QNAN 0", "normal -nan(ind) nan nan", "normal 0 0",
                             "normal 0,5 0,5 0", "", "normal 0 0 1 1"})
    EXPECT_TRUE(notes_of(with_all(whole, "normal 0 0 1", normal), 2).empty()) << normal;
  EXPECT_TRUE(notes_of("solid a\nsolid b\n" + kFacet + "endsolid a\nendsolid b\n", 1).empty());
  EXPECT_TRUE(notes_of(with_all(whole + whole, "endsolid", "end solid"), 4).empty());
  EXPECT_TRUE(notes_of("\xef\xbb\xbf" + whole, 2).empty());
}

TEST(MeshStl, CommasAndWhatFollowsTheLastSolidAreNoted) {
  Mesh mesh;
  MeshNotes notes;
  const std::string commas = "solid\n" + with_all(with_all(kFacet, "1 0 0", "1,25 0,0 -3,5e-1"), "0 0 1", "0.5 0 1");
  ASSERT_EQ(read_stl(commas + "endsolid\n", mesh, notes), "");
  EXPECT_EQ(mesh.vertices[1], Vec3(1.25, 0, -0.35));
  ASSERT_EQ(notes.texts().size(), 1u);
  EXPECT_EQ(notes.texts()[0], "has decimal commas in line 5 and 2 others: read as decimal points");
  EXPECT_EQ(notes.problem(), "") << "a normal is not read";
  const auto after = notes_of("solid\n" + kFacet + "endsolid\n\nmade by hand\n", 1);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0], "has \"made\" after its last \"endsolid\" in line 11: it is left out");
}

TEST(MeshStl, ABinaryFileMayBeginWithSolid) {
  std::string bytes = "solid of a vertex, a facet and an endsolid";
  bytes.resize(80, ' ');
  bytes += std::string("\2\0\0\0", 4) + std::string(100, '\0');
  EXPECT_TRUE(notes_of(bytes, 2).empty());
  EXPECT_EQ(notes_of(bytes + "xy", 2).size(), 1u) << "neither does its size fit";
}

TEST(MeshStl, GarbageIsNamedWithItsLine) {
  const std::pair<std::string, std::string> bad[] = {
      {"0 1 0\n endloop", "0 x 0\n endloop"},    {"0 1 0\n endloop", "0 1\n endloop"},
      {"0 1 0\n endloop", "0 1 0 0\n endloop"},  {"vertex 0 1 0", "vertx 0 1 0"},
      {"endfacet", "endfacet rubbish"},          {"vertex 0 1 0", "vertex 0 1.5.2 0"},
      {"vertex 0 1 0", "vertex 0 1e400 0"},      {"vertex 1 0 0\n", ""},
      {"vertex 0 1 0", "vertex 0 1e30 0"},       {"endloop", "vertex 1 1 0\nendloop"},
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
