// Patches of surfaces with a known area, edge distances by brute force, and what a patch says past its edges.
#include "genu/surface/patch.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/surface/analytic.h"
#include "genu/surface/blend_surface.h"

namespace genu {
namespace {

constexpr double kPi = std::numbers::pi;
const Pose kPlaced{exp_rotation(Vec3(0.4, -1.1, 0.7)), Vec3(0.01, -0.02, 0.03)};
constexpr std::array<bool, 3> kBounded{}, kSheet{true, true, false}, kTube{false, false, true};

Patch patch(Patch::Range x, Patch::Range y, Patch::Range z, Patch::Range theta = {}) { return {{x, y, z}, theta}; }

struct Known {
  std::string name;
  std::unique_ptr<Surface> surface;
  double area;  ///< m^2
};

std::vector<Known> patches_of_known_area() {
  const double a = 0.02;
  std::vector<Known> out;
  const auto add = [&](const char* name, std::shared_ptr<const Surface> whole, const Patch& p,
                       const std::array<bool, 3>& endless, double area) {
    out.push_back({name, make_patch(std::move(whole), kPlaced, p, endless), area});
  };
  using R = std::pair<double, double>;
  add("rectangle", make_plane(kPlaced, false), patch(R{-a, a}, R{-0.5 * a, 2 * a}, {}), kSheet, 2 * a * 2.5 * a);
  add("quarter of a rectangle", make_plane(kPlaced, false), patch(R{-a, a}, R{-a, a}, {}, R{0, kPi / 2}), kSheet,
      a * a);
  add("three quarters of it", make_plane(kPlaced, false), patch(R{-a, a}, R{-a, a}, {}, R{0, 1.5 * kPi}), kSheet,
      3 * a * a);
  add("zone of a sphere", make_sphere(kPlaced, a, false), patch({}, {}, R{-0.8 * a, -0.1 * a}), kBounded,
      2 * kPi * a * 0.7 * a);
  add("lune of a socket", make_sphere(kPlaced, a, true), patch({}, {}, {}, R{1, 1.8}), kBounded, 2 * a * a * 0.8);
  add("part of a cylinder", make_cylinder(kPlaced, a, false), patch({}, {}, R{0, 3 * a}, R{-0.3, 0.9}), kTube,
      3 * a * 1.2 * a);
  add("sector of a torus", make_torus(kPlaced, a, 0.25 * a, false), patch({}, {}, {}, R{2, 3}), kBounded,
      2 * kPi * 0.25 * a * a);
  add("slanted polynomial", make_polynomial(kPlaced, {{1, 0, 3}}, false), patch(R{-a, a}, R{-a, a}, {}), kSheet,
      4 * a * a * std::sqrt(10.0));
  add("polynomial tube", make_cylindrical_polynomial(kPlaced, {{0, 0, a}}, false), patch({}, {}, R{-a, a}, R{-2, 0}),
      kTube, 2 * a * 2 * a);
  return out;
}

TEST(Patch, HasTheAreaItShouldAndEndsAtItsEdges) {
  for (const Known& k : patches_of_known_area()) {
    EXPECT_FALSE(k.surface->is_unbounded()) << k.name;
    // The centre and reach of the search must not matter to a patch that is bounded by itself.
    const Mesh mesh = k.surface->triangles(1e-3, Vec3(1, 1, 1), 1e-3);
    const SampleSet samples = vertex_samples(mesh);
    const double area = std::accumulate(samples.areas.begin(), samples.areas.end(), 0.0);
    EXPECT_NEAR(area / k.area, 1, 2e-3) << k.name;
    double off = 0, past = 0, far = 0;
    for (const Vec3& v : mesh.vertices) {
      SurfacePoint foot;
      ASSERT_TRUE(k.surface->project(v, foot)) << k.name;
      off = std::max(off, (foot.p - v).norm());
      past = std::max(past, -k.surface->edge_distance(v));
    }
    const std::vector<bool> border = boundary_vertices(mesh, mesh_edges(mesh));
    for (std::size_t v = 0; v < border.size(); ++v)
      if (border[v]) far = std::max(far, std::abs(k.surface->edge_distance(mesh.vertices[v])));
    EXPECT_LT(off, 1e-12) << k.name;
    EXPECT_LT(past, 1e-15) << k.name;
    // A wedge wider than half a turn has its corner cut off by one triangle at most.
    EXPECT_LT(far, k.name == "three quarters of it" ? 1e-3 : 1e-15) << k.name;
    fmt::print("  {:<32} area off by {:+.1e}, {} triangles\n", k.name, area / k.area - 1, mesh.triangles.size());
  }
}

/// Points on the edge of a plane's patch, close together.
std::vector<Vec3> edge_points(const Patch& p) {
  std::vector<Vec3> out;
  constexpr int kCount = 4001;
  const auto& x = *p.box[0];
  const auto& y = *p.box[1];
  for (int i = 0; i < kCount; ++i) {
    const double s = static_cast<double>(i) / (kCount - 1);
    const Vec3 on_sides[] = {{std::lerp(x.first, x.second, s), y.first, 0},
                             {std::lerp(x.first, x.second, s), y.second, 0},
                             {x.first, std::lerp(y.first, y.second, s), 0},
                             {x.second, std::lerp(y.first, y.second, s), 0}};
    out.insert(out.end(), std::begin(on_sides), std::end(on_sides));
    if (!p.theta) continue;
    for (const double t : {p.theta->first, p.theta->second})
      out.push_back(0.05 * s * Vec3(std::cos(t), std::sin(t), 0));
  }
  std::erase_if(out, [&](const Vec3& q) { return p.edge_distance(q) < -1e-12; });
  return out;
}

TEST(Patch, EdgeDistanceInsideIsTheDistanceToTheNearestEdge) {
  using R = std::pair<double, double>;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-0.03, 0.03);
  double worst = 0;
  for (const Patch& p :
       {patch(R{-0.02, 0.01}, R{-0.005, 0.02}, {}), patch(R{-0.02, 0.02}, R{-0.02, 0.02}, {}, R{-1, 0.5}),
        patch(R{-0.02, 0.02}, R{-0.02, 0.02}, {}, R{3, 7.5})}) {
    const std::vector<Vec3> edge = edge_points(p);
    for (int k = 0; k < 200; ++k) {
      const Vec3 q{in(random), in(random), 0};
      double nearest = 1;
      for (const Vec3& e : edge) nearest = std::min(nearest, (e - q).norm());
      const double found = p.edge_distance(q);
      if (found > 0) worst = std::max(worst, std::abs(found - nearest));
      // Outside, a corner may be farther than the planes that meet there.
      if (found < 0) {
        EXPECT_LE(-found, nearest + 1e-5);
      }
    }
  }
  EXPECT_LT(worst, 2e-5);  // of the spacing of the edge's points
  EXPECT_EQ(Patch{}.edge_distance(Vec3(1, 2, 3)), std::numeric_limits<double>::infinity());
}

TEST(Patch, NarrowerThanTheTrianglesIsStillFound) {
  using R = std::pair<double, double>;
  const auto cap = make_patch(make_sphere(kPlaced, 0.02, false), kPlaced, patch({}, {}, R{-0.02, -0.01995}), kBounded);
  EXPECT_NEAR(box_diagonal(*cap, 0.03), 2 * std::sqrt(2 * 0.02 * 5e-5) * std::sqrt(2), 1e-3);
  const auto none = make_patch(make_sphere(kPlaced, 0.02, false), kPlaced, patch({}, {}, R{0.021, 0.03}), kBounded);
  EXPECT_TRUE(none->triangles(0.01, Vec3::Zero(), 1).triangles.empty());
}

TEST(Patch, GoesOnPastItsEdgeForPointsButHasNoSideThere) {
  using R = std::pair<double, double>;
  const auto part = make_patch(make_sphere(kPlaced, 0.02, false), kPlaced, patch({}, {}, R{-0.03, -0.01}), kBounded);
  const Vec3 below = kPlaced * Vec3(0, 0.001, -0.021), above = kPlaced * Vec3(0, 0.001, 0.021);
  SurfacePoint point;
  ASSERT_TRUE(part->project(below, point));
  EXPECT_NEAR(*part->gap(below), std::hypot(0.001, 0.021) - 0.02, 1e-16);
  EXPECT_GT(part->edge_distance(point.p), 0);
  ASSERT_TRUE(part->project(above, point));
  EXPECT_FALSE(part->gap(above).has_value());
  EXPECT_LT(part->edge_distance(point.p), -0.02);
}

TEST(Patch, OfAMeshCutsItsTrianglesAndKeepsItsSmoothSurface) {
  Diagnostics out;
  std::shared_ptr<const Surface> whole =
      BlendSurface::build(make_sphere({}, 0.02, false)->triangles(1e-3, Vec3::Zero(), 1), {}, "ball", out);
  ASSERT_TRUE(whole);
  using R = std::pair<double, double>;
  const auto part = make_patch(whole, {}, patch({}, {}, R{-0.03, -0.01}), kBounded);
  const SampleSet samples = part->samples(1e-3, Vec3::Zero(), 1);
  const double area = std::accumulate(samples.areas.begin(), samples.areas.end(), 0.0);
  EXPECT_NEAR(area / (2 * kPi * 0.02 * 0.01), 1, 2e-3);
  double off = 0;
  for (const Vec3& p : samples.points) off = std::max(off, std::abs(p.norm() - 0.02));
  EXPECT_LT(off, 2e-7);
  SurfacePoint from_whole, from_part;
  const Vec3 x(0.003, -0.004, -0.0195);
  ASSERT_TRUE(whole->project(x, from_whole) && part->project(x, from_part));
  EXPECT_EQ(from_whole.p, from_part.p);
  EXPECT_EQ(from_whole.S, from_part.S);
  EXPECT_EQ(part->gap(x), whole->gap(x));
}

TEST(Patch, ItsGapAndFootAreWhatGapAndProjectSay) {
  std::mt19937 random(5);
  for (const Known& k : patches_of_known_area()) {
    const SampleSet samples = k.surface->samples(2e-3, kPlaced.p, 0.05);
    int inside = 0, past = 0;
    for (int i = 0; i < 200; ++i) {
      const std::size_t n = random() % samples.points.size();
      const double height = 1e-3 * std::uniform_real_distribution(-1.0, 1.0)(random);
      const double aside = 4e-3 * std::uniform_real_distribution(-1.0, 1.0)(random);
      const Vec3 x = samples.points[n] + height * samples.normals[n] + aside * tangent_basis(samples.normals[n]).col(0);
      std::optional<SurfacePoint> foot;
      const auto gap = k.surface->gap_and_foot(x, foot);
      ASSERT_EQ(gap, k.surface->gap(x)) << k.name;
      SurfacePoint projected;
      ASSERT_EQ(foot.has_value(), k.surface->project(x, projected)) << k.name;
      if (!foot) continue;
      EXPECT_EQ(foot->p, projected.p) << k.name;
      EXPECT_EQ(foot->S, projected.S) << k.name;
      ++(gap ? inside : past);
    }
    EXPECT_GT(inside, 50) << k.name;
    EXPECT_GT(past, 0) << k.name;
  }
}

TEST(Patch, ItsWedgeIsThatOfAngles) {
  // Of any width and beyond half a turn, against the angle from its first side.
  constexpr double kTurn = 2 * M_PI;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const double width : {0.01, 0.7, M_PI / 2, 3.0, 3.3, 5.0, 6.28})
    for (const double from : {-9.0, -3.0, 0.0, 2.9, 7.5}) {
      const Patch wedge = patch({}, {}, {}, std::pair(from, from + width));
      for (int i = 0; i < 200; ++i) {
        const double x = share(random);
        const double y = share(random);
        double turn = std::fmod(std::atan2(y, x) - from, kTurn);
        if (turn < 0) turn += kTurn;
        const double rho = std::hypot(x, y);
        const auto to = [&](double angle) { return angle < kTurn / 4 ? rho * std::sin(angle) : rho; };
        const double exact =
            turn <= width ? std::min(to(turn), to(width - turn)) : -std::min(to(turn - width), to(kTurn - turn));
        EXPECT_NEAR(wedge.edge_distance({x, y, 0.3}), exact, 1e-13) << width << " from " << from;
      }
      EXPECT_EQ(wedge.edge_distance({0, 0, 1}), 0);
    }
}

}  // namespace
}  // namespace genu
