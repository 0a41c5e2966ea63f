// Mended meshes are clean, closed where they were, near to what was there, and no vertex that stays has moved.
#include "genu/mesh_care/mesh_repair.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh/mesh_weld.h"
#include "genu/mesh_care/mesh_crossings.h"
#include "genu/mesh_care/mesh_flaws.h"
#include "support/blend_meshes.h"
#include "support/dirt.h"

namespace genu {
namespace {

using test::Dirt;

double off_torus(const Vec3& p) {
  const double round = std::hypot(p.x(), p.y()) - 15e-3;
  return std::abs(std::hypot(round, p.z()) - 5e-3);
}

TEST(MeshRepair, WithoutCgalSaysSo) {
  Mesh mesh = test::noisy_sphere(10e-3, 2, 0);
  EXPECT_EQ(repair_mesh(mesh).problem.empty(), built_with_cgal());
}

TEST(MeshRepair, MendsEveryKindOfDirtWithoutMovingWhatIsGood) {
  if (!built_with_cgal()) GTEST_SKIP() << "built without CGAL";
  const Mesh clean = test::jittered_torus(15e-3, 5e-3, 0.8e-3);
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  double worst = 0;
  for (const Dirt dirt :
       {Dirt::fin, Dirt::flipped, Dirt::duplicate, Dirt::hole, Dirt::crossing, Dirt::stray, Dirt::spike}) {
    Mesh mesh = test::dirtied(clean, dirt, {20e-3, 0, 0}, 2e-3);
    weld(mesh, weld_tolerance(mesh));
    std::set<Vec3, decltype(before)> known(before);
    for (const Vec3& v : mesh.vertices) known.insert(v);
    const RepairReport r = repair_mesh(mesh);
    ASSERT_EQ(r.problem, "") << test::name_of(dirt);
    const MeshReport report = check_mesh(mesh);
    EXPECT_EQ(report.boundary_edges, 0u) << test::name_of(dirt);
    EXPECT_EQ(report.non_manifold_edges, 0u) << test::name_of(dirt);
    EXPECT_EQ(report.flipped, 0u) << test::name_of(dirt);
    EXPECT_EQ(report.components, 1) << test::name_of(dirt);
    EXPECT_TRUE(crossing_triangles(mesh).empty()) << test::name_of(dirt);
    Mesh again = mesh;
    EXPECT_TRUE(cut_out_flaws(again).empty()) << test::name_of(dirt);
    std::size_t fresh = 0;
    for (const Vec3& v : mesh.vertices) {
      fresh += known.count(v) == 0;
      worst = std::max(worst, off_torus(v));
    }
    EXPECT_LE(fresh, r.new_triangles) << test::name_of(dirt) << ": vertices that were not there";
    EXPECT_EQ(r.filled > 0, fresh + r.new_triangles > 0) << test::name_of(dirt);
  }
  std::printf("worst distance of a mended mesh's vertex to the torus: %.3g mm\n", 1e3 * worst);
  EXPECT_LT(worst, 0.2e-3) << "fillings lie near the surface";
}

TEST(MeshRepair, BordersStayOpenAndInsideOutIsTurned) {
  if (!built_with_cgal()) GTEST_SKIP() << "built without CGAL";
  Mesh sheet = test::dirtied(test::jittered_patch(0.015, 1e-3, [](double x, double y) { return 5 * (x * x + y * y); }),
                             Dirt::hole, Vec3::Zero(), 2e-3);
  EXPECT_EQ(repair_mesh(sheet).filled, 1u);
  EXPECT_EQ(check_mesh(sheet).boundary_loops, 1u);
  Mesh turned = test::noisy_sphere(10e-3, 3, 0);
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(repair_mesh(turned).turned, turned.triangles.size());
  EXPECT_EQ(turned.triangles.size(), test::noisy_sphere(10e-3, 3, 0).triangles.size());
}

TEST(MeshRepair, WhatIsNothingButDirtIsRefused) {
  if (!built_with_cgal()) GTEST_SKIP() << "built without CGAL";
  Mesh fins{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  EXPECT_NE(repair_mesh(fins).problem, "");
  EXPECT_EQ(fins.triangles.size(), 3u) << "left as it is";
}

}  // namespace
}  // namespace genu
