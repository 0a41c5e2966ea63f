// Dirt of every kind at a known place: it is found there, nothing else is, and the rest of the mesh stays as it was.
#include "genu/mesh_care/mesh_flaws.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "support/blend_meshes.h"
#include "support/dirt.h"

namespace genu {
namespace {

using test::Dirt;
using Kind = Flaw::Kind;

const Vec3 kDirtyPlace(20e-3, 0, 0);

Mesh irregular_torus() { return test::jittered_torus(15e-3, 5e-3, 0.8e-3); }
Mesh shallow_bowl() {
  return test::jittered_patch(0.015, 1e-3, [](double x, double y) { return 5 * (x * x + y * y); });
}

std::size_t count(const std::vector<Flaw>& flaws, Kind kind) {
  return static_cast<std::size_t>(
      std::count_if(flaws.begin(), flaws.end(), [&](const Flaw& f) { return f.kind == kind; }));
}

TEST(MeshFlaws, NoneInCleanMeshes) {
  for (const Mesh& clean : {irregular_torus(), shallow_bowl(), test::noisy_sphere(10e-3, 3, 0.05e-3), Mesh{}}) {
    Mesh mesh = clean;
    EXPECT_TRUE(cut_out_flaws(mesh).empty());
    EXPECT_EQ(mesh.triangles, clean.triangles);
  }
  Mesh cube = test::noisy_sphere(1, 0, 0);  // coarse is not dirty
  EXPECT_TRUE(cut_out_flaws(cube).empty());
}

TEST(MeshFlaws, DirtIsFoundWhereItIsAndNowhereElse) {
  const std::pair<Dirt, Kind> cases[] = {{Dirt::fin, Kind::non_manifold},
                                         {Dirt::hole, Kind::hole},
                                         {Dirt::crossing, Kind::crossing},
                                         {Dirt::stray, Kind::stray_piece},
                                         {Dirt::spike, Kind::spike}};
  for (const auto& [dirt, kind] : cases) {
    Mesh mesh = test::dirtied(irregular_torus(), dirt, kDirtyPlace, 2e-3);
    const std::vector<Flaw> flaws = cut_out_flaws(mesh);
    EXPECT_GE(count(flaws, kind), 1u) << test::name_of(dirt);
    for (const Flaw& f : flaws) {
      EXPECT_LT((f.centre - kDirtyPlace).norm(), 3e-3) << test::name_of(dirt) << ": " << describe(f, 1e-3);
      EXPECT_LT(f.radius, 4e-3) << test::name_of(dirt);
      EXPECT_FALSE(f.points.empty());
    }
    // What is left is a surface with one hole there, of vertices that were there before.
    const MeshReport report = check_mesh(mesh);
    EXPECT_EQ(report.non_manifold_edges, 0u) << test::name_of(dirt);
    EXPECT_EQ(report.components, 1) << test::name_of(dirt);
    EXPECT_GT(report.triangles, irregular_torus().triangles.size() * 9 / 10) << test::name_of(dirt);
    EXPECT_TRUE(cut_out_flaws(mesh).size() <= 1) << "once cut out, holes alone are left";
  }
  for (const Dirt harmless : {Dirt::slivers, Dirt::flipped}) {
    Mesh mesh = test::dirtied(irregular_torus(), harmless, kDirtyPlace, 2e-3);
    make_winding_consistent(mesh, mesh_edges(mesh));
    EXPECT_TRUE(cut_out_flaws(mesh).empty()) << test::name_of(harmless);
  }
}

TEST(MeshFlaws, BordersAreNoHoles) {
  Mesh open = shallow_bowl();
  EXPECT_TRUE(cut_out_flaws(open).empty());
  Mesh holed = test::dirtied(shallow_bowl(), Dirt::hole, Vec3::Zero(), 2e-3);
  const std::vector<Flaw> flaws = cut_out_flaws(holed);
  ASSERT_EQ(flaws.size(), 1u);
  EXPECT_EQ(flaws[0].kind, Kind::hole);
  EXPECT_LT(flaws[0].centre.norm(), 1e-3);
  // A bone cut off at its shaft: the end of a tube.
  Mesh tube = test::noisy_sphere(10e-3, 4, 0);
  for (Vec3& v : tube.vertices)
    if (v.z() > 0) v.z() *= 8, v.x() /= 1 + v.z() / 40e-3, v.y() /= 1 + v.z() / 40e-3;
  std::erase_if(tube.triangles,
                [&](const auto& t) { return tube.vertices[static_cast<std::size_t>(t[0])].z() > 50e-3; });
  const std::vector<FreeLoop> loops = free_loops(tube);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(loops[0].border);
}

TEST(MeshFlaws, WhatLiesInsideAnotherPieceIsLeftOut) {
  const Mesh inner = test::noisy_sphere(5e-3, 3, 0), outer = test::noisy_sphere(10e-3, 3, 0);
  Mesh turned = inner;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  for (const Mesh& part : {inner, turned}) {
    Mesh mesh = test::joined(part, outer);
    const std::vector<Flaw> flaws = cut_out_flaws(mesh);
    ASSERT_EQ(flaws.size(), 1u);
    EXPECT_EQ(flaws[0].kind, Kind::inner_piece);
    EXPECT_EQ(mesh.triangles.size(), outer.triangles.size());
  }
  Mesh beside = test::joined(outer, test::moved(inner, {Mat3::Identity(), Vec3(20e-3, 0, 0)}));
  EXPECT_TRUE(cut_out_flaws(beside).empty()) << "two bones of one file";
}

TEST(MeshFlaws, AMoebiusStripIsCutWhereNoWindingAgrees) {
  Mesh strip;
  constexpr int kAround = 60;
  for (int i = 0; i < kAround; ++i) {
    const double a = test::kTwoPi * i / kAround;
    for (int k = -1; k <= 1; ++k) {
      const double s = 3e-3 * k;
      strip.vertices.emplace_back((0.02 + s * std::cos(a / 2)) * std::cos(a),
                                  (0.02 + s * std::cos(a / 2)) * std::sin(a), s * std::sin(a / 2));
    }
  }
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < 2; ++k) {
      const bool last = i + 1 == kAround;
      const auto next = [&](int row) { return last ? 2 - row : 3 * (i + 1) + row; };
      strip.triangles.push_back({3 * i + k, next(k), next(k + 1)});
      strip.triangles.push_back({3 * i + k, next(k + 1), 3 * i + k + 1});
    }
  make_winding_consistent(strip, mesh_edges(strip));
  const std::vector<Flaw> flaws = cut_out_flaws(strip);
  EXPECT_EQ(count(flaws, Kind::unorientable), 1u);
  EXPECT_TRUE(make_winding_consistent(strip, mesh_edges(strip)).orientable);
}

TEST(MeshFlaws, PlacesAreToldInTheFilesUnit) {
  Flaw flaw;
  flaw.kind = Kind::hole;
  flaw.count = 7;
  flaw.centre = {0.0123, -0.004, 0.5};
  flaw.radius = 0.0015;
  EXPECT_EQ(describe(flaw, 1e-3), "a hole of 7 free edges, 3 mm across, near (12.3, -4, 500) mm");
  EXPECT_EQ(describe(flaw, 1), "a hole of 7 free edges, 0.003 m across, near (0.0123, -0.004, 0.5) m");
}

}  // namespace
}  // namespace genu
