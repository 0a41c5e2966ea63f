#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_formats.h"

namespace genu {
namespace {

std::string read_off_text(const std::string& text, Mesh& mesh) {
  MeshNotes notes;
  return read_off(text, mesh, notes);
}

const std::string kSquare = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST(MeshOff, ReadsCommentsColoursNormalsAndPolygons) {
  const std::string texts[] = {"OFF\n" + kSquare, "OFF # a square\n# of four corners\n" + kSquare,
                               "COFF\n3 1 3\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2 255 0 0\n",
                               "NOFF 3 1 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 3 0 1 2"};
  const std::size_t triangles[] = {2, 2, 1, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    Mesh mesh;
    EXPECT_EQ(read_off_text(texts[k], mesh), "") << texts[k];
    EXPECT_EQ(mesh.triangles.size(), triangles[k]) << texts[k];
  }
  Mesh mesh;
  read_off_text(texts[0], mesh);
  EXPECT_EQ(mesh.triangles[0], (std::array{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (std::array{0, 2, 3}));
  EXPECT_EQ(mesh.vertices[2], Vec3(1, 1, 0));
}

/// The notes of a text that is read: a unit square.
std::vector<std::string> notes_of_square(const std::string& text) {
  Mesh mesh;
  MeshNotes notes;
  EXPECT_EQ(read_off(text, mesh, notes), "") << text;
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(mesh.vertices, corners) << text;
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(mesh.triangles, triangles) << text;
  return notes.texts();
}

/// The square with `more` behind the coordinates of each vertex.
std::string square_with(const std::string& keyword, const std::string& more) {
  return keyword + "\n4 1 0\n0 0 0 " + more + "\n1 0 0 " + more + "\n# half of it\n\n1 1 0 " + more + "\n0 1 0 " +
         more + "\n4 0 1 2 3 0.1 0.2 0.3\n";
}

TEST(MeshOff, PrefixesSayWhatStandsBesideTheCoordinates) {
  const std::pair<std::string, std::string> kinds[] = {{"STOFF", "0.5 0.5"},
                                                       {"COFF", "1 0 0 1"},
                                                       {"COFF", "255 0 0"},
                                                       {"NOFF", "0 0 1"},
                                                       {"CNOFF", "0 0 1 1 0 0 1"},
                                                       {"4OFF", "1"},
                                                       {"STCN4OFF", "1 0 0 1 1 0 0 1 0.5 0.5"},
                                                       {"NOFF", "nan nan nan"},
                                                       {"NOFF", "\n0 0 1"}};
  for (const auto& [keyword, more] : kinds) EXPECT_TRUE(notes_of_square(square_with(keyword, more)).empty()) << keyword;
  EXPECT_TRUE(notes_of_square("\xef\xbb\xbf" + square_with("OFF", "")).empty());
  EXPECT_TRUE(notes_of_square("STOFF 4 1 0 0 0 0 9 9 1 0 0 9 9 1 1 0 9 9 0 1 0 9 9 4 0 1 2 3\n").empty())
      << "in one line";
  Mesh mesh;
  EXPECT_EQ(read_off_text("4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n0 4 0 4\n3 0 1 2\n", mesh), "");
  EXPECT_EQ(mesh.vertices[1], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Vec3(0, 1, 0));
}

TEST(MeshOff, WhatDiffersFromTheFormatIsNoted) {
  const auto says = [](const std::string& text, const std::string& note) {
    const auto notes = notes_of_square(text);
    ASSERT_EQ(notes.size(), 1u) << text;
    EXPECT_NE(notes[0].find(note), std::string::npos) << notes[0];
  };
  says(square_with("OFF", "200 180 90 255"),
       "under the keyword OFF (colours are COFF, normals NOFF) in line 3 and 3 others");
  says("OFF\n" + kSquare + "more\n", "\"more\" after all that its header promises in line 8");
  says("OFF\n4 1 0\n0 0 0\n1,0 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "decimal commas in line 4");
  says("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3", "no line end");
  says("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n4 0 1 2 3\n", "fewer than three corners in line 7");
}

TEST(MeshOff, ConcaveFacesAreCutFromTheReflexCorner) {
  Mesh mesh;
  ASSERT_EQ(read_off_text("OFF\n4 1 0\n0 0 0\n2 -1 0\n0.5 0 0\n2 1 0\n4 1 2 3 0\n", mesh), "");
  for (const auto& t : mesh.triangles) EXPECT_TRUE(t[0] == 2 || t[1] == 2 || t[2] == 2);
}

TEST(MeshOff, SaysWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> bad[] = {{"OFX\n" + kSquare, "\"OFX\" in line 1"},
                                                     {"nOFF\n3\n" + kSquare, "no other prefixes than"},
                                                     {"4OFF\n3 1 0\n0 0 0 0\n1 0 0 1\n0 1 0 1\n3 0 1 2\n", "divided"},
                                                     {"OFF\n4 1\n0 0 0\n", "truncated"},
                                                     {"OFF\n4 1 0\n0 0 zero\n", "\"zero\" in line 3"},
                                                     {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6"},
                                                     {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "names a vertex"},
                                                     {"OFF BINARY\n", "binary OFF is not read"},
                                                     {"OFF\n99999999999 1 0\n", "a count from 0"},
                                                     {"OFF\n-4 1 0\n", "\"-4\" in line 2 where a count"},
                                                     {"", "truncated"}};
  for (const auto& [text, said] : bad) {
    Mesh mesh;
    EXPECT_NE(read_off_text(text, mesh).find(said), std::string::npos) << text << ": " << read_off_text(text, mesh);
  }
}

}  // namespace
}  // namespace genu
