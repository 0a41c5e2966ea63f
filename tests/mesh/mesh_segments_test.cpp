// Rings and horseshoes cut across: closed pieces whose volumes add up, equal lengths, and sections in closed form.
#include "genu/mesh/mesh_segments.h"

#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "genu/core/pose.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh/solid_inertia.h"

namespace genu {
namespace {

constexpr double kR = 0.02, kA = 0.005, kB = 0.003;  // m: a ring of elliptic section

Vec3 unit_normal(const Mesh& mesh, const std::array<int, 3>& t) {
  const Vec3 &a = mesh.vertices[at(t[0])], &b = mesh.vertices[at(t[1])], &c = mesh.vertices[at(t[2])];
  return (b - a).cross(c - a).normalized();
}

/// From angle 0 to `turn`, closed by flat ends below a whole turn.
Mesh bent_rod(double turn, int around, int along, const Pose& place) {
  Mesh out;
  const bool ring = turn > 2 * M_PI - 1e-9;
  const int rows = ring ? along : along + 1;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < around; ++k) {
      const double t = turn * i / along, s = 2 * M_PI * k / around;
      const double r = kR + kA * std::cos(s);
      out.vertices.push_back(place * Vec3(r * std::cos(t), r * std::sin(t), kB * std::sin(s)));
    }
  const auto vertex = [&](int i, int k) { return (i % rows) * around + k % around; };
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < around; ++k) {
      out.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
      out.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
    }
  for (int k = 1; !ring && k + 1 < around; ++k) {
    out.triangles.push_back({vertex(0, 0), vertex(0, k), vertex(0, k + 1)});
    out.triangles.push_back({vertex(along, 0), vertex(along, k + 1), vertex(along, k)});
  }
  return out;
}

const Pose kTilted{exp_rotation(Vec3(0.3, -0.2, 0.5)), Vec3(0.01, -0.02, 0.03)};

double open_edges(const Mesh& mesh) {
  double out = 0;
  for (const MeshEdge& e : mesh_edges(mesh)) out += e.count == 2 ? 0 : 1;
  return out;
}

void expect_partition(const Mesh& whole, const MeshSegments& cut, std::size_t pieces, std::size_t sections) {
  ASSERT_EQ(cut.problem, "");
  ASSERT_EQ(cut.pieces.size(), pieces);
  ASSERT_EQ(cut.sections.size(), sections);
  double volume = 0;
  Vec3 moment = Vec3::Zero();
  for (const MeshPiece& p : cut.pieces) {
    EXPECT_EQ(open_edges(p.mesh), 0);
    EXPECT_NEAR(solid_inertia(p.mesh).volume, p.volume, 1e-15);
    volume += p.volume;
    moment += p.volume * p.centroid;
    EXPECT_FALSE(p.above.empty());
    EXPECT_FALSE(p.below.empty());
  }
  const SolidInertia solid = solid_inertia(whole);
  EXPECT_NEAR(volume / solid.volume, 1, 1e-3) << "vertices near a cut are moved onto it";
  EXPECT_LT((moment / volume - solid.centroid).norm(), 1e-5);
}

TEST(MeshSegments, AHorseshoeHasEqualPiecesAndTheSectionsOfItsFormula) {
  const double turn = 1.5 * M_PI;
  const Mesh whole = bent_rod(turn, 60, 150, kTilted);
  const MeshSegments cut = segment_mesh(whole, 9);
  expect_partition(whole, cut, 9, 8);
  EXPECT_FALSE(cut.ring);
  EXPECT_GT(std::abs(cut.axis.dot(kTilted.R.col(2))), 1 - 1e-9);
  for (const MeshPiece& p : cut.pieces) {
    EXPECT_NEAR(p.length * 9 / (kR * turn), 1, 0.02);
    EXPECT_NEAR(p.volume * 9 / solid_inertia(whole).volume, 1, 0.03);
  }
  for (const MeshSection& s : cut.sections) {
    EXPECT_NEAR(s.area / (M_PI * kA * kB), 1, 5e-3);
    EXPECT_NEAR(s.about_y / (M_PI * kA * kB * kB * kB / 4), 1, 1e-2);
    EXPECT_NEAR(s.about_z / (M_PI * kB * kA * kA * kA / 4), 1, 1e-2);
    const Vec3 centre = kTilted.inverse() * s.centre;
    EXPECT_NEAR(centre.head<2>().norm(), kR, 2e-4);
    EXPECT_NEAR(centre.z(), 0, 1e-6);
    EXPECT_NEAR(std::abs(s.z.dot(kTilted.R.col(2))), 1, 1e-3);
    EXPECT_LT((s.tangent.cross(s.y) - s.z).norm(), 1e-12);
  }
}

TEST(MeshSegments, ARingHasASectionBehindEachPiece) {
  const Mesh whole = bent_rod(2 * M_PI, 40, 120, kTilted);
  const MeshSegments cut = segment_mesh(whole, 8);
  expect_partition(whole, cut, 8, 8);
  EXPECT_TRUE(cut.ring);
  for (const MeshPiece& p : cut.pieces) EXPECT_NEAR(p.volume * 8 / solid_inertia(whole).volume, 1, 0.01);
}

TEST(MeshSegments, SidesFaceAlongTheAxisAndAgainstIt) {
  const MeshSegments cut = segment_mesh(bent_rod(1.4 * M_PI, 40, 100, {}), 6);
  ASSERT_EQ(cut.problem, "");
  EXPECT_GT(cut.axis.z(), 0.999);
  for (std::size_t k = 1; k + 1 < cut.pieces.size(); ++k) {  // the ends' flat faces belong to either side
    const MeshPiece& p = cut.pieces[k];
    EXPECT_EQ(connected_components(p.above).count, 1);
    EXPECT_EQ(connected_components(p.below).count, 1);
    for (const Vec3& v : p.above.vertices) EXPECT_GT(v.z(), -1e-4);
    for (const Vec3& v : p.below.vertices) EXPECT_LT(v.z(), 1e-4);
    for (const auto& [side, sign] : {std::pair(&p.above, 1.0), std::pair(&p.below, -1.0)})
      for (const auto& t : side->triangles) EXPECT_GT(sign * unit_normal(*side, t).z(), 0.5);  // the wall is of neither
  }
}

TEST(MeshSegments, ADentInASideIsNoHole) {
  Mesh dented = bent_rod(1.4 * M_PI, 40, 100, {});
  for (std::size_t row = 5; row < 100; row += 10) {
    Vec3& top = dented.vertices[40 * row + 10];
    ASSERT_NEAR(top.z(), kB, 1e-12);
    top.z() -= 0.8 * kB;
  }
  const MeshSegments cut = segment_mesh(dented, 6);
  ASSERT_EQ(cut.problem, "");
  for (std::size_t k = 1; k + 1 < cut.pieces.size(); ++k)
    EXPECT_EQ(boundary_loops(cut.pieces[k].above, mesh_edges(cut.pieces[k].above)).size(), 1u) << "piece " << k;
}

TEST(MeshSegments, SaysWhyThereAreNoPieces) {
  Mesh open = bent_rod(M_PI, 20, 40, {});
  open.triangles.pop_back();
  EXPECT_EQ(segment_mesh(open, 5).problem, "is not closed");
  Mesh inside_out = bent_rod(M_PI, 20, 40, {});
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(segment_mesh(inside_out, 5).problem, "has no volume, or is inside out");
  Mesh box;
  for (int k = 0; k < 8; ++k) box.vertices.emplace_back(0.03 * (k & 1), 0.02 * (k >> 1 & 1), 0.01 * (k >> 2));
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_EQ(segment_mesh(box, 5).problem, "does not run round a middle: an axis through the middle meets it");
}

}  // namespace
}  // namespace genu
