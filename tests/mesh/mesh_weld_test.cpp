#include "genu/mesh/mesh_weld.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "genu/surface/tessellate.h"

namespace genu {
namespace {

// Every triangle with corners of its own, moved at random by up to `noise`.
Mesh torn(const Mesh& mesh, double noise) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> move(-noise, noise);
  Mesh out;
  for (const auto& t : mesh.triangles) {
    const int first = static_cast<int>(out.vertices.size());
    for (const int v : t) {
      const Vec3 moved{move(engine), move(engine), move(engine)};
      out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)] + moved);
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

TEST(MeshWeld, PutsATornMeshTogetherAgain) {
  const Mesh whole = geodesic_mesh({3, 2, 1}, 0.2);
  for (const double noise : {0.0, 1e-7}) {
    Mesh mesh = torn(whole, noise);
    const WeldReport report = weld(mesh, 4e-7);
    EXPECT_EQ(report.degenerate + report.duplicate, 0u);
    ASSERT_EQ(mesh.vertices.size(), whole.vertices.size());
    // The same triangles up to the numbering, which follows the first appearance.
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])],
                   &q = whole.vertices[static_cast<std::size_t>(whole.triangles[t][k])];
        EXPECT_LE((p - q).norm(), 2 * noise + 1e-16);
      }
    }
  }
}

TEST(MeshWeld, AgreesWithBruteForceInDenseClouds) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> in(0, 1);
  Mesh mesh;
  for (int k = 0; k < 900; ++k) mesh.vertices.push_back(Vec3{in(engine), in(engine), in(engine)});
  for (int k = 0; k < 900; k += 3) mesh.triangles.push_back({k, k + 1, k + 2});
  const double tolerance = 0.08;
  std::vector<int> first(900);  // the plain rule: an earlier vertex that stands for itself, within the tolerance
  for (int v = 0; v < 900; ++v) {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    first[at(v)] = v;
    for (int w = v - 1; w >= 0; --w) {
      const bool near = (mesh.vertices[at(w)] - mesh.vertices[at(v)]).norm() <= tolerance;
      if (first[at(w)] == w && near) first[at(v)] = w;
    }
  }
  std::vector<std::array<Vec3, 3>> expected;
  for (const auto& t : mesh.triangles) {
    const int a = first[static_cast<std::size_t>(t[0])], b = first[static_cast<std::size_t>(t[1])],
              c = first[static_cast<std::size_t>(t[2])];
    if (a == b || b == c || c == a) continue;
    const auto p = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
    expected.push_back({p(a), p(b), p(c)});
  }
  const WeldReport report = weld(mesh, tolerance);
  ASSERT_EQ(mesh.triangles.size() + report.duplicate, expected.size());
  ASSERT_EQ(report.duplicate, 0u);
  for (std::size_t t = 0; t < expected.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])], expected[t][k]);
    }
  }
}

TEST(MeshWeld, DropsWhatDegeneratesRepeatsOrIsUnused) {
  Mesh mesh;
  mesh.vertices = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-9, 0, 0}};
  mesh.triangles = {{1, 2, 3}, {1, 4, 2}, {3, 2, 4}, {2, 3, 1}};
  const WeldReport report = weld(mesh, 1e-8);
  EXPECT_EQ(report.degenerate, 1u);
  EXPECT_EQ(report.duplicate, 2u);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], (std::array<int, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.vertices.size(), 3u);
}

TEST(MeshWeld, ToleranceFollowsTheBoxOrTheRoundingOfFloats) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 4, 0}};
  EXPECT_NEAR(weld_tolerance(mesh), 5e-6, 1e-18);
  mesh.vertices = {{1000, 0, 0}, {1000, 1, 0}};  // far from the origin, where float32 steps are 6e-5
  EXPECT_NEAR(weld_tolerance(mesh), 2.4e-4, 1e-5);
}

}  // namespace
}  // namespace genu
