// The winding number against the sum over every triangle, and what holes leave of it.
#include "genu/mesh/winding_number.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "genu/surface/analytic.h"
#include "support/brute_force.h"

namespace genu {
namespace {

Vec3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> in(-reach, reach);
  return {in(random), in(random), in(random)};
}

Mesh regular_torus() { return make_torus({}, 0.015, 0.005, false)->triangles(1e-3, Vec3::Zero(), 1); }

TEST(WindingNumber, FastIsExact) {
  Mesh mesh = regular_torus();
  std::mt19937 random(1);
  double worst = 0;
  for (const double kept : {1.0, 0.6}) {
    mesh.triangles.resize(static_cast<std::size_t>(kept * static_cast<double>(mesh.triangles.size())));
    const WindingNumber fast(mesh);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 x = random_point(random, 0.025);
      worst = std::max(worst, std::abs(fast(x) - test::winding_number(mesh, x)));
    }
  }
  EXPECT_LT(worst, 0.04);
  EXPECT_GT(worst, 1e-6) << "no dipole was ever used";
}

TEST(WindingNumber, TellsInsideOfAMeshWithAHole) {
  const auto exact = make_torus({}, 0.015, 0.005, false);
  Mesh mesh = regular_torus();
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return (mesh.vertices[static_cast<std::size_t>(t[0])] - Vec3(0.02, 0, 0)).norm() < 3e-3;
  });
  const WindingNumber winding(mesh);
  std::mt19937 random(2);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x = random_point(random, 0.022);
    if (std::abs(*exact->gap(x)) < 1e-3 || (x - Vec3(0.02, 0, 0)).norm() < 4e-3) continue;
    EXPECT_EQ(winding.inside(x), *exact->gap(x) < 0) << x.transpose();
    inside += winding.inside(x);
  }
  EXPECT_GT(inside, 50);
}

TEST(WindingNumber, OfNothingIsZero) {
  EXPECT_EQ(WindingNumber()(Vec3::Zero()), 0);
  EXPECT_EQ(WindingNumber(Mesh{})(Vec3::Zero()), 0);
  const Mesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(WindingNumber(flat)(Vec3(0.3, 0.1, 4)), 0);
}

}  // namespace
}  // namespace genu
