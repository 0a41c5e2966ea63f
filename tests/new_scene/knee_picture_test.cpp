// The picture of a new knee: what it names, how large it is, and what it does not replace.
#include "genu/new_scene/knee_picture.h"

#include <filesystem>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "genu/new_scene/new_picture.h"
#include "genu/new_scene/new_scene.h"
#include "genu/new_scene/new_scene_text.h"
#include "genu/scene/reader.h"
#include "support/drawn_knee.h"
#include "support/leskovar.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;
using test::kLeskovar;
using test::read_file;
using test::TemporaryFolder;

/// A cube of 60 mm as femur over one as tibia.
Mesh cube(double bottom) {
  Mesh out;
  for (int i = 0; i < 8; ++i)
    out.vertices.emplace_back(i & 1 ? 0.03 : -0.03, bottom + (i & 2 ? 0.06 : 0), i & 4 ? 0.03 : -0.03);
  for (const auto& [a, b, c, d] : {std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3}, std::array{0, 2, 3, 1},
                                   std::array{4, 5, 7, 6}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    out.triangles.push_back({a, b, c});
    out.triangles.push_back({a, c, d});
  }
  return out;
}

KneePicture cubes(const Mesh& femur, const Mesh& tibia, double side) {
  KneePicture knee{{&femur}, {&tibia}, {1, 0, 0}, {0, 1, 0}, {0, 0, side}, {0, 0, 0},
                   0.08,     {},       {},        "<cubes>", {"a note"}};
  for (const double x : {-0.002, 0.002})
    knee.fibres.push_back({"front", {{0.03, 0.02, x}, 2e-3, false}, {{0.03, -0.02, x}, 3e-3, true}});
  knee.fibres.push_back({"inside", {{0, 0.03, 0}, 2e-3, false}, {{0, -0.03, 0}, 0, false}});
  knee.places = {{"mark", {0.03, 0.01, 0.01}}};
  return knee;
}

/// The part of an SVG from the heading of one view to that of the next.
std::string view_in(const std::string& svg, const std::string& name) {
  const std::size_t begin = svg.find("class=\"h\">" + name + "</text>");
  EXPECT_NE(begin, std::string::npos) << name;
  return svg.substr(begin, svg.find("class=\"h\"", begin + 1) - begin);
}

TEST(KneePicture, NamesWhatIsSeenAndNotWhatIsBehind) {
  const Mesh femur = cube(0.001), tibia = cube(-0.061);
  const std::string svg = knee_picture(cubes(femur, tibia, 1));
  EXPECT_TRUE(contains(svg, "&lt;cubes&gt;"));
  EXPECT_TRUE(contains(svg, "a note"));
  EXPECT_EQ(svg, knee_picture(cubes(femur, tibia, 1)));
  EXPECT_TRUE(contains(svg, kKneePictureMark));
  const std::string front = view_in(svg, "anterior"), back = view_in(svg, "posterior");
  EXPECT_TRUE(contains(front,
                       "front \xc2\xb1"
                       "2.0"));
  EXPECT_TRUE(contains(front,
                       "front \xc2\xb1"
                       "3.0"));
  EXPECT_TRUE(contains(front, "class=\"c g\""));  // a landmark says where
  EXPECT_TRUE(contains(front, ">mark<"));
  EXPECT_FALSE(contains(front, "inside"));  // a ring without a name
  EXPECT_TRUE(contains(front, "class=\"b\""));
  EXPECT_FALSE(contains(back, "front"));
  EXPECT_FALSE(contains(back, "class=\"d\""));
  EXPECT_FALSE(contains(back, ">mark<"));
  EXPECT_FALSE(contains(view_in(svg, "femur from below"),
                        "\xc2\xb1"
                        "3.0"));
}

/// Lateral is on the left of a right knee that is seen from the front, and on the right of a left one.
TEST(KneePicture, KnowsItsSides) {
  const Mesh femur = cube(0.001), tibia = cube(-0.061);
  for (const double side : {1.0, -1.0}) {
    const std::string svg = knee_picture(cubes(femur, tibia, side));
    for (const auto& [view, first] : {std::pair("anterior", side > 0 ? "lateral" : "medial"),
                                      std::pair("posterior", side > 0 ? "medial" : "lateral"),
                                      std::pair("femur from below", side > 0 ? "lateral" : "medial"),
                                      std::pair("medial", side > 0 ? "anterior" : "posterior"),
                                      std::pair("lateral", side > 0 ? "posterior" : "anterior"),
                                      std::pair("tibia from above", side > 0 ? "medial" : "lateral")}) {
      const std::string panel = view_in(svg, view);
      EXPECT_EQ(panel.substr(panel.find("class=\"s\">") + 10, std::string(first).size()), first) << view << side;
    }
  }
}

NewScene asked_drawn(const std::string& folder, const std::string& picture) {
  NewScene asked = test::drawn_knee_in(folder);
  asked.picture = picture;
  return asked;
}

TEST(KneePicture, OfANewScene) {
  const TemporaryFolder folder;
  Diagnostics out;
  const auto report = write_new_scene(asked_drawn(folder / "knee", folder / "knee/knee.svg"), out);
  ASSERT_TRUE(report && out.items().empty()) << test::messages(out);
  const std::string svg = read_file(folder / "knee/knee.svg");
  EXPECT_LT(svg.size(), 1000000u);
  for (const char* bundle : {"ACLam", "ACLpl", "PCLal", "PCLpm", "MCLs", "MCLd", "MCLp", "LCL", "PFL", "pCAP"})
    EXPECT_TRUE(contains(svg, std::string(">") + bundle + " \xc2\xb1")) << bundle;  // each is named with its error
}

/// Where the reference knee does not fit, the ligaments that are taken are drawn, without errors, and with the doubt.
TEST(KneePicture, IsDrawnInDoubt) {
  Diagnostics out;
  const auto scene = parse_scene(analytic_scene_text(), "five.toml", out);
  const auto bones = read_new_bones(asked_drawn("", ""), out);
  ASSERT_TRUE(scene && bones) << test::messages(out);
  const std::string doubt = "the reference knee does not fit on these bones";
  const std::string svg =
      picture_of({*bones, *lay_out_knee(bones->femur.mesh, bones->tibia.mesh), false, {}, "unused", doubt}, *scene);
  EXPECT_TRUE(contains(svg, ">DOUBTED: " + doubt + "<"));
  EXPECT_TRUE(contains(svg, ">MCL_anterior<"));
  EXPECT_FALSE(contains(svg, "\xc2\xb1"));
}

TEST(KneePicture, ReplacesNothingElse) {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine.svg") << "<svg>my own</svg>";
  const auto refused = [&](const NewScene& asked, const std::string& said) {
    Diagnostics out;
    EXPECT_FALSE(write_new_scene(asked, out));
    ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
    EXPECT_TRUE(contains(to_string(out.items().front()), said)) << to_string(out.items().front());
    EXPECT_FALSE(std::filesystem::exists(folder / "knee"));
  };
  refused(asked_drawn(folder / "knee", folder / "mine.svg"), "was not written by this command");
  refused(asked_drawn(folder / "knee", folder / "none/a.svg"), "no such folder");
  refused(asked_drawn(folder / "knee", folder / "a.png"), "--picture = ");
  NewScene analytic{.folder = folder / "knee"};
  analytic.picture = folder / "a.svg";
  refused(analytic, "--picture: belongs to a scene of meshes");
  EXPECT_EQ(read_file(folder / "mine.svg"), "<svg>my own</svg>");
}

}  // namespace
}  // namespace genu
