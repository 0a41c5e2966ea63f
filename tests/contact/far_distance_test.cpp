// The signed distance far from a surface, against every triangle one by one.
#include "genu/contact/far_distance.h"

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"
#include "genu/mesh/nearest_point.h"
#include "genu/surface/facet_surface.h"
#include "support/brute_force.h"
#include "support/mesh_parts.h"
#include "support/sheet_mesh.h"

namespace genu {
namespace {

using test::bent_sheet;

FacetSurface facets_of(const Surface& surface, double edge) {
  return FacetSurface(surface.triangles(edge, Vec3::Zero(), 0.03));
}

/// Distance, sign and direction at random points within `reach` (m) of the origin.
void expect_brute_force(const FacetSurface& facets, double reach, int points) {
  const FarDistance far(facets);
  const Mesh mesh = facets.triangles(0, Vec3::Zero(), 0);
  std::mt19937 random(6);
  double worst = 0;
  int inside = 0;
  for (int i = 0; i < points; ++i) {
    const Vec3 x = test::random_vector(random, reach);
    const Vec3 foot = nearest_on_mesh(mesh, x);
    const double winding = test::winding_number(mesh, x);
    ASSERT_LT(std::abs(winding - std::round(winding)), 1e-9);
    const double exact = (winding > 0.5 ? -1 : 1) * (x - foot).norm();
    inside += exact < 0 ? 1 : 0;
    const FarDistance::Nearest found = far.nearest(x);
    worst = std::max(worst, std::abs(found.distance - exact));
    ASSERT_NEAR(found.distance, exact, 1e-8) << "at " << x.transpose();
    EXPECT_FALSE(found.beyond_edge);
    EXPECT_NEAR(found.direction.norm(), 1, 1e-12);
    // Where two feet are equally near, either direction is right: walking along it changes the distance by as much.
    const Vec3 on = x - found.distance * found.direction;
    EXPECT_LT((nearest_on_mesh(mesh, on) - on).norm(), 1e-8);
  }
  EXPECT_GT(inside, points / 50);
  EXPECT_LT(inside, points - points / 50);
  EXPECT_LT(worst, 1e-8);
}

TEST(FarDistance, ClosedSphereMesh) { expect_brute_force(facets_of(*make_sphere({}, 0.02, false), 4e-3), 0.03, 400); }

TEST(FarDistance, ClosedTorusMesh) {
  expect_brute_force(facets_of(*make_torus({}, 0.015, 0.005, false), 2.5e-3), 0.025, 600);
}

TEST(FarDistance, TurnedInsideOutTheSignTurns) {
  const FacetSurface out = facets_of(*make_torus({}, 0.015, 0.005, false), 2.5e-3);
  const FacetSurface in = facets_of(*make_torus({}, 0.015, 0.005, true), 2.5e-3);
  const FarDistance far_out(out), far_in(in);
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = test::random_vector(random, 0.025);
    EXPECT_NEAR(far_out.nearest(x).distance, -far_in.nearest(x).distance, 1e-8);
  }
}

TEST(FarDistance, FineSphereMeshApproachesTheSphere) {
  const auto sphere = make_sphere({}, 0.02, false);
  const double edge = 1e-3;
  const FacetSurface mesh = facets_of(*sphere, edge);
  const FarDistance far(mesh);
  std::mt19937 random(12);
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = test::random_vector(random, 0.04);
    EXPECT_NEAR(far.nearest(x).distance, *sphere->gap(x), edge * edge / (2 * 0.02));
  }
}

TEST(FarDistance, OverAndUnderAnOpenSheetAndBeyondItsEdge) {
  const double half = 0.01;
  const Mesh mesh = bent_sheet(6, [&](double u, double v) { return Vec3(half * u, half * v, 0); });
  const FacetSurface facets(mesh);
  const FarDistance far(facets);
  std::mt19937 random(1);
  int beyond = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = test::random_vector(random, 0.02);
    const FarDistance::Nearest found = far.nearest(x);
    const bool over = std::abs(x.x()) < half && std::abs(x.y()) < half;
    EXPECT_EQ(found.beyond_edge, !over) << x.transpose();
    const double unsigned_distance = (x - nearest_on_mesh(mesh, x)).norm();
    EXPECT_NEAR(found.distance, over ? x.z() : unsigned_distance, 1e-8) << x.transpose();
    EXPECT_TRUE(!over || (found.direction - Vec3::UnitZ()).norm() < 1e-6) << x.transpose();
    beyond += over ? 0 : 1;
  }
  EXPECT_GT(beyond, 100);
  EXPECT_LT(beyond, 450);
}

/// From random points outside, as far as their side is said to be known: none gets inside. (Not of sheets that look at
/// the backs of others: halfway between, a point changes from the front of one to the back of the other.)
void expect_sides_kept(const std::string& name, const Mesh& mesh) {
  SCOPED_TRACE(name);
  const FacetSurface facets(mesh);
  const FarDistance far(facets);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  int asked = 0, lost = 0;
  double longest = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = test::random_vector(random, i % 2 == 0 ? 0.03 : 0.012);
    const FarDistance::Nearest here = far.nearest(x);
    const double way = std::min(here.same_side, 0.999 * here.distance);
    if (!(here.distance > 1e-3) || !(way > 0)) continue;
    const Vec3 away = test::random_vector(random, 1).normalized();
    const double go = (i % 3 == 0 ? share(random) : 0.999) * way;
    ++asked;
    lost += far.nearest(x + go * away).distance < 0 ? 1 : 0;
    longest = std::max(longest, here.same_side / here.distance);
  }
  EXPECT_GT(asked, 2000);
  EXPECT_EQ(lost, 0) << "of " << asked;
  EXPECT_GT(longest, 0.2) << "of the distance: it would be asked at every pose";
}

TEST(FarDistance, APointKeepsItsSideForAsFarAsIsSaid) {
  const Mesh flat = bent_sheet(8, [](double u, double v) { return Vec3(0.01 * u, 0.01 * v, 0); });
  const Mesh strip = bent_sheet(12, [](double u, double v) { return Vec3(0.015 * u, 0.003 * v, 0); });
  const Mesh cap = bent_sheet(10, [](double u, double v) { return Vec3(0.01 * Vec3(u, v, 0.5).normalized()); });
  const Mesh saddle =
      bent_sheet(10, [](double u, double v) { return Vec3(0.01 * u, 0.01 * v, 0.004 * (u * u - v * v)); });
  const Mesh gutter = bent_sheet(
      12, [](double u, double v) { return Vec3(0.01 * std::sin(2.5 * u), 0.015 * v, 0.01 * std::cos(2.5 * u)); });
  Mesh over = flat;
  for (Vec3& v : over.vertices) v.z() += 0.008;
  expect_sides_kept("flat", flat);
  expect_sides_kept("two triangles", bent_sheet(1, [](double u, double v) { return Vec3(0.01 * u, 0.01 * v, 0); }));
  expect_sides_kept("strip", strip);
  expect_sides_kept("cap", cap);
  expect_sides_kept("cup", test::turned(cap));
  expect_sides_kept("saddle", saddle);
  expect_sides_kept("gutter", gutter);
  expect_sides_kept("tunnel", test::turned(gutter));
  expect_sides_kept("face to face", test::joined(flat, test::turned(over)));
}

/// The side of random points, told by the mesh without what makes it hard.
void expect_side_of(const FacetSurface& facets, const Surface& exact, double reach) {
  const FarDistance far(facets);
  std::mt19937 random(3);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x = test::random_vector(random, reach);
    const auto gap = exact.gap(x);
    if (!gap || std::abs(*gap) < 1e-3) continue;
    EXPECT_EQ(far.nearest(x).distance < 0, *gap < 0) << x.transpose();
    inside += *gap < 0;
  }
  EXPECT_GT(inside, 20);
}

TEST(FarDistance, AHoleDoesNotLetTheInsideOut) {
  const auto torus = make_torus({}, 0.015, 0.005, false);
  Mesh mesh = torus->triangles(1e-3, Vec3::Zero(), 1);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return (mesh.vertices[static_cast<std::size_t>(t[0])] - Vec3(0.02, 0, 0)).norm() < 3e-3;
  });
  expect_side_of(FacetSurface(mesh), *torus, 0.025);
}

TEST(FarDistance, APieceInsideAnotherDoesNotLetTheInsideOut) {
  const auto ball = make_sphere({}, 0.02, false), debris = make_sphere({Mat3::Identity(), {0.005, 0, 0}}, 0.006, false);
  Mesh mesh = ball->triangles(2e-3, Vec3::Zero(), 1);
  const Mesh more = debris->triangles(1e-3, Vec3::Zero(), 1);
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [i, j, k] : more.triangles) mesh.triangles.push_back({i + first, j + first, k + first});
  expect_side_of(FacetSurface(mesh), *ball, 0.03);
}

TEST(FarDistance, TrianglesWithoutAreaSayNothing) {
  const auto ball = make_sphere({}, 0.02, false);
  Mesh mesh = ball->triangles(2e-3, Vec3::Zero(), 1);
  const std::size_t whole = mesh.triangles.size();
  for (std::size_t t = 0; t < whole; t += 3) {
    const auto c = mesh.triangles[t];
    const int middle = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(
        Vec3(0.5 * (mesh.vertices[static_cast<std::size_t>(c[0])] + mesh.vertices[static_cast<std::size_t>(c[1])])));
    mesh.triangles.push_back({c[0], middle, c[1]});
    mesh.triangles.push_back({c[0], c[1], c[1]});
  }
  expect_side_of(FacetSurface(mesh), *ball, 0.03);
}

TEST(FarDistance, SurfacesThatKnowTheirDistanceAnswerThemselves) {
  std::mt19937 random(10);
  for (const auto& s : test::some_surfaces()) {
    if (!s.surface->knows_distance()) continue;
    const FarDistance far(*s.surface);
    for (int i = 0; i < 20; ++i) {
      const Vec3 x = test::random_vector(random, 0.04);
      SurfacePoint foot;
      if (!s.surface->project(x, foot)) continue;
      EXPECT_EQ(far.nearest(x).distance, *s.surface->gap(x)) << s.name;
      EXPECT_EQ(far.nearest(x).direction, foot.n) << s.name;
      EXPECT_FALSE(far.nearest(x).beyond_edge) << s.name;
    }
  }
}

}  // namespace
}  // namespace genu
