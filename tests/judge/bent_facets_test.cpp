// The judge's smooth surfaces: against shapes that meshes were taken from, and with noise.
#include "genu/judge/bent_facets.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/blend_torus.h"
#include "support/shells.h"

namespace genu::judge {
namespace {

using test::kMajor, test::kMinor;

/// m, from the torus; positive outside.
double height(const Vec3& x) { return std::hypot(std::hypot(x.x(), x.y()) - kMajor, x.z()) - kMinor; }

Vec3 normal_of_torus(const Vec3& x) {
  const double out = std::hypot(x.x(), x.y());
  return (x - kMajor / out * Vec3(x.x(), x.y(), 0)).normalized();
}

struct Errors {
  double flat = 0, bent = 0, turned = 0, doubt = 1e300, most = 0;
};

Errors errors(double edge, double noise) {
  SurfaceDef def;
  def.shape = SurfaceDef::Shape::mesh;
  const Facets facets(test::jittered_torus(kMajor, kMinor, edge, noise), def);
  const BentFacets bent(facets, 0);
  Errors out;
  out.most = bent.most();
  double square[2] = {0, 0};
  const auto count = static_cast<int>(facets.triangles().size());
  for (int t = 0; t < count; ++t) {
    const Vec3 p = facets.centroid(t);
    const BentFacets::Point over = bent.over(t, p);
    square[0] += height(p) * height(p);
    square[1] += height(p + over.off) * height(p + over.off);
    out.turned = std::max(out.turned, (over.n - normal_of_torus(p)).norm());
    if (t % 200 == 0) out.doubt = std::min(out.doubt, bent.doubt(p, 3 * edge) / std::abs(height(p + over.off)));
  }
  out.flat = std::sqrt(square[0] / count);
  out.bent = std::sqrt(square[1] / count);
  return out;
}

TEST(BentFacets, ComeToTheShapeByAHigherOrderThanTriangles) {
  const Errors coarse = errors(1.6e-3, 0), fine = errors(0.8e-3, 0);
  std::printf("triangles %.1e and %.1e m, bent %.1e and %.1e m, normals %.1e and %.1e\n", coarse.flat, fine.flat,
              coarse.bent, fine.bent, coarse.turned, fine.turned);
  EXPECT_NEAR(coarse.flat / fine.flat, 4, 1);
  EXPECT_LT(coarse.bent, coarse.flat / 5);
  EXPECT_GT(coarse.bent / fine.bent, 6);
  EXPECT_GT(coarse.turned / fine.turned, 3);
  EXPECT_GT(coarse.most / fine.most, 3);
  EXPECT_GT(fine.doubt, 1);  // never less than what it is off by
  EXPECT_GT(coarse.doubt, 1);
}

TEST(BentFacets, KeepCreases) {
  // A box of 10 mm, its faces in 8 x 8 squares.
  SurfaceDef def;
  def.shape = SurfaceDef::Shape::mesh;
  const Facets facets(test::box(Vec3::Zero(), Vec3::Constant(10e-3), 8), def);
  const BentFacets bent(facets, 0);
  for (int t = 0; t < static_cast<int>(facets.triangles().size()); ++t) {
    const BentFacets::Point over = bent.over(t, facets.centroid(t));
    EXPECT_LT(over.off.norm(), 1e-15);
    EXPECT_LT((over.n - facets.area(t).normalized()).norm(), 1e-12);
  }
  EXPECT_LT(bent.doubt(facets.vertices()[0], 3 * facets.edge()), 1e-15);
}

TEST(BentFacets, SmoothNoise) {
  const Errors noisy = errors(0.8e-3, 5e-5);
  EXPECT_LT(noisy.bent, 0.85 * noisy.flat);
  EXPECT_LT(noisy.bent, 3e-5);
}

}  // namespace
}  // namespace genu::judge
