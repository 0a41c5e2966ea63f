// Landmarks on the drawn bones: what they place, what is doubted and what is refused.
#include "genu/new_scene/new_landmarks.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "genu/atlas/fitted_knee.h"
#include "genu/mesh/nearest_point.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/new_scene/fit_doubts.h"
#include "genu/new_scene/new_scene.h"
#include "genu/new_scene/tolerances.h"
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
using test::TemporaryFolder;

struct DrawnKnee {
  Mesh femur, tibia;
  KneeLayout layout;
  FittedKnee fitted;
};
const DrawnKnee& drawn() {
  static const DrawnKnee knee = [] {
    Diagnostics out;
    DrawnKnee k{read_mesh(kLeskovar + "femur.stl", 1e-3, out).value(),
                read_mesh(kLeskovar + "tibia.stl", 1e-3, out).value(),
                {},
                {}};
    k.layout = lay_out_knee(k.femur, k.tibia).value();
    k.fitted = fit_reference_knee(k.femur, k.tibia, axes_of(k.layout, false));
    return k;
  }();
  return knee;
}

std::string point_line(const std::string& name, const Vec3& at) {
  return name + "," + std::to_string(1e3 * at.x()) + "," + std::to_string(1e3 * at.y()) + "," +
         std::to_string(1e3 * at.z()) + "\n";
}
Vec3 acl(bool femur) { return middle_of(femur ? drawn().fitted.femur : drawn().fitted.tibia, {"ACLam", "ACLpl"}); }

/// Beside the epicondyles of the drawn femur, a right one: lateral is z.
Vec3 epicondyle(double side) {
  return nearest_on_mesh(drawn().femur, drawn().layout.centre + Vec3(0, 0.02, side * 0.1));
}

std::optional<KneeLandmarks> landmarks_in(const std::string& table, Diagnostics& out, const std::string& space = {},
                                          const std::string& name = "points.csv") {
  const TemporaryFolder folder;
  std::ofstream(folder / name) << table;
  return read_knee_landmarks({folder / name, 1e-3, 0, space}, drawn().femur, drawn().tibia, out);
}

KneeLandmarks good_landmarks(const std::string& table, const std::string& space = {},
                             const std::string& name = "points.csv") {
  Diagnostics out;
  const auto found = landmarks_in(table, out, space, name);
  EXPECT_TRUE(found && out.items().empty()) << test::messages(out);
  return found.value_or(KneeLandmarks{});
}

TEST(NewLandmarks, NameEndsAndPlaces) {
  const KneeLandmarks found =
      good_landmarks("name,x,y,z,error\nACL femur 1,1,2,3,1\nACL_femur_2,3,4,5,2\nLCL fibula,1,1,1,\nHJC,0,400,0,\n");
  ASSERT_EQ(found.ends.size(), 2u);
  EXPECT_EQ(found.ends[0].name, "ACL femur");
  EXPECT_TRUE(found.ends[0].at.isApprox(Vec3(2e-3, 3e-3, 4e-3)));  // the middle of both
  EXPECT_NEAR(found.ends[0].error, 1.5e-3, 1e-12);
  EXPECT_EQ(found.ends[1].error, kLandmarkError);
  ASSERT_TRUE(found.place("hip centre"));
  EXPECT_FALSE(found.place("knee centre"));
  EXPECT_FALSE(found.proximal());  // a hip alone points nowhere
}

TEST(NewLandmarks, ThatMeanNothingAreListed) {
  Diagnostics out;
  EXPECT_TRUE(landmarks_in("name,x,y,z\nF-1,0,0,0\nACL femur,0,0,0\nF-2,0,0,0\n", out));
  ASSERT_EQ(out.items().size(), 2u) << test::messages(out);
  EXPECT_TRUE(contains(to_string(out.items()[0]), "points.csv:2:1: warning: name = \"F-1\": is no landmark"));
  EXPECT_TRUE(contains(to_string(out.items()[0]), "Known are ACL, "));
  EXPECT_FALSE(contains(to_string(out.items()[1]), "Known are"));
  Diagnostics none;
  EXPECT_FALSE(landmarks_in("name,x,y,z\nF-1,0,0,0\nF-2,0,0,0\n", none));
  EXPECT_EQ(none.count(Diagnostic::Severity::error), 2u);
}

TEST(NewLandmarks, ThatContradictEachOtherAreRefused) {
  const std::pair<const char*, const char*> tables[] = {
      {"name,x,y,z\nACL femur,0,0,0\nACL femoral,1,1,1\n",
       "points.csv:3:1: name = \"ACL femoral\": means the same as \"ACL femur\""},
      {"name,x,y,z\nACLam femur,0,0,0\nACL femur,1,1,1\n", "places a bundle that \"ACLam femur\" places, too"},
      {"name,x,y,z\nleft ACL femur,0,0,0\nR ACL tibia,1,1,1\n",
       "is of a right knee, and names before it are of a left one"}};
  for (const auto& [table, said] : tables) {
    Diagnostics out;
    EXPECT_FALSE(landmarks_in(table, out)) << table;
    ASSERT_EQ(out.items().size(), 1u) << test::messages(out);
    EXPECT_TRUE(contains(to_string(out.items().front()), said)) << to_string(out.items().front());
  }
}

/// Of a femur and a tibia whose files say LPS, or say nothing.
TEST(NewLandmarks, ComeIntoTheFrameOfTheMeshes) {
  const auto fiducials = [&](const std::string& frame, double sign) {
    const Vec3 at = acl(true).cwiseProduct(Vec3(sign, sign, 1)), other = acl(false).cwiseProduct(Vec3(sign, sign, 1));
    return "# Markups fiducial file version = 4.11\n# CoordinateSystem = " + frame + "\n# columns = label,x,y,z\n" +
           point_line("ACL femur", at) + point_line("ACL tibia", other);
  };
  const auto check = [&](const KneeLandmarks& found, bool turned) {
    ASSERT_EQ(found.ends.size(), 2u);
    EXPECT_LT((found.ends[0].at - acl(true)).norm(), 1e-6);
    EXPECT_EQ(!found.turned.empty(), turned) << found.turned;
  };
  check(good_landmarks(fiducials("RAS", 1), "RAS", "p.fcsv"), false);
  check(good_landmarks(fiducials("RAS", -1), "LPS", "p.fcsv"), true);
  check(good_landmarks(fiducials("LPS", 1), "", "p.fcsv"), false);  // the meshes do not say: they are near as they are
  check(good_landmarks(fiducials("LPS", -1), "", "p.fcsv"), true);
}

TEST(NewLandmarks, FarOffAreDoubted) {
  const DrawnKnee& knee = drawn();
  const auto doubts = [&](const std::string& table) {
    Diagnostics out;
    doubt_landmarks(good_landmarks("name,x,y,z\n" + table), knee.femur, knee.tibia, knee.layout, false, out);
    return test::messages(out);
  };
  EXPECT_EQ(doubts(point_line("ACL femur", acl(true)) + point_line("ACL tibia", acl(false))), "");
  EXPECT_TRUE(contains(doubts(point_line("ACL femur", acl(true) + Vec3(0.2, 0, 0))), "mm off the femur, and"));
  const std::string exchanged = doubts(point_line("PCL femur", acl(true)) + point_line("PCL tibia", acl(false)));
  EXPECT_TRUE(contains(exchanged, "\"PCL femur\": lies ")) << exchanged;
  EXPECT_TRUE(contains(exchanged, "\"PCL tibia\": lies ")) << exchanged;
  EXPECT_TRUE(contains(doubts(point_line("medial epicondyle", Vec3(0.3, 0, 0))), "\"medial epicondyle\": lies"));
  EXPECT_TRUE(
      contains(doubts(point_line("MEC", epicondyle(-1)) + point_line("LEC", epicondyle(-1) + Vec3(0, 0.005, 0))),
               "is not beside the medial one"));
}

TEST(NewLandmarks, TellSideAndAxes) {
  const DrawnKnee& knee = drawn();
  const std::string line = point_line("MEC", epicondyle(-1)) + point_line("LEC", epicondyle(1));
  const KneeLandmarks right =
      good_landmarks("name,x,y,z\n" + line + "HJC,10,400,0\nKJC,1,2,3\nankle centre,0,-400,0\n");
  EXPECT_EQ(right.left_by_epicondyles(knee.layout), false);
  EXPECT_EQ(right.proximal(), Vec3(0, 1, 0));
  const KneeFrames files = frames_of_files(knee.layout);
  const auto words = clinical_words(right, knee.layout, files, false);
  EXPECT_EQ(words.at("femur_origin"), "[1, 2, 3]");
  EXPECT_EQ(words.at("tibia_origin"), "[1, 2, 3]");
  EXPECT_EQ(words.at("femur_proximal"), "[0.0226066, 0.9997160, -0.0075355]");
  EXPECT_EQ(words.at("tibia_proximal"), "[0.0024875, 0.9999691, 0.0074625]");
  EXPECT_EQ(words.at("tibia_anterior"), "\"x\"");
  EXPECT_EQ(words.at("femur_anterior").substr(0, 4), "[0.9");  // perpendicular to hip and epicondyles
  const KneeLandmarks left =
      good_landmarks("name,x,y,z\n" + point_line("LEC", epicondyle(-1)) + point_line("MEC", epicondyle(1)));
  EXPECT_EQ(left.left_by_epicondyles(knee.layout), true);
  EXPECT_EQ(clinical_words(left, knee.layout, files, true).at("femur_anterior").substr(0, 4), "[0.9");
  EXPECT_EQ(clinical_words({}, knee.layout, files, false).at("femur_proximal"), "\"y\"");
}

NewScene asked_with(const std::string& folder, const std::string& landmarks) {
  NewScene asked = test::drawn_knee_in(folder);
  asked.landmarks = landmarks;
  return asked;
}

TEST(NewLandmarks, PlaceTheEndsOfAScene) {
  const TemporaryFolder folder;
  const Vec3 at = nearest_on_mesh(drawn().femur, acl(true) + Vec3(0.002, 0.002, 0));
  std::ofstream(folder / "points.csv") << "name,x,y,z,error\n"
                                       << test::with_first(point_line("R ACL femur", at), "\n", ",1.5\n")
                                       << point_line("MEC", epicondyle(-1)) << point_line("LEC", epicondyle(1));
  Diagnostics out;
  const auto report = write_new_scene(asked_with(folder / "knee", folder / "points.csv"), out);
  ASSERT_TRUE(report && out.items().empty()) << test::messages(out);
  EXPECT_EQ(report->poses_solved, 130);
  const std::string text = test::read_file(report->file);
  EXPECT_TRUE(contains(text, "# +- 1.5 mm, by your landmark ACL femur"));
  std::string said;
  for (const std::string& line : report->choices) said += line + "\n";
  EXPECT_TRUE(contains(said, "points.csv: ACL femur (known to 1.5 mm), lateral epicondyle, medial epicondyle")) << said;
  EXPECT_TRUE(contains(said, "right (by the names of the landmarks)")) << said;
  Diagnostics ignored;
  const auto scene = read_scene(report->file, ignored);
  ASSERT_TRUE(scene);
  Vec3 middle = Vec3::Zero();
  int count = 0;
  for (const auto& ligament : scene->ligaments)
    if (ligament.name.starts_with("ACL")) {
      middle += ligament.from.point;
      ++count;
    }
  EXPECT_EQ(count, 12);
  EXPECT_LT((middle / count - at).norm(), 2e-3);  // each is put onto the bone
}

TEST(NewLandmarks, ThatAreRefusedLeaveNothingBehind) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.csv") << "name,x,y,z\nACL femur,1,2,z\nACL tibia,1,2\n";
  std::ofstream(folder / "left.csv") << "name,x,y,z\nleft ACL femur,1,2,3\n";
  const auto refused = [&](const NewScene& asked, const std::vector<std::string>& said) {
    Diagnostics out;
    EXPECT_FALSE(write_new_scene(asked, out));
    EXPECT_EQ(out.count(Diagnostic::Severity::error), said.size()) << test::messages(out);
    for (const std::string& words : said) EXPECT_TRUE(contains(test::messages(out), words)) << test::messages(out);
    EXPECT_FALSE(std::filesystem::exists(folder / "knee"));
  };
  NewScene asked = asked_with(folder / "knee", folder / "bad.csv");
  refused(asked, {"bad.csv:2:15: z = \"z\": must be a number", "bad.csv:3: z: is missing"});
  asked.femur = folder / "none.stl";
  refused(asked, {"none.stl", "bad.csv:2:15", "bad.csv:3: z"});
  asked.anterior = "front";
  refused(asked, {"must be one of x, y, z", "bad.csv:2:15", "bad.csv:3: z"});
  asked = asked_with(folder / "knee", folder / "left.csv");
  asked.left = false;
  refused(asked, {"--side = right: contradicts the names of the landmarks, which are of a left knee"});
  asked = asked_with(folder / "knee", "");
  asked.landmark_error = 1e-3;
  refused(asked, {"--landmark-error: belongs to --landmarks FILE"});
}

}  // namespace
}  // namespace genu
