// A fibula beside the drawn bones of leskovar2019, whose lateral side is x: a thin rod that begins below the joint.
#include "genu/new_scene/new_fibula.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "genu/atlas/fitted_knee.h"
#include "genu/core/units.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/new_scene/new_edit.h"
#include "genu/new_scene/new_scene.h"
#include "support/drawn_knee.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;

/// A closed rod with its axis along `down`, from its head. m
Mesh rod(const Vec3& head, const Vec3& down, double length, double radius) {
  constexpr std::size_t kAround = 24, kAlong = 20;
  const Vec3 side = down.unitOrthogonal(), other = down.cross(side);
  Mesh mesh;
  for (std::size_t i = 0; i <= kAlong; ++i)
    for (std::size_t k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kAround;
      mesh.vertices.push_back(head + length * static_cast<double>(i) / kAlong * down +
                              radius * (std::cos(angle) * side + std::sin(angle) * other));
    }
  const auto at = [](std::size_t i, std::size_t k) { return static_cast<int>(i * kAround + k % kAround); };
  for (std::size_t i = 0; i < kAlong; ++i)
    for (std::size_t k = 0; k < kAround; ++k) {
      mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      mesh.triangles.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  for (const std::size_t end : {std::size_t{0}, kAlong}) {
    mesh.vertices.push_back(head + length * static_cast<double>(end) / kAlong * down);
    const int cap = static_cast<int>(mesh.vertices.size()) - 1;
    for (std::size_t k = 0; k < kAround; ++k)
      mesh.triangles.push_back(end == 0 ? std::array{at(end, k + 1), at(end, k), cap}
                                        : std::array{at(end, k), at(end, k + 1), cap});
  }
  return mesh;
}

/// m: how far a point is from the axis of that rod.
double from_axis(const Vec3& x, const Vec3& head, const Vec3& down) {
  return ((x - head) - (x - head).dot(down) * down).norm();
}

class NewFibula : public testing::Test {
 protected:
  void SetUp() override {
    asked_ = test::drawn_knee_in(folder_ / "knee");
    Diagnostics out;
    auto bones = read_new_bones(asked_, out);
    ASSERT_TRUE(bones) << test::messages(out);
    bones_ = *bones;
    const auto knee = lay_out_knee(bones_.femur.mesh, bones_.tibia.mesh);
    ASSERT_TRUE(knee);
    knee_ = *knee;
    axes_ = {knee_.anterior, knee_.proximal, knee_.right, knee_.centre, knee_.width, knee_.gap, {}};
    fitted_ = fit_reference_knee(bones_.femur.mesh, bones_.tibia.mesh, axes_);
    down_ = -knee_.proximal;
    head_ = middle_of(fitted_.tibia, {"LCL"}) + 6e-3 * knee_.right - 4e-3 * down_;
  }

  std::string written(const Vec3& head) const {
    std::string file = folder_ / "fibula.stl";
    EXPECT_TRUE(write_stl(rod(head, down_, 0.09, 6e-3), file, 1e-3, "fibula").empty());
    return file;
  }

  test::TemporaryFolder folder_;
  NewScene asked_;
  NewBones bones_;
  KneeLayout knee_;
  KneeAxes axes_;
  FittedKnee fitted_;
  Vec3 down_, head_;
};

TEST_F(NewFibula, TakesTheLigamentsThatInsertOnIt) {
  const FittedKnee before = fitted_;
  const double farthest = put_on_fibula(rod(head_, down_, 0.09, 6e-3), fitted_);
  EXPECT_GT(farthest, 1e-4);
  EXPECT_LT(farthest, 15e-3);
  const auto& fibres = reference_knee().fibres;
  int put = 0;
  for (std::size_t i = 0; i < fibres.size(); ++i) {
    const Insertion &now = fitted_.tibia.insertions[i], &then = before.tibia.insertions[i];
    if (fibres[i].bundle != "LCL" && fibres[i].bundle != "PFL") {
      EXPECT_EQ(now.at, then.at) << fibres[i].name;
      continue;
    }
    ++put;
    EXPECT_TRUE(now.on_mesh);
    EXPECT_LE(from_axis(now.at, head_, down_), 6e-3 + 1e-9) << fibres[i].name;
    EXPECT_LE((now.at - then.at).norm(), farthest + 1e-12);
  }
  EXPECT_EQ(put, 9);
}

TEST_F(NewFibula, FarAwayTakesNone) {
  const FittedKnee before = fitted_;
  const double farthest = put_on_fibula(rod(head_ + 0.05 * knee_.right, down_, 0.09, 6e-3), fitted_);
  EXPECT_GT(farthest, 30e-3);
  for (std::size_t i = 0; i < before.tibia.insertions.size(); ++i)
    EXPECT_EQ(fitted_.tibia.insertions[i].at, before.tibia.insertions[i].at);
}

TEST_F(NewFibula, SaysWhichSideIsLateral) {
  EXPECT_EQ(left_by_fibula(rod(head_, down_, 0.09, 6e-3), knee_), std::optional(false));
  EXPECT_EQ(left_by_fibula(rod(knee_.centre - 0.03 * knee_.right, down_, 0.09, 6e-3), knee_), std::optional(true));
  EXPECT_FALSE(left_by_fibula(rod(knee_.centre, down_, 0.09, 6e-3), knee_));
  EXPECT_FALSE(left_by_fibula({}, knee_));
  // A whole one that stands askew: its middle is on the other side, its head is not.
  const Vec3 askew = (down_ - 0.5 * knee_.right).normalized();
  EXPECT_EQ(left_by_fibula(rod(head_, askew, 0.36, 6e-3), knee_), std::optional(false));
}

TEST_F(NewFibula, IsPartOfTheTibiaInTheScene) {
  asked_.fibula.paths = {written(head_)};
  asked_.picture = folder_ / "knee.svg";
  Diagnostics out;
  const auto made = write_new_scene(asked_, out);
  ASSERT_TRUE(made) << test::messages(out);
  EXPECT_FALSE(out.has_errors());
  std::string said;
  for (const std::string& line : made->choices) said += line + "\n";
  EXPECT_TRUE(contains(said, "fibula      lateral collateral and popliteofibular"));
  EXPECT_TRUE(contains(said, "side        right (by the side of the fibula"));
  EXPECT_EQ(made->poses_solved, made->poses_asked);
  const std::string text = test::read_file(made->file);
  EXPECT_TRUE(contains(text, "[surface.fibula]\nbody = \"tibia\"\n"));
  // It is drawn with the tibia, whose colours it has, and its ligaments keep their errors.
  const std::string picture = test::read_file(asked_.picture);
  EXPECT_TRUE(contains(picture, "data:image/png;base64,"));
  EXPECT_TRUE(contains(picture, "LCL ±")) << "as put onto it";
}

TEST_F(NewFibula, ElsewhereIsRefused) {
  asked_.fibula.paths = {"fibula.stl"};
  const auto fits = [&](const Vec3& head) {
    bones_.fibula = NewBone{rod(head, down_, 0.09, 6e-3), 1e-3, {}};
    Diagnostics out;
    const bool good = check_fibula(asked_, bones_, knee_, out);
    EXPECT_EQ(good, !out.has_errors());
    EXPECT_TRUE(good || contains(test::messages(out), "fibula.stl: is not where a fibula is")) << test::messages(out);
    return good;
  };
  EXPECT_TRUE(fits(head_));
  EXPECT_FALSE(fits(head_ + 0.5 * down_));
  EXPECT_FALSE(fits(head_ - 0.08 * down_)) << "beside the femur";
  EXPECT_FALSE(fits(head_ + 0.1 * knee_.right));
  bones_.fibula = NewBone{};
  Diagnostics empty;
  EXPECT_FALSE(check_fibula(asked_, bones_, knee_, empty));
  EXPECT_TRUE(contains(test::messages(empty), "has no triangles")) << test::messages(empty);
}

TEST_F(NewFibula, OfAnotherBonesFileIsRefused) {
  asked_.fibula.paths = {asked_.tibia.paths.front()};
  Diagnostics out;
  EXPECT_FALSE(write_new_scene(asked_, out));
  EXPECT_TRUE(contains(test::messages(out), "is given for another bone too")) << test::messages(out);
  asked_.fibula.paths = {"a.stl", "a.stl"};
  Diagnostics twice;
  EXPECT_FALSE(write_new_scene(asked_, twice));
  EXPECT_TRUE(contains(test::messages(twice), "is named twice")) << test::messages(twice);
}

/// Written again without it, its ligaments would go back to the tibia without a word.
TEST_F(NewFibula, IsAskedForAgain) {
  std::filesystem::create_directory(folder_ / "knee");
  const NewSceneFiles files{folder_ / "knee", "knee"};
  const std::string scene = test::read_file(test::dortmans_file());
  std::ofstream(files.scene()) << scene;
  std::ofstream(files.written()) << written_copy(scene + "\n[surface.fibula]\n");
  Diagnostics out;
  EXPECT_FALSE(read_earlier(files, asked_, out));
  EXPECT_TRUE(contains(test::messages(out), "has a fibula: give --fibula again")) << test::messages(out);
  asked_.fibula.paths = {"fibula.stl"};
  Diagnostics nothing;
  EXPECT_TRUE(read_earlier(files, asked_, nothing)) << test::messages(nothing);
}

TEST_F(NewFibula, OnTheOtherSideOrFarAwayIsDoubted) {
  Diagnostics out;
  bones_.fibula = NewBone{rod(head_, down_, 0.09, 6e-3), 1e-3, {}};
  asked_.fibula.paths = {"fibula.stl"};
  doubt_fibula(asked_, bones_, knee_, false, out);
  EXPECT_TRUE(out.items().empty());
  doubt_fibula(asked_, bones_, knee_, true, out);
  EXPECT_TRUE(contains(test::messages(out), "as the fibula of a right knee does, and this is a left one"));
  bones_.fibula =
      NewBone{rod(head_ - 2 * (head_ - knee_.centre).dot(knee_.right) * knee_.right, down_, 0.09, 6e-3), 1e-3, {}};
  Diagnostics other;
  doubt_fibula(asked_, bones_, knee_, true, other);
  EXPECT_TRUE(contains(test::messages(other), "left knee does, and the shape of the bones is that of a right one"));
  Diagnostics far;
  EXPECT_EQ(fibula_choice(asked_, 0.04, far), "no ligament put onto it");
  EXPECT_EQ(fibula_choice(asked_, 0, far), "no ligament put onto it: landmarks say where they insert");
  EXPECT_TRUE(contains(test::messages(far), "is 40.0 mm from where"));
}

}  // namespace
}  // namespace genu
