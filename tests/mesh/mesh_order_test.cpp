// The order of a mesh depends on its shape alone.
#include "genu/mesh/mesh_order.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "support/blend_meshes.h"

namespace genu {
namespace {

/// The same mesh as another file might hold it: vertices and triangles shuffled, corners turned round.
Mesh shuffled(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> rank(mesh.vertices.size());
  std::iota(rank.begin(), rank.end(), 0);
  std::shuffle(rank.begin(), rank.end(), random);
  Mesh out{std::vector<Vec3>(rank.size()), mesh.triangles};
  for (std::size_t v = 0; v < rank.size(); ++v) out.vertices[static_cast<std::size_t>(rank[v])] = mesh.vertices[v];
  for (auto& t : out.triangles) {
    for (int& v : t) v = rank[static_cast<std::size_t>(v)];
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
  }
  std::shuffle(out.triangles.begin(), out.triangles.end(), random);
  return out;
}

Mesh sorted(Mesh mesh) {
  sort_canonically(mesh);
  return mesh;
}

/// The corners of all triangles, each from its least corner on, as a sorted list: what a mesh is, whatever its order.
std::vector<std::array<std::array<double, 3>, 3>> soup(const Mesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> out;
  for (const auto& t : mesh.triangles) {
    auto& corners = out.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& v = mesh.vertices[static_cast<std::size_t>(t[k])];
      corners[k] = {v.x(), v.y(), v.z()};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

void expect_one_order(const Mesh& mesh) {
  const Mesh expected = sorted(mesh);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Mesh again = sorted(shuffled(mesh, seed));
    EXPECT_TRUE(again.vertices == expected.vertices) << seed;
    EXPECT_TRUE(again.triangles == expected.triangles) << seed;
  }
}

TEST(MeshOrder, IsTheSameForEveryOrderOfTheFile) {
  expect_one_order(test::jittered_torus(0.015, 0.005, 1e-3));
  expect_one_order(test::moved(test::noisy_sphere(0.02, 3, 1e-4), {exp_rotation({0.3, 1, -2}), Vec3(0.1, 0, 0.3)}));
}

TEST(MeshOrder, IsTheSameWhereManyVerticesAreEquallyFar) {
  expect_one_order(test::noisy_sphere(0.02, 3, 0));  // all of them, but for rounding
  expect_one_order({{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
}

TEST(MeshOrder, KeepsEveryTriangleAndItsWinding) {
  const Mesh mesh = test::jittered_torus(0.015, 0.005, 1e-3);
  ASSERT_NE(soup(mesh), soup({mesh.vertices, {mesh.triangles.begin() + 1, mesh.triangles.end()}}));
  EXPECT_EQ(soup(sorted(shuffled(mesh, 1))), soup(mesh));
}

TEST(MeshOrder, AMirroredMeshHasTheMirroredOrder) {
  const Mesh mesh = test::jittered_torus(0.015, 0.005, 1e-3);
  for (int axis = 0; axis < 3; ++axis) {
    Mesh mirrored = shuffled(mesh, 3);
    for (Vec3& v : mirrored.vertices) v[axis] = -v[axis];
    for (auto& t : mirrored.triangles) std::swap(t[1], t[2]);
    Mesh back = sorted(mirrored);
    for (Vec3& v : back.vertices) v[axis] = -v[axis];
    for (auto& t : back.triangles) std::swap(t[1], t[2]);
    const Mesh expected = sorted(mesh);
    EXPECT_TRUE(back.vertices == expected.vertices) << axis;
    EXPECT_TRUE(back.triangles == expected.triangles) << axis;
  }
}

}  // namespace
}  // namespace genu
