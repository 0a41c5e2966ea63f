// Damage is what its name says, and the same every time.
#include "genu/mesh_care/mesh_damage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/surface/tessellate.h"

namespace genu {
namespace {

const Vec3 kTop(0, 0, 0.02);

Mesh ball() { return geodesic_mesh(Vec3::Constant(0.02), 0.003); }

double volume(const Mesh& mesh) {
  double sum = 0;
  const auto at = [&](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
  for (const auto& t : mesh.triangles) sum += at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6;
  return sum;
}

TEST(MeshDamage, HasNames) {
  for (const MeshDamage d : {MeshDamage::fin, MeshDamage::slivers, MeshDamage::noise, MeshDamage::subdivide})
    EXPECT_EQ(mesh_damage_named(to_string(d)), d);
  EXPECT_FALSE(mesh_damage_named("rust"));
  EXPECT_TRUE(is_local(MeshDamage::slivers));
  EXPECT_FALSE(is_local(MeshDamage::noise));
}

TEST(MeshDamage, NearAPlaceLeavesTheRest) {
  const Mesh whole = ball();
  const Vec3 vertex = whole.vertices[static_cast<std::size_t>(nearest_vertex(whole, kTop))];
  const std::size_t near = triangles_near(whole, vertex, 0.005).size();
  EXPECT_GT(near, 5u);
  EXPECT_EQ(damaged_near(whole, MeshDamage::hole, kTop, 0.005).triangles.size(), whole.triangles.size() - near);
  EXPECT_EQ(damaged_near(whole, MeshDamage::duplicate, kTop, 0.005).triangles.size(), whole.triangles.size() + near);
  EXPECT_EQ(damaged_near(whole, MeshDamage::slivers, kTop, 0.005).triangles.size(), whole.triangles.size() + 2 * near);
  const Mesh spiked = damaged_near(whole, MeshDamage::spike, kTop, 0.005);
  const auto tip = static_cast<std::size_t>(nearest_vertex(whole, kTop));
  EXPECT_NEAR((spiked.vertices[tip] - whole.vertices[tip]).norm(), 0.005, 1e-12);
}

TEST(MeshDamage, NoiseIsAsLargeAsAskedForAndTheSameEveryTime) {
  const Mesh whole = ball(), noisy = damaged(whole, MeshDamage::noise, 1e-4),
             again = damaged(whole, MeshDamage::noise, 1e-4);
  double square = 0;
  for (std::size_t i = 0; i < whole.vertices.size(); ++i) {
    square += (noisy.vertices[i] - whole.vertices[i]).squaredNorm() / 3;
    EXPECT_EQ(noisy.vertices[i], again.vertices[i]);
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(whole.vertices.size())), 1e-4, 1e-5);
}

TEST(MeshDamage, EverywhereIsWhatItsNameSays) {
  const Mesh whole = ball();
  EXPECT_NEAR(volume(damaged(whole, MeshDamage::inside_out, 0)), -volume(whole), 1e-18);
  EXPECT_NEAR(volume(damaged(whole, MeshDamage::scale, 2)), 8 * volume(whole), 1e-15);
  EXPECT_NEAR(volume(damaged(whole, MeshDamage::shift, 0, Vec3(1, 2, 3))), volume(whole), 1e-14);
  const Mesh fine = damaged(whole, MeshDamage::subdivide, 2);
  EXPECT_EQ(fine.triangles.size(), 16 * whole.triangles.size());
  EXPECT_NEAR(volume(fine), volume(whole), 1e-15);
  EXPECT_EQ(static_cast<long>(fine.vertices.size()), 2 + static_cast<long>(fine.triangles.size()) / 2) << "closed";
  EXPECT_GT(damaged(whole, MeshDamage::degenerate, 0).triangles.size(), whole.triangles.size());
}

}  // namespace
}  // namespace genu
