// Thickness down to a bone: concentric balls and parallel planes, whichever way the bone is wound; places without bone,
// and bone that stands out.
#include "genu/contact/bone_thickness.h"

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

BoneUnder bone_of(Mesh mesh, bool turned = false) {
  if (turned)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return {std::make_shared<const TriangleTree>(mesh), 0.5e-3, 10e-3};
}

Mesh moved(Mesh mesh, const Vec3& by, double tilt = 0) {
  for (Vec3& v : mesh.vertices) v += by + tilt * v[0] * Vec3::UnitZ();
  return mesh;
}

TEST(BoneThickness, ConcentricBalls) {
  constexpr double kOuter = 22e-3, kInner = 19e-3;
  double last = 0;
  for (const double edge : {2e-3, 1e-3}) {
    const Mesh cartilage = test::ball(kOuter, edge);
    for (const bool turned : {false, true}) {
      BoneReport report;
      const auto field = measure_thickness(cartilage, bone_of(test::ball(kInner, edge), turned), report);
      ASSERT_TRUE(field);
      EXPECT_EQ(report.without, 0);
      EXPECT_EQ(report.thin, 0);
      const double worst = std::max(field->most() - (kOuter - kInner), kOuter - kInner - field->least());
      // Facets lie up to h^2 / 8R inside of a ball, and a good deal more where triangles are long.
      EXPECT_LT(worst, edge * edge / (2 * kInner)) << edge;
      if (!turned && last > 0) {
        EXPECT_LT(worst, 0.4 * last);
      }
      if (!turned) last = worst;
    }
  }
}

TEST(BoneThickness, TiltedPlane) {
  const Mesh cartilage = test::sheet(10e-3, 20);
  BoneReport report;
  const auto field = measure_thickness(cartilage, bone_of(moved(test::sheet(12e-3, 7), {0, 0, -3e-3}, 0.1)), report);
  ASSERT_TRUE(field);
  double worst = 0;
  for (std::size_t v = 0; v < cartilage.vertices.size(); ++v)
    worst = std::max(worst, std::abs(field->at_vertex(static_cast<int>(v)) - 3e-3 + 0.1 * cartilage.vertices[v][0]));
  for (std::size_t k = 0; k < cartilage.triangles.size(); ++k) {
    Vec3 x = Vec3::Zero();
    for (const int v : cartilage.triangles[k]) x += cartilage.vertices[static_cast<std::size_t>(v)] / 3;
    worst = std::max(worst, std::abs(field->at_centroid(static_cast<int>(k)) - 3e-3 + 0.1 * x[0]));
  }
  EXPECT_LT(worst, 1e-15);
  EXPECT_EQ(report.vertices, 21 * 21);
  EXPECT_EQ(report.without + report.thin, 0);
}

TEST(BoneThickness, BoneThatEndsIsContinued) {
  // Cartilage to 10 mm, bone to 6 mm: vertices every 1 mm, four rings without bone.
  const Mesh cartilage = test::sheet(10e-3, 20);
  BoneReport report;
  const auto field = measure_thickness(cartilage, bone_of(moved(test::sheet(6.1e-3, 7), {0, 0, -3e-3})), report);
  ASSERT_TRUE(field);
  EXPECT_EQ(report.without, 21 * 21 - 13 * 13);
  EXPECT_NEAR(field->least(), 3e-3, 1e-15);
  EXPECT_NEAR(field->most(), 3e-3, 1e-15);
  EXPECT_GE(report.farthest, 3.99e-3);
  EXPECT_LE(report.farthest, 8.01e-3);
  EXPECT_GT(report.farthest_place.cwiseAbs().maxCoeff(), 9.99e-3);
}

TEST(BoneThickness, BoneThatStandsOutCountsAsTheLeast) {
  const Mesh cartilage = test::sheet(10e-3, 20);
  BoneReport report;
  // From 3.05 mm under the cartilage to 0.95 mm over it.
  const auto field = measure_thickness(cartilage, bone_of(moved(test::sheet(12e-3, 7), {0, 0, -1.05e-3}, 0.2)), report);
  ASSERT_TRUE(field);
  EXPECT_EQ(report.without, 0);
  EXPECT_EQ(report.thin, 21 * 8);  // x >= 3 mm: 1.05 - 0.2 x < 0.5
  EXPECT_NEAR(report.thinnest, -0.95e-3, 1e-15);
  EXPECT_NEAR(report.thinnest_place[0], 10e-3, 1e-12);
  EXPECT_DOUBLE_EQ(field->least(), 0.5e-3);
}

TEST(BoneThickness, NoBoneNoField) {
  BoneReport report;
  EXPECT_FALSE(measure_thickness(test::sheet(10e-3, 4), bone_of(moved(test::sheet(10e-3, 4), {0, 0, -0.02})), report));
  EXPECT_EQ(report.without, report.vertices);
}

TEST(BoneThickness, PieceWithoutAnyBoneIsTheLeast) {
  Mesh cartilage = test::sheet(5e-3, 5);
  const Mesh other = moved(cartilage, {0.05, 0, 0});
  const int first = static_cast<int>(cartilage.vertices.size());
  cartilage.vertices.insert(cartilage.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) cartilage.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  BoneReport report;
  const auto field = measure_thickness(cartilage, bone_of(moved(test::sheet(6e-3, 5), {0, 0, -2e-3})), report);
  ASSERT_TRUE(field);
  EXPECT_EQ(report.without, first);
  EXPECT_TRUE(std::isinf(report.farthest));
  EXPECT_DOUBLE_EQ(field->at_vertex(first), 0.5e-3);
  EXPECT_DOUBLE_EQ(field->at_vertex(0), 2e-3);
}

}  // namespace
}  // namespace genu
