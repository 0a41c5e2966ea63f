#include "genu/store/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "genu/results/report.h"
#include "genu/study/run_motion.h"
#include "support/judged.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

using test::read_file;

struct Solved {
  std::optional<Prepared> prepared;
  Solution solution;

  explicit Solved(const std::string& file) {
    Diagnostics out;
    prepared = prepare(file, out);
    EXPECT_TRUE(prepared.has_value()) << test::messages(out);
    if (!prepared) return;
    if (prepared->scene.dynamics) {
      solution = solve_motion(*prepared, {});
      return;
    }
    ContactField field(prepared->model);
    solution = test::judged(*prepared, solve(*prepared, field, {}));
  }
  ReportRun report() const { return report_run(*prepared, solution); }
};

TEST(Report, PosesContactsAndForcesAreThoseOfTheTable) {
  const Solved knee(test::dortmans_file());
  const ReportRun r = knee.report();
  ASSERT_EQ(r.body_poses.size(), r.poses->rows());
  ASSERT_EQ(r.contacts.size(), 2u);
  EXPECT_EQ(r.contacts[0].name, "medial");
  EXPECT_EQ(r.contacts[0].surface, "tibia_medial");
  for (std::size_t row = 0; row < r.poses->rows(); row += 10) {
    const Pose relative = r.body_poses[row][0].inverse() * r.body_poses[row][1];
    const Vec3 shown = knee.prepared->model.joints[0].parent == 0 ? relative.p : relative.inverse().p;
    EXPECT_NEAR(1e3 * shown.z(), r.poses->number(row, "knee.z_mm"), 1e-9) << row;
    const ReportContact& c = r.contacts[0];
    EXPECT_NEAR(c.force[row].norm(), r.poses->number(row, "medial.force_N"), 1e-9);
    EXPECT_NEAR(1e3 * c.point[row].y(), r.poses->number(row, "medial.tibia_medial.y_mm"), 1e-9);
    EXPECT_NEAR(c.force[row].z(), -c.force[row].norm(), 1e-9);  // it presses on the plane
  }
}

TEST(Report, EverySurfaceIsShownAndAPlaneEndsRoundItsContacts) {
  const Solved knee(test::dortmans_file());
  const ReportRun r = knee.report();
  ASSERT_EQ(r.meshes.size(), 4u);
  for (const ReportMesh& mesh : r.meshes) {
    EXPECT_GT(mesh.triangles.size(), 50u) << mesh.name;
    EXPECT_LT(mesh.triangles.size(), 10'000u) << mesh.name;
    for (const Vec3& v : mesh.vertices) ASSERT_LT(v.norm(), 0.2) << mesh.name;
  }
}

TEST(Report, AMotionHasAllItsPosesAndTheBonesOfItsFiles) {
  const Solved knee(genu::test::source_folder() + "/meshes/leskovar2019/scene-bones.toml");
  const ReportRun r = knee.report();
  EXPECT_EQ(r.body_poses.size(), 1701u);
  ASSERT_EQ(r.meshes.size(), 2u);
  EXPECT_EQ(r.meshes[0].kind, ReportMesh::Kind::bone);
  EXPECT_EQ(r.meshes[0].triangles_in_full, r.meshes[0].triangles.size());
  const double angle = Eigen::AngleAxisd(r.body_poses[340][1].R).angle() * 180 / 3.14159265358979;
  EXPECT_NEAR(angle, r.poses->number(340, "j1.angle_deg"), 1e-6);
}

TEST(Report, ALayersForceStandsAtItsCentreOfPressure) {
  test::TemporaryFolder folder;
  std::string text = read_file(test::dortmans_file());
  for (int k = 0; k < 2; ++k)
    text = test::with_first(text, "model = \"rigid\"",
                            "model = \"cartilage\"\nmodulus = 20\npoisson = 0.45\nthickness = 4");
  text = test::with_first(text, "[0, 70]", "[0, 10]");
  text = test::with_first(text, "increments = 70", "increments = 1");
  const Solved knee(folder.write("scene.toml", text));
  const ReportRun r = knee.report();
  ASSERT_EQ(r.contacts.size(), 2u);
  EXPECT_NEAR(r.contacts[1].force[1].norm(), r.poses->number(1, "lateral.force_N"), 1e-9);
  EXPECT_NEAR(1e3 * r.contacts[1].point[1].y(), r.poses->number(1, "lateral.tibia_lateral.y_mm"), 1e-9);
}

TEST(Report, OfAnIsometricTestTheLoadIsTheAxis) {
  test::TemporaryFolder folder;
  std::string text = test::with_first(read_file(test::dortmans_file()), "[0, 70]", "20");
  text = test::with_first(text, "increments = 70", "increments = 3\nload = { pull = [0, 1] }");
  text = test::with_first(text, "[[step]]", "[load.pull]\nbody = \"femur\"\nforce = [0, 5, 0]\n\n[[step]]");
  const Solved knee(folder.write("scene.toml", text));
  const ReportRun r = knee.report();
  EXPECT_EQ(r.main_coordinate, "pull.factor");
  EXPECT_NE(std::find(r.coordinates.begin(), r.coordinates.end(), "pull.factor"), r.coordinates.end());
  EXPECT_EQ(Solved(test::dortmans_file()).report().main_coordinate, "knee.flexion_deg");
}

TEST(Report, WithoutLimitsItHasAllRows) {
  const Solved knee(test::dortmans_file());
  ReportLimits few;
  few.numbers = 1000;
  EXPECT_LT(report_run(*knee.prepared, knee.solution, {}, few).body_poses.size(), 71u);
  EXPECT_EQ(report_run(*knee.prepared, knee.solution, {}, ReportLimits::none()).body_poses.size(), 71u);
}

TEST(Report, IsWrittenWhereItIsAskedForAndChangesNoResult) {
  test::TemporaryFolder folder;
  Diagnostics out;
  RunOptions with;
  with.report = true;
  Solution solution;
  ASSERT_EQ(test::judged_run(test::dortmans_file(), folder / "with", with, out, &solution), kExitOk)
      << test::messages(out);
  ASSERT_EQ(test::judged_run(test::dortmans_file(), folder / "again", with, out, nullptr), kExitOk);
  ASSERT_EQ(test::judged_run(test::dortmans_file(), folder / "without", {}, out, nullptr), kExitOk);
  EXPECT_FALSE(std::filesystem::exists(folder / "without/report.html"));
  EXPECT_EQ(read_file(folder / "with/results.csv"), read_file(folder / "without/results.csv"));
  EXPECT_EQ(solution.summary.seconds.back().first, "report");
  const auto without_times = [&](const std::string& page) {
    const std::size_t from = page.find("id=\"genu-times\">\n") + 17;
    return page.substr(0, from) + page.substr(page.find('\n', from));
  };
  EXPECT_EQ(without_times(read_file(folder / "with/report.html")),
            without_times(read_file(folder / "again/report.html")));
}

}  // namespace
}  // namespace genu
