// What tools/compare-peers asks of genu: the knee it tells the other programs, and the yardstick for their poses. None
// of them is needed here.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/mesh_files/stl_writer.h"
#include "peers/judge.h"
#include "peers/programs/solver.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu::peers {
namespace {

const std::string kScene = genu::test::source_folder() + "/meshes/dortmans1984/scene.toml";

const Prepared& prepared() {
  static const Prepared knee = [] {
    Diagnostics out;
    return prepare_knee(kScene, "", out).value();
  }();
  return knee;
}

const FoundPath& rigid() {
  static const FoundPath path = solve_path(prepared());
  return path;
}

/// genu's pose at 35 deg, changed.
template <typename Change>
Judged judge_changed(Change change) {
  constexpr std::size_t kPose = 35;
  FoundPath path = rigid();
  change(path.poses[kPose]);
  return judge(prepared(), path, rigid())[kPose];
}

std::string knee_text() {
  Diagnostics out;
  const test::TemporaryFolder folder;
  EXPECT_EQ(write_knee(make_knee(prepared(), out).value(), folder / "knee.txt"), "");
  return test::read_file(folder / "knee.txt");
}

TEST(Peers, FilesBringBackEveryNumber) {
  const test::TemporaryFolder folder;
  Knee knee;
  const std::string text = knee_text();
  ASSERT_EQ(read_knee(folder.write("knee.txt", text), knee), "");
  EXPECT_EQ(knee.springs.size(), 7u);
  EXPECT_EQ(knee.pairs.size(), 2u);
  EXPECT_EQ(knee.flexions.size(), 71u);
  ASSERT_EQ(write_knee(knee, folder / "again.txt"), "");
  EXPECT_EQ(test::read_file(folder / "again.txt"), text);

  FoundPath path;
  ASSERT_EQ(write_path(rigid(), folder / "poses"), "");
  ASSERT_EQ(read_path(folder / "poses", path), "");
  ASSERT_EQ(path.poses.size(), rigid().poses.size());
  for (std::size_t k = 0; k < path.poses.size(); ++k) {
    EXPECT_EQ(path.poses[k].coordinates, rigid().poses[k].coordinates);
    EXPECT_EQ(path.poses[k].contact, rigid().poses[k].contact);
  }
}

TEST(Peers, FilesThatCannotBeReadAreToldWithTheirLine) {
  const test::TemporaryFolder folder;
  FoundPath path;
  EXPECT_NE(read_path(folder / "none", path), "");
  EXPECT_NE(read_path(folder.write("knee", knee_text()), path), "");
  for (const char* line : {"pose 1 2 3", "seconds 1 2", "seconds x", "time 1", ""})
    EXPECT_NE(read_path(folder.write("bad", fmt::format("genu-peers-poses\nseconds 1\n{}\n", line)), path).find(":3:"),
              std::string::npos)
        << line;
  EXPECT_NE(write_path(path, folder / "no/such/folder"), "");
}

TEST(Peers, TheProgramsHaveTheLawOfTheScene) {
  Diagnostics out;
  const Knee knee = make_knee(prepared(), out).value();
  for (std::size_t k = 0; k < knee.springs.size(); ++k)
    for (const double strain : {-0.1, 0.0, 0.01, 0.08}) {
      const double length = knee.springs[k].slack_length * (1 + strain);
      const LawValue law = prepared().model.ligaments[k].law.evaluate(length);
      const SpringValue spring = evaluate(knee.springs[k], length);
      EXPECT_NEAR(spring.force, law.force, 1e-12 * (1 + law.force));
      EXPECT_NEAR(spring.energy, law.energy, 1e-12 * (1 + law.energy));
    }
}

TEST(Peers, GenusOwnPosesBalance) {
  for (const Judged& pose : judge(prepared(), rigid(), rigid())) {
    EXPECT_FALSE(pose.failed);
    EXPECT_LT(pose.unbalanced, 1e-9);
    EXPECT_EQ(pose.distance, 0);
  }
}

TEST(Peers, LayersSummedAsOpenSimJamDoesPressAsGenusDo) {
  const test::TemporaryFolder folder;
  for (std::size_t k = 0; k < prepared().surfaces.size(); ++k) {
    const SurfaceDef& def = prepared().scene.surfaces[k];
    if (def.shape != SurfaceDef::Shape::torus) continue;
    const Mesh condyle = prepared().surfaces[k]->triangles(2e-3, Vec3::Zero(), 0.1);
    ASSERT_EQ(write_stl(condyle, folder / (def.name + ".stl"), 1e-3, "condyle"), "");
  }
  constexpr double kSoft = 10e9;  // N/m^3
  Diagnostics out;
  const auto ours = prepare_layers(kScene, folder / ".", {kSoft, false}, out),
             plain = prepare_layers(kScene, folder / ".", {kSoft, true}, out);
  ASSERT_TRUE(ours && plain) << to_string(out.items().front());
  const FoundPath by_genu = solve_path(*ours), by_jam = solve_path(*plain);
  const std::vector<Judged> judged = judge(prepared(), by_genu, rigid());
  ASSERT_EQ(by_jam.poses.size(), judged.size());
  for (std::size_t k = 0; k < judged.size(); ++k) {
    EXPECT_FALSE(judged[k].failed);
    EXPECT_LT(judged[k].unbalanced, 1e-8);
    EXPECT_GT(judged[k].distance, 0.3e-3) << "a soft layer gives way";
    EXPECT_LT(judged[k].distance, 2e-3);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(by_jam.poses[k].coordinates[i], by_genu.poses[k].coordinates[i], 1e-9) << "pose " << k;
  }
}

TEST(Peers, WhatIsUnbalancedAndHowFarIsMeasured) {
  const double length = prepared().model.scales.length;
  EXPECT_NEAR(judge_changed([](FoundPose& p) { p.contact[0] += 0.05; }).unbalanced, 0.05, 1e-9);
  EXPECT_NEAR(judge_changed([&](FoundPose& p) { p.contact[4] += 0.05 * length; }).unbalanced, 0.05, 1e-3);
  EXPECT_TRUE(judge_changed([](FoundPose& p) { p.contact[0] += 1.1 * kMostUnbalanced; }).failed);
  EXPECT_TRUE(judge_changed([](FoundPose& p) { p.settled = false; }).failed);
  EXPECT_TRUE(judge_changed([](FoundPose& p) { p.contact[0] = std::nan(""); }).failed);

  const Judged moved = judge_changed([](FoundPose& p) { p.coordinates[3] += 1e-5; });
  EXPECT_NEAR(moved.distance, 1e-5, 1e-12);
  EXPECT_LT(moved.angle, 1e-7);
  EXPECT_GT(moved.unbalanced, 0.01);
  EXPECT_NEAR(judge_changed([](FoundPose& p) { p.coordinates[2] += 1e-3; }).angle, 1e-3, 1e-9);
}

TEST(Peers, TheMomentThatHoldsFlexionIsLeftOut) {
  // It does no work while the femur is adducted or turned: it is normal to both of these axes.
  const auto held = [](FoundPose& p) {
    const Coordinates& c = p.coordinates;
    const Vec3 second = exp_rotation(c[0] * Vec3::UnitX()) * Vec3::UnitY();
    const Mat3 R = prepared().model.joints[0].coordinates.pose_from(c).R;
    const Vec3 moment = second.cross(R.col(2));
    for (std::size_t i = 0; i < 3; ++i) p.contact[3 + i] += moment[static_cast<Eigen::Index>(i)];
  };
  EXPECT_LT(judge_changed(held).unbalanced, 1e-9);
}

TEST(Peers, MissingPosesHaveFailed) {
  FoundPath path = rigid();
  path.poses.resize(10);
  int failed = 0;
  for (const Judged& pose : judge(prepared(), path, rigid())) failed += pose.failed ? 1 : 0;
  EXPECT_EQ(failed, 61);
}

TEST(Peers, TheTableHasMediansAndTheLargest) {
  const Row good{"genu", "rigid", 1000, {3e-3, 1e-3, 2e-3}, {{0.01, 1e-5, 0, false}, {0.03, 2e-5, 0, false}}};
  const Row none{"other", "elastic", 0, {}, {Judged{}, Judged{}}};
  const std::string text = to_text({good, none});
  EXPECT_NE(text.find("1000      1.000          0.03      0.02         0     0 of 2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("-          -             -         -         -     2 of 2\n"), std::string::npos) << text;
}

TEST(Peers, OtherScenesAreRefused) {
  Diagnostics out;
  const auto other =
      prepare_knee(genu::test::source_folder() + "/meshes/leskovar2019/scene-without-joints.toml", "", out);
  ASSERT_TRUE(other);
  EXPECT_FALSE(make_knee(*other, out));
  EXPECT_TRUE(out.has_errors());
}

TEST(Peers, BadUseIsToldAndLeavesNothing) {
  const std::string command = genu::test::source_folder() + "/tools/compare-peers /no/such/folder > /dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
}

}  // namespace
}  // namespace genu::peers
