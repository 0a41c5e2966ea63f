// Meshes that are taken for what they are not, by what the reference knee fits.
#include "genu/new_scene/fit_doubts.h"

#include <utility>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "support/data.h"
#include "support/text.h"

namespace genu {
namespace {

struct TwoBones {
  Mesh femur, tibia;
};
TwoBones bones_of(const std::string& name) {
  Diagnostics out;
  auto femur = read_mesh(test::data_path("ssm/" + name + "_Femur.ply"), 1e-3, out),
       tibia = read_mesh(test::data_path("ssm/" + name + "_Tibia.ply"), 1e-3, out);
  EXPECT_TRUE(femur && tibia);
  return {femur ? std::move(*femur) : Mesh{}, tibia ? std::move(*tibia) : Mesh{}};
}

/// The one doubt of the second mesh as tibia of the first, laid out so; an impossible one where there is another
/// number.
LayoutDoubt only_doubt(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee) {
  const double misfit = reference_misfit(femur, tibia, knee, false);
  const auto doubts = fit_doubts(femur, tibia, knee, misfit);
  EXPECT_EQ(doubts.size(), 1u) << misfit;
  return doubts.size() == 1 ? doubts[0] : LayoutDoubt{true, "not one doubt"};
}

TEST(FitDoubts, AreNoneOfBonesAsTheyAre) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  for (const char* name : {"S001", "S002"}) {
    const TwoBones bones = bones_of(name);
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
    const TwoBones bones = bones_of(name);
    const LayoutDoubt doubt = only_doubt(bones.tibia, bones.femur, *lay_out_knee(bones.tibia, bones.femur));
    EXPECT_TRUE(doubt.impossible) << name;
    EXPECT_TRUE(test::contains(doubt.what, "exchanged")) << doubt.what;
  }
}

TEST(FitDoubts, NameBonesTakenBackToFront) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  for (const char* name : {"S001", "S002"}) {
    const TwoBones bones = bones_of(name);
    const auto knee = lay_out_knee(bones.femur, bones.tibia, {}, axis_named("-y"));
    const LayoutDoubt doubt = only_doubt(bones.femur, bones.tibia, *knee);
    EXPECT_FALSE(doubt.impossible) << name;
    EXPECT_TRUE(test::contains(doubt.what, "anterior were y")) << doubt.what;
  }
}

TEST(FitDoubts, TellALeftKneeByItsShape) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  TwoBones bones = bones_of("S001");
  EXPECT_EQ(fits_left(bones.femur, bones.tibia, *lay_out_knee(bones.femur, bones.tibia)), false);
  for (Mesh* mesh : {&bones.femur, &bones.tibia}) {
    for (Vec3& p : mesh->vertices) p.x() = -p.x();  // sideways in these files
    for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
  }
  EXPECT_EQ(fits_left(bones.femur, bones.tibia, *lay_out_knee(bones.femur, bones.tibia)), true);
}

}  // namespace
}  // namespace genu
