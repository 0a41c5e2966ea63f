#include "genu/new_scene/new_pieces.h"

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/stl_writer.h"
#include "support/data.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using test::data_path;

/// Half a ball of this radius (z > `from`), about the origin, in triangles that face outward; closed by a smaller one
/// where `inner` > 0.
Mesh cap(double radius, double inner = 0, double from = 0) {
  Mesh mesh;
  constexpr int kRings = 20, kSpokes = 48;
  const double end = std::acos(from / radius);
  const auto add = [&](double r, bool outward) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(0, 0, r);
    for (int i = 1; i <= kRings; ++i)
      for (int j = 0; j < kSpokes; ++j) {
        const double a = end * i / kRings, b = 2 * M_PI * j / kSpokes;
        mesh.vertices.emplace_back(r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a));
      }
    const auto put = [&](int a, int b, int c) {
      if (outward)
        mesh.triangles.push_back({first + a, first + b, first + c});
      else
        mesh.triangles.push_back({first + a, first + c, first + b});
    };
    for (int j = 0; j < kSpokes; ++j) {
      const int k = (j + 1) % kSpokes;
      put(0, 1 + j, 1 + k);
      for (int i = 1; i < kRings; ++i) {
        const int a = 1 + (i - 1) * kSpokes, b = a + kSpokes;
        put(a + j, b + j, b + k);
        put(a + j, b + k, a + k);
      }
    }
    return first + 1 + (kRings - 1) * kSpokes;
  };
  const int outer_rim = add(radius, true);
  if (inner == 0) return mesh;
  const int inner_rim = add(inner, false);
  for (int j = 0; j < kSpokes; ++j) {
    const int k = (j + 1) % kSpokes;
    mesh.triangles.push_back({outer_rim + j, inner_rim + j, outer_rim + k});
    mesh.triangles.push_back({outer_rim + k, inner_rim + j, inner_rim + k});
  }
  return mesh;
}

Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

const Mesh kBone = cap(20e-3, 0, -20e-3 * 0.99);      // nearly a whole ball
const Mesh kClosedSheet = cap(22.5e-3, 20e-3, 8e-3);  // 2.5 mm thick, on a part of it

TEST(NewPieces, AThinClosedSheetOnABoneIsCartilage) {
  EXPECT_NEAR(sheet_thickness(kClosedSheet), 2.5e-3, 0.4e-3);
  EXPECT_EQ(sheet_thickness(kBone), 0);
  EXPECT_EQ(seem_cartilage({kBone, kClosedSheet}), (std::vector<bool>{false, true}));
  EXPECT_EQ(seem_cartilage({kClosedSheet, kBone}), (std::vector<bool>{true, false}));
}

TEST(NewPieces, OfTwoOpenSheetsTheOuterOneIs) {
  EXPECT_EQ(seem_cartilage({cap(20e-3), cap(22e-3)}), (std::vector<bool>{false, true}));
  EXPECT_EQ(seem_cartilage({cap(22e-3), cap(20e-3)}), (std::vector<bool>{true, false}));
}

TEST(NewPieces, BonesBesideEachOtherAreNoCartilage) {
  EXPECT_EQ(seem_cartilage({kBone, moved(kBone, Vec3(0, 0, 41e-3))}), (std::vector<bool>{false, false}));
  EXPECT_EQ(seem_cartilage({moved(kClosedSheet, Vec3(0.06, 0, 0)), kClosedSheet}), (std::vector<bool>{false, false}));
}

TEST(NewPieces, OfSeveralPiecesEachIsFound) {
  const Mesh other = moved(kBone, Vec3(0, 0, -41e-3));
  const Mesh on_other = moved(kClosedSheet, Vec3(0, 0, -41e-3));
  EXPECT_EQ(seem_cartilage({kClosedSheet, kBone, on_other, other}), (std::vector<bool>{true, false, true, false}));
}

PieceFiles files(const std::vector<std::string>& paths) {
  PieceFiles out;
  out.paths = paths;
  return out;
}

TEST(NewPieces, FilesAreSortedAndSaid) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const Mesh& mesh) {
    EXPECT_EQ(write_stl(mesh, folder / name, 1e-3, name), "");
    return folder / name;
  };
  const std::string bone = write("bone.stl", kBone), sheet = write("sheet.stl", kClosedSheet);
  NewScene asked;
  asked.femur_any = files({sheet, bone});
  asked.tibia_any = files({bone, sheet});
  std::vector<std::string> choices;
  Diagnostics out;
  const auto sorted = sort_pieces(asked, choices, out);
  ASSERT_TRUE(sorted) << test::messages(out);
  EXPECT_EQ(sorted->femur.text(), sheet);
  EXPECT_EQ(sorted->femur_bone.text(), bone);
  EXPECT_EQ(sorted->tibia.text(), sheet);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0],
            "meshes      femur: bone " + bone + ", cartilage " + sheet + "; tibia: bone " + bone + ", cartilage " +
                sheet +
                " (by their shape; --femur-cartilage, --tibia-cartilage and --patella-cartilage say otherwise)");

  asked.tibia_any = files({sheet});
  EXPECT_FALSE(sort_pieces(asked, choices, out));
  EXPECT_NE(test::messages(out).find("cartilage over bone is given for one of femur and tibia (femur: bone "),
            std::string::npos);
  Diagnostics twice;
  asked.tibia_any = files({bone, bone});
  EXPECT_FALSE(sort_pieces(asked, choices, twice));
  EXPECT_NE(test::messages(twice).find("is named twice"), std::string::npos);
  Diagnostics missing;
  asked.tibia_any = files({"no/bone.stl", "no/sheet.stl"});
  EXPECT_FALSE(sort_pieces(asked, choices, missing));
  EXPECT_EQ(missing.items().size(), 2U);
  EXPECT_NE(test::messages(missing).find("--tibia = \"no/bone.stl\": there is no such mesh file"), std::string::npos);
}

TEST(NewPieces, OfMeasuredKnees) {
  GENU_NEEDS_DATA("ssm/mean_Femur.ply");
  GENU_NEEDS_DATA("lenhart2015/lenhart2015-R-tibia-bone.stl");
  const std::string ssm = data_path("ssm/"), lenhart = data_path("lenhart2015/");
  for (const auto& [bone, cartilage] :
       {std::pair(ssm + "mean_Femur.ply", ssm + "mean_Femur_Cartilage.ply"),
        std::pair(ssm + "mean_Tibia_shifted.ply", ssm + "mean_Tibia_Cartilage_shifted.ply"),
        std::pair(ssm + "S001_Femur.ply", ssm + "S001_Femur_Cartilage.ply"),
        std::pair(ssm + "S002_Tibia.ply", ssm + "S002_Tibia_Cartilage.ply"),
        std::pair(lenhart + "lenhart2015-R-femur-subchondral-bone.stl", lenhart + "ACLC01-R-femur-cart.stl"),
        std::pair(lenhart + "lenhart2015-R-tibia-bone.stl", lenhart + "ACLC01-R-tibia-cart.stl")}) {
    NewScene asked;
    asked.femur_any = asked.tibia_any = files({cartilage, bone});
    std::vector<std::string> choices;
    Diagnostics out;
    const auto sorted = sort_pieces(asked, choices, out);
    ASSERT_TRUE(sorted) << test::messages(out);
    EXPECT_EQ(sorted->femur.text(), cartilage);
    EXPECT_EQ(sorted->femur_bone.text(), bone);
  }
}

}  // namespace
}  // namespace genu
