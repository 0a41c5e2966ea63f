// Meshes that are taken for what they are not, by what the reference knee fits.
#include "genu/study/fit_doubts.h"

#include <utility>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "support/data.h"
#include "support/text.h"

namespace genu {
namespace {

struct Bones {
  Mesh femur, tibia;
};
Bones bones_of(const std::string& name) {
  Diagnostics out;
  auto femur = read_mesh(test::data_path("ssm/" + name + "_Femur.ply"), 1e-3, out),
       tibia = read_mesh(test::data_path("ssm/" + name + "_Tibia.ply"), 1e-3, out);
  EXPECT_TRUE(femur && tibia);
  return {femur ? std::move(*femur) : Mesh{}, tibia ? std::move(*tibia) : Mesh{}};
}

TEST(FitDoubts, AreNoneOfBonesAsTheyAre) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  for (const char* name : {"S001", "S002"}) {
    const Bones bones = bones_of(name);
    const auto knee = lay_out_knee(bones.femur, bones.tibia);
    const double misfit = reference_misfit(bones.femur, bones.tibia, *knee, false);
    EXPECT_TRUE(fit_doubts(bones.femur, bones.tibia, *knee, misfit).empty()) << name;
    // Nor are there any if the other readings are tried.
    EXPECT_TRUE(fit_doubts(bones.femur, bones.tibia, *knee, 1e-3).empty()) << name;
  }
}

TEST(FitDoubts, NameExchangedBones) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  for (const char* name : {"S001", "S002"}) {
    const Bones bones = bones_of(name);
    const auto knee = lay_out_knee(bones.tibia, bones.femur);
    const double misfit = reference_misfit(bones.tibia, bones.femur, *knee, false);
    const auto doubts = fit_doubts(bones.tibia, bones.femur, *knee, misfit);
    ASSERT_EQ(doubts.size(), 1u) << name << " " << misfit;
    EXPECT_TRUE(doubts[0].impossible);
    EXPECT_TRUE(test::contains(doubts[0].what, "exchanged")) << doubts[0].what;
  }
}

TEST(FitDoubts, NameBonesTakenBackToFront) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  for (const char* name : {"S001", "S002"}) {
    const Bones bones = bones_of(name);
    const auto knee = lay_out_knee(bones.femur, bones.tibia, {}, axis_named("-y"));
    const double misfit = reference_misfit(bones.femur, bones.tibia, *knee, false);
    const auto doubts = fit_doubts(bones.femur, bones.tibia, *knee, misfit);
    ASSERT_EQ(doubts.size(), 1u) << name << " " << misfit;
    EXPECT_FALSE(doubts[0].impossible);
    EXPECT_TRUE(test::contains(doubts[0].what, "anterior were y")) << doubts[0].what;
  }
}

TEST(FitDoubts, TellALeftKneeByItsShape) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  Bones bones = bones_of("S001");
  EXPECT_EQ(fits_left(bones.femur, bones.tibia, *lay_out_knee(bones.femur, bones.tibia)), false);
  for (Mesh* mesh : {&bones.femur, &bones.tibia}) {
    for (Vec3& p : mesh->vertices) p.x() = -p.x();  // sideways in these files
    for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
  }
  EXPECT_EQ(fits_left(bones.femur, bones.tibia, *lay_out_knee(bones.femur, bones.tibia)), true);
}

}  // namespace
}  // namespace genu
