#include "genu/assemble/piece_notes.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include "genu/assemble/prepare.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/surface/analytic.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

/// A surface of two files.
std::string scene_of_halves() {
  return "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.ground]\nfixed = true\n[body.bone]\n"
         "[joint.j]\ntype = \"free\"\nparent = \"ground\"\nchild = \"bone\"\nrotations = [\"a x\", \"b y\", \"c z\"]\n"
         "translations = [\"x\", \"y\", \"z\"]\n[surface.lump]\nbody = \"bone\"\nshape = \"mesh\"\n"
         "file = [\"upper.stl\",\n        \"lower.stl\"]\nunits = \"mm\"\n[[step]]\nincrements = 1\n";
}

/// Those triangles of a lump whose middle is above z = 0, and the others, moved by `shift`.
void write_halves(const test::TemporaryFolder& folder, const Vec3& shift) {
  const Mesh lump = make_ellipsoid({}, {0.02, 0.014, 0.01}, false)->triangles(1.5e-3, Vec3::Zero(), 0.1);
  for (const bool upper : {true, false}) {
    Mesh half;
    half.vertices = lump.vertices;
    for (const auto& t : lump.triangles) {
      double z = 0;
      for (const int v : t) z += lump.vertices[at(v)].z();
      if ((z > 0) == upper) half.triangles.push_back(t);
    }
    if (!upper)
      for (Vec3& v : half.vertices) v += shift;
    EXPECT_EQ(write_stl(half, folder / (upper ? "upper.stl" : "lower.stl"), 1e-3, "half"), "");
  }
}

std::vector<std::string> warnings_of(const test::TemporaryFolder& folder, std::string& note) {
  Diagnostics out;
  const auto p = prepare(folder.write("scene.toml", scene_of_halves()), out);
  EXPECT_TRUE(p.has_value()) << test::messages(out);
  if (p) note = p->notes[0].text;
  std::vector<std::string> told;
  for (const Diagnostic& d : out.items()) told.push_back(to_string(d));
  return told;
}

TEST(PieceNotes, AJoinedBorderIsNotedAndLeavesNoHole) {
  const test::TemporaryFolder folder;
  write_halves(folder, Vec3::Zero());
  std::string note;
  EXPECT_TRUE(warnings_of(folder, note).empty());
  EXPECT_NE(note.find("2 files, "), std::string::npos) << note;
  EXPECT_NE(note.find("lower.stl joined along "), std::string::npos) << note;
}

TEST(PieceNotes, OverlapAndSlitsAreWarnedOf) {
  const test::TemporaryFolder folder;
  std::string note;
  write_halves(folder, Vec3(0.8e-3, 0.5e-3, 0.6e-3));
  std::string told = fmt::format("{}", fmt::join(warnings_of(folder, note), "\n"));
  EXPECT_NE(told.find("overlaps " + (folder / "upper.stl") + " near ("), std::string::npos) << told;
  write_halves(folder, Vec3(0, 0, -0.2e-3));
  told = fmt::format("{}", fmt::join(warnings_of(folder, note), "\n"));
  EXPECT_NE(told.find("comes within "), std::string::npos) << told;
  EXPECT_NE(told.find(" mm of " + (folder / "upper.stl") + " near ("), std::string::npos) << told;
  EXPECT_NE(note.find("2 files of pieces that share no vertex"), std::string::npos) << note;
}

TEST(PieceNotes, AnErrorStandsAtTheFileThatHasIt) {
  const test::TemporaryFolder folder;
  write_halves(folder, Vec3::Zero());
  folder.write("lower.stl", "solid cut short");
  Diagnostics out;
  EXPECT_FALSE(prepare(folder.write("scene.toml", scene_of_halves()), out));
  ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
  EXPECT_EQ(out.items()[0].line, 16);
  EXPECT_EQ(out.items()[0].column, 9);
  EXPECT_EQ(out.items()[0].key, "surface.lump.file");
  EXPECT_EQ(out.items()[0].found, '"' + (folder / "lower.stl") + '"');
}

}  // namespace
}  // namespace genu
