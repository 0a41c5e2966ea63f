// Solids with closed forms, wherever they stand; and what does not depend on where that is.
#include "genu/mesh/solid_inertia.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "genu/surface/tessellate.h"
#include "support/mesh_parts.h"

namespace genu {
namespace {

using std::numbers::pi;

Mesh box(const Vec3& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(Vec3((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, (k >> 2) - 0.5).cwiseProduct(size));
  const std::array<int, 4> sides[] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& s : sides) {
    mesh.triangles.push_back({s[0], s[1], s[2]});
    mesh.triangles.push_back({s[0], s[2], s[3]});
  }
  return mesh;
}

Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

struct Exact {
  double volume;
  Mat3 inertia;
};

Exact exact_box(const Vec3& s) {
  const double V = s.prod();
  const Vec3 q = s.cwiseProduct(s);
  return {V, V / 12 * diagonal(q[1] + q[2], q[0] + q[2], q[0] + q[1])};
}

Exact exact_ellipsoid(const Vec3& r) {
  const double V = 4 * pi / 3 * r.prod();
  const Vec3 q = r.cwiseProduct(r);
  return {V, V / 5 * diagonal(q[1] + q[2], q[0] + q[2], q[0] + q[1])};
}

Exact exact_torus(double R, double r) {
  const double V = 2 * pi * pi * R * r * r;
  const double across = V * (R * R / 2 + 5 * r * r / 8), axial = V * (R * R + 3 * r * r / 4);
  return {V, diagonal(across, across, axial)};
}

Exact exact_cylinder(double r, double h) {
  const double V = pi * r * r * h, across = V * (3 * r * r + h * h) / 12;
  return {V, diagonal(across, across, V * r * r / 2)};
}

/// A prism of n sides whose corners lie on the cylinder.
Mesh cylinder(double r, double h, int n) {
  Mesh mesh;
  mesh.vertices = {{0, 0, -h / 2}, {0, 0, h / 2}};
  for (int k = 0; k < n; ++k)
    for (const double z : {-h / 2, h / 2})
      mesh.vertices.emplace_back(r * std::cos(2 * pi * k / n), r * std::sin(2 * pi * k / n), z);
  for (int k = 0; k < n; ++k) {
    const int a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % n);
    mesh.triangles.insert(mesh.triangles.end(), {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
  return mesh;
}

const Pose kPoses[] = {
    {}, {exp_rotation(Vec3(0.4, -1.1, 2.0)), {0.3, -0.2, 0.1}}, {exp_rotation(Vec3(-2.0, 0.3, 0.8)), {100, -70, 40}}};

TEST(SolidInertia, OfABoxIsExactAnywhereAndTurned) {
  const Vec3 size(0.06, 0.11, 0.02);
  const Exact exact = exact_box(size);
  for (const Pose& X : kPoses) {
    const SolidInertia s = solid_inertia(test::moved(box(size), X));
    // Corners 100 m away are themselves rounded, to 1e-14 m.
    const double tolerance = X.p.norm() > 1 ? 1e-11 : 1e-14;
    EXPECT_NEAR(s.volume, exact.volume, tolerance * exact.volume);
    EXPECT_LT((s.centroid - X.p).norm(), X.p.norm() > 1 ? 3e-14 : 1e-16);
    const Mat3 I = X.R * exact.inertia * X.R.transpose();
    EXPECT_LT((s.about_centroid - I).norm(), tolerance * I.norm());
    EXPECT_EQ((s.about_centroid - s.about_centroid.transpose()).norm(), 0);
  }
}

/// How fast an error falls with the edge, which falls with the root of the number of triangles.
double order(double coarse, std::size_t few, double fine, std::size_t many) {
  return 2 * std::log(coarse / fine) / std::log(static_cast<double>(many) / static_cast<double>(few));
}

/// Errors of volume and inertia fall with the square of the edge.
void converges(const std::function<Mesh(int)>& mesh_of, const Exact& exact, double expected = 2) {
  double last[2] = {};
  std::size_t few = 0;
  for (int level = 0; level < 3; ++level) {
    const Mesh mesh = mesh_of(level);
    const SolidInertia s = solid_inertia(mesh);
    const double error[] = {(exact.volume - s.volume) / exact.volume,
                            (s.about_centroid - exact.inertia).norm() / exact.inertia.norm()};
    EXPECT_GT(error[0], 0) << "a polyhedron inside what bulges";
    EXPECT_LT(s.centroid.norm(), 1e-15);
    for (int k = 0; k < 2; ++k) {
      if (level > 0) {
        EXPECT_NEAR(order(last[k], few, error[k], mesh.triangles.size()), expected, 0.1) << level << " " << error[k];
      }
      last[k] = error[k];
    }
    few = mesh.triangles.size();
  }
  EXPECT_LT(last[0], 6e-3);
}

TEST(SolidInertia, OfRoundSolidsConverges) {
  const auto edge = [](int level) { return 6e-3 / (1 << level); };
  converges([&](int level) { return geodesic_mesh(Vec3::Constant(0.03), edge(level)); },
            exact_ellipsoid(Vec3::Constant(0.03)));
  converges(
      [&](int level) {
        return geodesic_mesh({0.03, 0.02, 0.04}, edge(level));
      },
      exact_ellipsoid({0.03, 0.02, 0.04}));
  // A prism's sides are cut across alone: twice as many triangles are half as wide.
  converges([](int level) { return cylinder(0.02, 0.3, 24 << level); }, exact_cylinder(0.02, 0.3), 4);
  const double R = 0.03, r = 0.01;
  const auto torus = [&](int level) {
    return grid_mesh({40 << level, true}, {16 << level, true}, [&](double s, double t) {
      const double a = 2 * pi * s, b = 2 * pi * t, x = R + r * std::cos(b);
      return Vec3(x * std::cos(a), x * std::sin(a), r * std::sin(b));
    });
  };
  // A tube's polyhedron stands out of the hole and back from the outside: its volume may err either way.
  double last = 0;
  for (int level = 0; level < 3; ++level) {
    const SolidInertia s = solid_inertia(torus(level));
    const double error = (s.about_centroid - exact_torus(R, r).inertia).norm() / exact_torus(R, r).inertia.norm();
    EXPECT_GT(s.volume, 0);
    if (level > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.2);
    }
    last = error;
  }
}

TEST(SolidInertia, AddsUpAndCavitiesCountLess) {
  const Pose X = kPoses[1];
  const Mesh a = box({0.06, 0.11, 0.02}), b = test::moved(box({0.03, 0.03, 0.05}), X);
  const SolidInertia A = solid_inertia(a), B = solid_inertia(b), both_of = solid_inertia(test::joined(a, b));
  EXPECT_NEAR(both_of.volume, A.volume + B.volume, 1e-18);
  const Vec3 c = (A.volume * A.centroid + B.volume * B.centroid) / both_of.volume;
  EXPECT_LT((both_of.centroid - c).norm(), 1e-15);
  Mat3 I = A.about_centroid + B.about_centroid;
  for (const SolidInertia* s : {&A, &B}) {
    const Mat3 d = skew(s->centroid - c);
    I -= s->volume * d * d;  // Steiner
  }
  EXPECT_LT((both_of.about_centroid - I).norm(), 1e-13 * I.norm());
  const SolidInertia hollow =
      solid_inertia(test::joined(box({0.06, 0.11, 0.04}), test::turned(box({0.03, 0.03, 0.02}))));
  const Exact outer = exact_box({0.06, 0.11, 0.04}), inner = exact_box({0.03, 0.03, 0.02});
  EXPECT_NEAR(hollow.volume, outer.volume - inner.volume, 1e-18);
  EXPECT_LT((hollow.about_centroid - (outer.inertia - inner.inertia)).norm(), 1e-13 * outer.inertia.norm());
}

TEST(SolidInertia, TurnsPiecesOutwardButForCavities) {
  const Mesh outer = box({0.06, 0.11, 0.04}), cavity = test::turned(box({0.03, 0.03, 0.02}));
  const Mesh beside = test::turned(test::moved(box({0.03, 0.03, 0.02}), {Mat3::Identity(), Vec3(0.2, 0, 0)}));
  Mesh mesh = test::joined(test::joined(outer, cavity), beside);
  EXPECT_EQ(turn_outward(mesh).turned, 12u);
  EXPECT_NEAR(solid_inertia(mesh).volume, 0.06 * 0.11 * 0.04, 1e-18) << "what is missing here is there";
  EXPECT_EQ(turn_outward(mesh).turned, 0u);
  Mesh alone = test::turned(outer);
  EXPECT_EQ(turn_outward(alone).turned, 12u);
}

TEST(SolidInertia, NestedPiecesTakeTurnsWhateverSideTheyFace) {
  const double outer = 0.06 * 0.11 * 0.04, inner = 0.03 * 0.03 * 0.02, core = 0.01 * 0.02 * 0.01;
  const Mesh shells[] = {box({0.06, 0.11, 0.04}), box({0.03, 0.03, 0.02}), box({0.01, 0.02, 0.01})};
  for (int k = 0; k < 8; ++k) {
    Mesh mesh;
    for (int i = 0; i < 3; ++i) mesh = test::joined(mesh, (k >> i & 1) != 0 ? test::turned(shells[i]) : shells[i]);
    const OutwardReport report = turn_outward(mesh);
    EXPECT_EQ(report.cavities, (k & 2) != 0 ? 0u : 1u) << k;
    EXPECT_NEAR(report.cavity_volume, (k & 2) != 0 ? 0 : inner, 1e-18) << k;
    EXPECT_EQ(report.turned, ((k & 1) != 0 ? 12u : 0u) + ((k & 4) != 0 ? 12u : 0u)) << k;
    EXPECT_NEAR(solid_inertia(mesh).volume, outer - inner + core, 1e-18) << k;
  }
  Mesh crossing = test::joined(shells[0], test::moved(shells[1], {Mat3::Identity(), Vec3(0.03, 0, 0)}));
  EXPECT_EQ(turn_outward(crossing).cavities, 0u);
  EXPECT_NEAR(solid_inertia(crossing).volume, outer + inner, 1e-18);
}

TEST(SolidInertia, InsideOutIsNegativeAndFlatIsNothing) {
  const SolidInertia s = solid_inertia(test::turned(box({0.06, 0.11, 0.02})));
  EXPECT_NEAR(s.volume, -exact_box({0.06, 0.11, 0.02}).volume, 1e-18);
  EXPECT_LT(s.centroid.norm(), 1e-16);
  const Mesh flat = box({0.06, 0.11, 0});
  EXPECT_EQ(fullness(flat, solid_inertia(flat).volume), 0);
  EXPECT_EQ(solid_inertia(Mesh{}).volume, 0);
  EXPECT_EQ(fullness(Mesh{}, 0), 0);
}

TEST(SolidInertia, FullnessIsOneForABall) {
  const Mesh ball = geodesic_mesh(Vec3::Constant(0.03), 1e-3);
  EXPECT_NEAR(fullness(ball, solid_inertia(ball).volume), 1, 1e-3);
  const Mesh cube = box(Vec3::Constant(0.1));
  EXPECT_NEAR(fullness(cube, solid_inertia(cube).volume), std::sqrt(pi / 6), 1e-12);
}

}  // namespace
}  // namespace genu
