// Rays through a tree of triangles against rays through all of them one by one.
#include "genu/mesh/triangle_tree.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

#include "genu/mesh/nearest_point.h"
#include "support/brute_force.h"
#include "support/layers.h"

namespace genu {
namespace {

Vec3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  return {unit(random), unit(random), unit(random)};
}

TEST(TriangleTree, MeetsWhatAllTrianglesMeet) {
  std::mt19937 random(7);
  const Mesh mesh = test::ball(0.02, 2e-3);
  const TriangleTree tree(mesh);
  ASSERT_EQ(tree.size(), static_cast<int>(mesh.triangles.size()));
  int met = 0;
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 origin = random_vector(random, 0.03), direction = random_vector(random, 1).normalized();
    const double length = k % 3 == 0 ? 0.01 : 0.1;
    const auto expected = test::leaving_by_all(mesh, origin, direction, length);
    const auto hit = tree.leaving(origin, direction, length);
    ASSERT_EQ(hit.triangle, expected.triangle) << "ray " << k;
    worst = std::max(worst, std::abs(hit.distance - expected.distance));
    met += hit ? 1 : 0;
  }
  EXPECT_GT(met, 400);
  EXPECT_LT(worst, 1e-15);
}

TEST(TriangleTree, EnteringIsLeavingOfTheMeshTurnedRound) {
  std::mt19937 random(8);
  Mesh mesh = test::ball(0.02, 3e-3);
  const TriangleTree tree(mesh);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  for (int k = 0; k < 500; ++k) {
    const Vec3 origin = random_vector(random, 0.03), direction = random_vector(random, 1).normalized();
    EXPECT_EQ(tree.entering(origin, direction, 0.1).triangle,
              test::leaving_by_all(mesh, origin, direction, 0.1).triangle);
  }
}

/// From inside a closed mesh a ray comes out, also where it meets an edge or a vertex.
TEST(TriangleTree, NoRayPassesBetweenTriangles) {
  std::mt19937 random(9);
  const Mesh mesh = test::ball(0.02, 4e-3);
  const TriangleTree tree(mesh);
  for (int k = 0; k < 20; ++k) {
    const Vec3 origin = random_vector(random, 5e-3);
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[i])],
                   b = mesh.vertices[static_cast<std::size_t>(t[(i + 1) % 3])];
        EXPECT_TRUE(tree.leaving(origin, (a - origin).normalized(), 0.1));
        EXPECT_TRUE(tree.leaving(origin, (0.5 * (a + b) - origin).normalized(), 0.1));
      }
  }
}

TEST(TriangleTree, OfTwoAtOneDistanceTheFirst) {
  Mesh mesh = test::sheet(0.01, 2);
  const std::size_t one_sheet = mesh.triangles.size();
  for (std::size_t k = 0; k < one_sheet; ++k) mesh.triangles.push_back(mesh.triangles[k]);
  const TriangleTree tree(mesh);
  for (const int hint : {-1, 3, static_cast<int>(one_sheet) + 3, static_cast<int>(mesh.triangles.size()) - 1}) {
    const auto hit = tree.leaving({2e-3, 3e-3, -1e-3}, Vec3::UnitZ(), 0.01, hint);
    ASSERT_TRUE(hit);
    EXPECT_LT(hit.triangle, static_cast<int>(one_sheet));
    EXPECT_DOUBLE_EQ(hit.distance, 1e-3);
  }
}

TEST(TriangleTree, HintsChangeNothing) {
  std::mt19937 random(10);
  const Mesh mesh = test::ball(0.02, 3e-3);
  const TriangleTree tree(mesh);
  std::uniform_int_distribution<int> any(0, tree.size() - 1);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 origin = random_vector(random, 0.02), direction = random_vector(random, 1).normalized();
    const auto cold = tree.leaving(origin, direction, 0.05),
               hinted = tree.leaving(origin, direction, 0.05, any(random));
    EXPECT_EQ(cold.triangle, hinted.triangle);
    EXPECT_EQ(cold.distance, hinted.distance);
  }
}

TEST(TriangleTree, FarIsNeverNear) {
  std::mt19937 random(11);
  const Mesh mesh = test::ball(0.02, 4e-3);
  const TriangleTree tree(mesh);
  int far = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 origin = random_vector(random, 0.04), direction = random_vector(random, 1).normalized();
    const double length = 5e-3, margin = 2e-3;
    // What a ray whose ends move by less than the margin can come out of.
    Mesh facing = mesh;
    std::erase_if(facing.triangles, [&](const auto& t) {
      const auto v = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
      return (v(1) - v(0)).cross(v(2) - v(0)).normalized().dot(direction) <= -2 * margin / length;
    });
    double least = 1;
    for (int i = 0; i <= 20; ++i) {
      const Vec3 x = origin + i * length / 20 * direction;
      least = std::min(least, (nearest_on_mesh(facing, x) - x).norm());
    }
    int met = -1;
    const double margins[] = {10 * margin, margin};
    const std::size_t level = tree.clear_by(origin, direction, length, margins, TriangleTree::Way::out, met);
    const bool near = level == 2;
    if (level == 0) {
      EXPECT_GT(least, 10 * margin);
    }
    EXPECT_EQ(tree.clear_by(origin, direction, length, margins, TriangleTree::Way::out, met), level)
        << "the hint changed the answer";
    if (!near) {
      EXPECT_GT(least, margin);
      ++far;
    }
    if (least > 3 * margin) {
      EXPECT_FALSE(near) << least;  // of use as well as right
    }
  }
  EXPECT_GT(far, 50);
}

TEST(TriangleTree, ClearOfWhatItEntersIsClearOfTheOtherSide) {
  std::mt19937 random(12);
  const Mesh mesh = test::ball(0.02, 4e-3);
  Mesh turned = mesh;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  const TriangleTree tree(mesh), other(turned);
  std::array<int, 3> levels{};
  for (int k = 0; k < 300; ++k) {
    const Vec3 origin = random_vector(random, 0.04), direction = random_vector(random, 1).normalized();
    const double margins[] = {5e-3, 1e-3};
    int met = -1, met_turned = -1;
    const std::size_t level = tree.clear_by(origin, direction, 5e-3, margins, TriangleTree::Way::in, met);
    EXPECT_EQ(other.clear_by(origin, direction, 5e-3, margins, TriangleTree::Way::out, met_turned), level);
    if (level < 2) {
      EXPECT_FALSE(tree.entering(origin, direction, 5e-3));
    }
    ++levels[level];
  }
  for (const int count : levels) EXPECT_GT(count, 10);
}

TEST(TriangleTree, EmptyMeetsNothing) {
  const TriangleTree tree{Mesh()};
  EXPECT_FALSE(tree.leaving(Vec3::Zero(), Vec3::UnitX(), 1));
  int met = -1;
  const double margins[] = {1};
  EXPECT_EQ(tree.clear_by(Vec3::Zero(), Vec3::UnitX(), 1, margins, TriangleTree::Way::out, met), 0u);
}

}  // namespace
}  // namespace genu
