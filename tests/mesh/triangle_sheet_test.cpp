// What a sheet says of a ray is what all triangles say, on meshes good and bad, and it says something of most rays.
#include "genu/mesh/triangle_sheet.h"

#include <gtest/gtest.h>

#include "genu/core/pose.h"
#include "genu/mesh/sheet_atlas.h"
#include "support/layers.h"
#include "support/random_points.h"

namespace genu {
namespace {

constexpr double kLength = 6e-3;

;

Mesh together(Mesh a, const Mesh& b) {
  const int n = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

Mesh turned_round(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A flight of spiral stairs without steps: `turns` floors over one another in one piece, wide and low.
Mesh spiral(double turns) {
  constexpr int kRound = 40, kWide = 12;
  Mesh mesh;
  const int n = static_cast<int>(turns * kRound);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= kWide; ++j) {
      const double angle = 2 * M_PI * i / kRound, r = 0.2e-3 + 10e-3 * j / kWide;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), 1.5e-3 * i / kRound);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < kWide; ++j) {
      const int a = i * (kWide + 1) + j, b = a + 1, c = a + kWide + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// The surface that covers the disc twice round its middle.
Mesh wound_twice() {
  constexpr int kRound = 24, kRings = 10;
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, 0);
  for (int r = 1; r <= kRings; ++r)
    for (int i = 0; i < 2 * kRound; ++i) {
      const double angle = 2 * M_PI * i / kRound, radius = 1e-3 * r;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                 0.2 * radius * std::sin(0.5 * angle));
    }
  const auto at_ring = [](int r, int i) { return 1 + (r - 1) * 2 * kRound + (i + 2 * kRound) % (2 * kRound); };
  for (int i = 0; i < 2 * kRound; ++i) mesh.triangles.push_back({0, at_ring(1, i), at_ring(1, i + 1)});
  for (int r = 1; r < kRings; ++r)
    for (int i = 0; i < 2 * kRound; ++i) {
      mesh.triangles.push_back({at_ring(r, i), at_ring(r + 1, i), at_ring(r + 1, i + 1)});
      mesh.triangles.push_back({at_ring(r, i), at_ring(r + 1, i + 1), at_ring(r, i + 1)});
    }
  return mesh;
}

struct Seen {
  int asked = 0, sure = 0, hits = 0, alone = 0, moved = 0;
};

/// Rays that begin near the mesh, out of it more or less, each asked of the sheet there; whatever is sure is compared.
Seen compare(const Mesh& mesh, int rays) {
  test::RandomPoints random(7);
  const auto tree = std::make_shared<const TriangleTree>(mesh);
  const SheetAtlas atlas(tree, kLength);
  Seen seen;
  for (int k = 0; k < rays; ++k) {
    const int triangle = static_cast<int>(random.uniform(0, 0.999999) * static_cast<double>(mesh.triangles.size()));
    const auto& c = tree->corners(triangle);
    const Vec3& area = tree->area_vector(triangle);
    if (!(area.norm() > 0)) continue;
    const Vec3 n = area.normalized(), direction = (n + random.in_ball(0.7)).normalized();
    const Vec3 origin = (c[0] + c[1] + c[2]) / 3 - random.uniform(-3e-3, 3e-3) * n + random.in_ball(0.5e-3);
    const TriangleSheet& sheet = atlas.sheet(atlas.piece_of(tree->place_of(triangle)));
    if (!sheet.good()) continue;
    ++seen.asked;
    int facet = 0;
    const auto found = sheet.meet(*tree, origin, direction, kLength, facet);
    if (!found.sure) continue;
    ++seen.sure;
    const TriangleTree::Hit expected = tree->leaving(origin, direction, kLength);
    EXPECT_EQ(found.hit.triangle, expected.triangle) << "ray " << k;
    EXPECT_EQ(found.hit.distance, expected.distance) << "ray " << k;
    seen.hits += expected ? 1 : 0;
    if (found.hit && found.alone) {
      EXPECT_FALSE(tree->entering(origin, direction, expected.distance)) << "ray " << k;
    }
    seen.alone += found.hit && found.alone ? 1 : 0;
    // Once more from where the walk ended.
    EXPECT_EQ(sheet.meet(*tree, origin, direction, kLength, facet).hit.triangle, expected.triangle) << "ray " << k;
    for (int i = 0; i < 4 && found.clear > 0; ++i, ++seen.moved) {
      const Vec3 start = origin + random.in_ball(0.999 * found.clear),
                 end = origin + kLength * direction + random.in_ball(0.999 * found.clear);
      EXPECT_FALSE(tree->leaving(start, (end - start).normalized(), 0.99 * kLength)) << "ray " << k << " move " << i;
    }
  }
  return seen;
}

TEST(TriangleSheet, TellsWhatAllTrianglesTell) {
  const Mesh ball = test::ball(0.02, 1.2e-3);
  Mesh rough = ball;
  test::RandomPoints random(7);
  for (Vec3& v : rough.vertices) v += random.in_ball(0.25e-3);
  // A shell with an inner side: what cartilage looks like.
  const Mesh shell = together(ball, turned_round(test::ball(0.0175, 1.2e-3)));
  Mesh saddle = test::sheet(0.02, 40);
  for (Vec3& v : saddle.vertices) v.z() = (v.x() * v.x() - v.y() * v.y()) / 0.06;
  int number = 0;
  for (const Mesh& mesh : {ball, rough, shell, saddle, moved(shell, {3, -2, 1})}) {
    const Seen seen = compare(mesh, 20000);
    std::printf("mesh %d: %d rays, %d sure, %d hits, %d alone, %d moved\n", number, seen.asked, seen.sure, seen.hits,
                seen.alone, seen.moved);
    // Too rough or too near an edge to be sure of is little of these.
    EXPECT_GT(seen.asked, 7000) << number;
    EXPECT_GT(seen.sure, 0.6 * seen.asked) << number;
    EXPECT_GT(seen.hits, 0.2 * seen.asked) << number;
    EXPECT_GT(seen.moved, 0.4 * seen.asked) << number;
    ++number;
  }
}

TEST(TriangleSheet, IsNeverWrongOnMeshesThatAreNoGraphs) {
  const Mesh ball = test::ball(0.02, 1.2e-3);
  Mesh holes = ball;
  for (std::size_t k = 0; k < holes.triangles.size(); k += 37)
    std::swap(holes.triangles[k], holes.triangles.back()), holes.triangles.pop_back();
  Mesh flipped = ball;
  for (std::size_t k = 0; k < flipped.triangles.size(); k += 91)
    std::swap(flipped.triangles[k][0], flipped.triangles[k][1]);
  Mesh twice = ball;
  for (std::size_t k = 0; k < ball.triangles.size(); k += 53) twice.triangles.push_back(ball.triangles[k]);
  Mesh crumpled = ball;
  test::RandomPoints random(7);
  for (Vec3& v : crumpled.vertices) v += random.in_ball(1.5e-3);
  Mesh squeezed = ball;
  for (Vec3& v : squeezed.vertices) v.z() *= 0.03;
  Mesh slivers = ball;
  for (std::size_t k = 0; k < slivers.triangles.size(); k += 11)
    slivers.triangles.push_back({slivers.triangles[k][0], slivers.triangles[k][1], slivers.triangles[k][1]});
  for (const Mesh& mesh :
       {together(ball, moved(ball, {0.3e-3, 0, 0})), together(ball, test::ball(0.019, 1e-3)), holes, flipped, twice,
        crumpled, squeezed, slivers, spiral(4), together(spiral(3), spiral(3)), wound_twice()})
    compare(mesh, 6000);
}

TEST(TriangleSheet, ThroughAnEdgeExactlyNothingIsSure) {
  const Mesh mesh = test::sheet(0.016, 16);  // edges at whole millimetres
  const auto tree = std::make_shared<const TriangleTree>(mesh);
  const SheetAtlas atlas(tree, kLength);
  int good = 0;
  for (int piece = 0; piece < atlas.pieces(); ++piece) {
    const TriangleSheet& sheet = atlas.sheet(piece);
    if (!sheet.good()) continue;
    ++good;
    for (const Vec3& v : mesh.vertices) {
      int facet = 0;
      EXPECT_FALSE(sheet.meet(*tree, v - 1e-3 * Vec3::UnitZ(), Vec3::UnitZ(), kLength, facet).sure);
    }
  }
  EXPECT_GT(good, 0);
}

}  // namespace
}  // namespace genu
