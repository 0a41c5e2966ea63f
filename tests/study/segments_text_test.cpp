// The stiffness of a cut is that of a beam, and the text is part of a scene that is read.
#include "genu/study/segments_text.h"

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

/// Two ends of a bar, 2 x 4 mm, each 10 mm long.
MeshSegments bar() {
  MeshSegments out;
  out.pieces.resize(2);
  out.pieces[0].length = out.pieces[1].length = 0.01;
  out.pieces[0].centroid = Vec3(0.005, 0, 0);
  out.pieces[1].centroid = Vec3(0.015, 0, 0);
  MeshSection cut;
  cut.centre = Vec3(0.01, 0, 0);
  cut.tangent = Vec3::UnitX();
  cut.y = Vec3::UnitY();
  cut.z = Vec3::UnitZ();
  cut.area = 8e-6;
  cut.about_y = 4e-3 * 8e-9 / 12;  // 4 mm wide, 2 mm high
  cut.about_z = 2e-3 * 64e-9 / 12;
  out.sections = {cut};
  return out;
}

const SegmentsText kOf{.name = "m",
                       .parent = "tibia",
                       .modulus = 1e8,
                       .shear_modulus = 3e7,
                       .density = 1000,
                       .above = "femur_cartilage",
                       .below = ""};

TEST(SegmentsText, TheStiffnessOfACutIsThatOfABeam) {
  const Vec6 k = section_stiffness(bar(), 0, kOf);
  EXPECT_NEAR(k[0], 1e8 * 8e-6 / 0.01, 1e-6);
  EXPECT_NEAR(k[1], 5.0 / 6 * 3e7 * 8e-6 / 0.01, 1e-6);
  EXPECT_EQ(k[2], k[1]);
  EXPECT_NEAR(k[4], 1e8 * 4e-3 * 8e-9 / 12 / 0.01, 1e-9);
  EXPECT_NEAR(k[5], 1e8 * 2e-3 * 64e-9 / 12 / 0.01, 1e-9);
  EXPECT_NEAR(k[3], 3e7 / 0.01 * 4 * (4e-3 * 8e-9 / 12) * (2e-3 * 64e-9 / 12) / (4e-3 * 8e-9 / 12 + 2e-3 * 64e-9 / 12),
              1e-9);
}

TEST(SegmentsText, IsPartOfAScene) {
  const std::string text =
      "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.tibia]\nfixed = true\n"
      "[surface.femur_cartilage]\nbody = \"tibia\"\nshape = \"plane\"\n[[step]]\nincrements = 1\n" +
      segments_text(bar(), kOf);
  const test::TemporaryFolder folder;
  for (const char* file : {"m_01_above.stl", "m_01_below.stl", "m_02_above.stl", "m_02_below.stl"})
    folder.write(file, "not read here");
  Diagnostics out;
  const auto scene = parse_scene(text, folder / "scene.toml", out);
  for (const Diagnostic& d : out.items()) EXPECT_NE(d.severity, Diagnostic::Severity::error) << to_string(d);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->bodies.size(), 3u);
  EXPECT_EQ(scene->bodies[1].name, "m_01");
  ASSERT_EQ(scene->bushings.size(), 1u);
  const BushingDef& b = scene->bushings[0];
  EXPECT_EQ(b.name, "m_hoop_01");
  EXPECT_LT((b.from.placement.p - Vec3(0.005, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(b.stiffness[0], 8e4, 1e-3);
  EXPECT_NEAR(b.rotation_stiffness[1], 1e8 * 4e-3 * 8e-9 / 12 / 0.01, 1e-8);
}

}  // namespace
}  // namespace genu
