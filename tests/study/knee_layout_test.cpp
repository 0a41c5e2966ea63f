// Which way two meshes of a knee stand: found from drawn bones whose frame is known, however they are turned.
#include "genu/study/knee_layout.h"

#include <gtest/gtest.h>

#include "genu/core/diagnostics.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/data.h"
#include "support/leskovar.h"

namespace genu {
namespace {

using test::data_path;
using test::kLeskovar;

Mesh bone_of(const std::string& file, double unit = 1e-3) {
  Diagnostics out;
  auto mesh = read_mesh(file, unit, out);
  EXPECT_TRUE(mesh.has_value()) << file;
  return mesh.value_or(Mesh{});
}

Mesh turned(Mesh mesh, const Mat3& r, const Vec3& shift) {
  for (Vec3& p : mesh.vertices) p = r * p + shift;
  return mesh;
}

/// x anterior, y superior, z lateral, a right knee (bones.toml): in each of the 24 ways that axes can stand.
TEST(KneeLayout, IsFoundHoweverTheAxesStand) {
  const Mesh femur = bone_of(kLeskovar + "femur.stl"), tibia = bone_of(kLeskovar + "tibia.stl");
  const auto plain = lay_out_knee(femur, tibia);
  ASSERT_TRUE(plain.has_value());
  int ways = 0;
  for (const char* x : {"x", "y", "z", "-x", "-y", "-z"})
    for (const char* y : {"x", "y", "z", "-x", "-y", "-z"}) {
      if (axis_named(x)->dot(*axis_named(y)) != 0) continue;
      Mat3 r;
      r << *axis_named(x), *axis_named(y), axis_named(x)->cross(*axis_named(y));
      const Vec3 shift(0.3, -0.2, 1);
      const auto knee = lay_out_knee(turned(femur, r, shift), turned(tibia, r, shift));
      ASSERT_TRUE(knee.has_value());
      EXPECT_EQ(axis_word(knee->anterior), x);
      EXPECT_EQ(axis_word(knee->proximal), y);
      EXPECT_EQ(axis_word(knee->right), axis_word(r.col(2)));
      EXPECT_NEAR((knee->centre - (r * plain->centre + shift)).norm(), 0, 1e-9);
      EXPECT_NEAR(knee->width, plain->width, 1e-9);
      ++ways;
    }
  EXPECT_EQ(ways, 24);
  // The tibia is drawn 76 mm wide, its plateaus from z = -38 to 38 mm.
  EXPECT_NEAR(plain->width, 0.076, 0.003);
  EXPECT_NEAR(plain->centre.z(), 0, 0.002);
}

TEST(KneeLayout, TakesWhatIsGivenInsteadOfAGuess) {
  const Mesh femur = bone_of(kLeskovar + "femur.stl"), tibia = bone_of(kLeskovar + "tibia.stl");
  const auto knee = lay_out_knee(femur, tibia, axis_named("-y"), axis_named("-x"));
  ASSERT_TRUE(knee.has_value());
  EXPECT_EQ(axis_word(knee->anterior) + axis_word(knee->proximal) + axis_word(knee->right), "-x-yz");
  EXPECT_FALSE(lay_out_knee(femur, tibia, axis_named("y"), axis_named("-y")).has_value());
  EXPECT_FALSE(axis_named("").has_value());
  EXPECT_FALSE(axis_named("w").has_value());
  EXPECT_FALSE(axis_named("+x").has_value());
}

/// Two boxes 7 mm apart, the lower one 40 x 20 mm: the gap is exact, also where one is pushed into the other.
TEST(KneeLayout, MeasuresTheGapBetweenWhatFacesEachOther) {
  const auto box = [](double low, double high) {
    Mesh m;
    for (const double z : {low, high})
      for (const double y : {-0.01, 0.01})
        for (const double x : {-0.02, 0.02}) m.vertices.emplace_back(x, y, z);
    m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return m;
  };
  for (const double gap : {0.007, -0.003}) {
    const auto knee = lay_out_knee(box(gap, 0.03 + gap), box(-0.03, 0), axis_named("z"), axis_named("y"));
    ASSERT_TRUE(knee.has_value());
    EXPECT_NEAR(knee->gap, gap, 1e-12);
    EXPECT_NEAR(knee->width, 0.04, 1e-12);
    EXPECT_NEAR(knee->depth, 0.02, 1e-12);
  }
}

/// Of the public data x is anterior and y superior; of the shape model y is anterior and z superior.
TEST(KneeLayout, OfMeasuredKnees) {
  GENU_NEEDS_DATA("ssm/S002_Tibia_Cartilage.ply");
  const std::string lenhart = data_path("lenhart2015/ACLC01-R-");
  for (const std::string end : {".stl", "-medium.stl", "-coarse.stl", "-wicked-coarse.stl"}) {
    const auto knee = lay_out_knee(bone_of(lenhart + "femur-cart" + end, 1), bone_of(lenhart + "tibia-cart" + end, 1));
    ASSERT_TRUE(knee.has_value()) << end;
    EXPECT_EQ(axis_word(knee->anterior) + axis_word(knee->proximal), "xy") << end;
  }
  for (const std::string who : {"S001", "S002"})
    for (const std::string what : {"", "_Cartilage"}) {
      const std::string of = data_path("ssm/" + who);
      const auto knee = lay_out_knee(bone_of(of + "_Femur" + what + ".ply"), bone_of(of + "_Tibia" + what + ".ply"));
      ASSERT_TRUE(knee.has_value());
      EXPECT_EQ(axis_word(knee->anterior) + axis_word(knee->proximal), "yz") << who << what;
    }
}

}  // namespace
}  // namespace genu
