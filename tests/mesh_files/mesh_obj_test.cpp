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
  MeshNotes notes;
  return read_obj(text, mesh, notes);
}

Mesh good_obj(const std::string& text) {
  Mesh mesh;
  MeshNotes notes;
  EXPECT_EQ(read_obj(text, mesh, notes), "");
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

/// The notes of a text that is read.
std::vector<std::string> notes_of(const std::string& text) {
  Mesh mesh;
  MeshNotes notes;
  EXPECT_EQ(read_obj(text, mesh, notes), "") << text;
  return notes.texts();
}

TEST(MeshObj, AByteOrderMarkLosesNoVertex) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n";
  EXPECT_EQ(good_obj("\xef\xbb\xbf" + text).vertices, good_obj(text).vertices);
  EXPECT_TRUE(notes_of("\xef\xbb\xbf" + text).empty());
}

TEST(MeshObj, WhatDiffersFromTheFormatIsNoted) {
  EXPECT_TRUE(notes_of(kObj).empty());
  const auto says = [](const std::string& text, const std::string& note) {
    ASSERT_EQ(notes_of(text).size(), 1u) << text;
    EXPECT_EQ(notes_of(text)[0], note);
  };
  says(with_first(kObj, "v 1 0 0 1", "v 1,5 0,5 0"),
       "has decimal commas in line 3 and 1 others: read as decimal points");
  says(with_first(kObj, "usemtl x", "V 1 0 0\nvertex 1 0 0"),
       "has a line that begins with \"V\" in line 6 and 1 others: lines that OBJ does not know are left out");
  says(kObj.substr(0, kObj.size() - 1),
       "has no line end after its last number: if the file was cut there, that number is wrong");
  EXPECT_EQ(good_obj(with_first(kObj, "0.5 0.5 1", "nan 0.5 red")).vertices.size(), 3u) << "colours are not parsed";
}

TEST(MeshObj, ConcaveFacesAreCutFromTheReflexCornerEvenIfVerticesFollow) {
  const Mesh mesh = good_obj("f 2 3 4 1\nv 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const auto& t : mesh.triangles) EXPECT_TRUE(t[0] == 2 || t[1] == 2 || t[2] == 2);
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
