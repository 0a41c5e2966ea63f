// The blend against its plain twin: one polynomial fitted anew at the very point that is looked at. No nodes, no
// weights, no sheets; slow, and not smooth where vertices come and go, but as accurate. Both leave out the same terms
// of the shape, with other constants: they differ by (k r)^(d+1), (k r)^d, k (k r)^(d-1) in position, normal,
// curvature.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/surface/tolerances.h"
#include "support/blend_torus.h"
#include "support/data.h"
#include "support/quantile.h"

namespace genu::test {
namespace {

struct Difference {
  double position = 0, normal = 0, curvature = 0;  ///< m, rad, 1/m
};

/// The blend at x minus the refit there; none where either has no point.
std::optional<Difference> difference(const BlendSurface& blend, const VertexGraph& graph, HeightFitter& fitter,
                                     const Vec3& x) {
  SurfacePoint point;
  if (!blend.project(x, point)) return std::nullopt;
  const auto& vertices = blend.mesh().vertices;
  const auto nearest = std::min_element(vertices.begin(), vertices.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - point.p).squaredNorm() < (b - point.p).squaredNorm();
  });
  const int seed = static_cast<int>(nearest - vertices.begin());
  EXPECT_GT(graph.normals[static_cast<std::size_t>(seed)].dot(point.n), 0.5);
  const BlendFacts& facts = blend.facts();
  const HeightFit fit = fitter.fit({point.p, point.n, std::span(&seed, 1), facts.fit_radius, facts.degree, false});
  if (fit.degree == 0) return std::nullopt;
  const Height h = fit.height(0, 0);
  const Vec3 n = (fit.axes * Vec3(-h.hu, -h.hv, 1)).normalized();
  return Difference{std::abs(h.h), (n - point.n).norm(), (fit.curvature(point.p) - tensor(point)).norm()};
}

class RefitTwin : public ::testing::TestWithParam<int> {};

TEST_P(RefitTwin, AgreesOnATorusToTheOrderOfTheFit) {
  const int degree = GetParam();
  constexpr double kShareOfOrder = 0.6;  // worst of 200 points of two irregular meshes
  Difference last;
  for (double edge : {0.8e-3, 0.4e-3}) {
    const auto blend = build(jittered_torus(kMajor, kMinor, edge), fitted(3 * edge, degree));
    const VertexGraph graph = vertex_graph(blend->mesh());
    HeightFitter fitter(blend->mesh(), graph);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> angle(0, kTwoPi);
    Difference worst;
    int found = 0;
    for (int k = 0; k < 200; ++k) {
      const double v = angle(random), u = angle(random);  // in this order: that of a call's arguments is the compiler's
      const auto d = difference(*blend, graph, fitter, torus_point(u, v));
      if (!d) continue;
      ++found;
      worst = {std::max(worst.position, d->position), std::max(worst.normal, d->normal),
               std::max(worst.curvature, d->curvature)};
    }
    EXPECT_GT(found, 190);
    std::printf("degree %d, edge %.1f mm: position %.1e m, normal %.1e rad, curvature %.2e 1/m\n", degree, 1e3 * edge,
                worst.position, worst.normal, worst.curvature);
    if (last.position > 0) {
      EXPECT_GT(last.position / worst.position, kShareOfOrder * std::pow(2, degree + 1));
      EXPECT_GT(last.normal / worst.normal, kShareOfOrder * std::pow(2, degree));
      EXPECT_GT(last.curvature / worst.curvature, kShareOfOrder * std::pow(2, degree - 1));
    }
    last = worst;
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, RefitTwin, ::testing::Values(2, 3, 4));

TEST(RefitTwinOnAFemur, DiffersByLessThanTheNoise) {
  const std::string file = "lenhart2015/ACLC01-R-femur-cart.stl";
  GENU_NEEDS_DATA(file);
  Diagnostics diagnostics;
  auto mesh = read_mesh(data_path(file), 1, diagnostics);
  ASSERT_TRUE(mesh);
  make_winding_consistent(*mesh, mesh_edges(*mesh));
  const auto blend = build(std::move(*mesh));
  const VertexGraph graph = vertex_graph(blend->mesh());
  HeightFitter fitter(blend->mesh(), graph);
  const FitUncertainty& known = blend->facts().uncertainty;
  std::vector<double> position, normal, curvature;
  for (std::size_t i = 0; i < blend->node_positions().size(); i += 10) {
    const Vec3& x = blend->node_positions()[i];
    SurfacePoint point;
    // Sharply bent places are fitted more narrowly by the blend, and edges from one side: other fits.
    if (!blend->project(x, point) || point.S.norm() * blend->facts().fit_radius > kMaxOfCurvature) continue;
    const auto d = difference(*blend, graph, fitter, x);
    if (!d) continue;
    position.push_back(d->position);
    normal.push_back(d->normal);
    curvature.push_back(d->curvature);
  }
  ASSERT_GT(position.size(), 80u);
  std::printf(
      "%zu points: median / known to: position %.1f / %.1f um, normal %.1e / %.1e rad, curvature %.1f / %.1f 1/m\n",
      position.size(), 1e6 * quantile(position, 0.5), 1e6 * known.height, quantile(normal, 0.5), known.slope,
      quantile(curvature, 0.5), known.curvature);
  EXPECT_LT(quantile(position, 0.5), known.height);
  EXPECT_LT(quantile(normal, 0.5), 2 * known.slope);         // of two tangents
  EXPECT_LT(quantile(curvature, 0.5), 3 * known.curvature);  // of three components, in a fit noisier than the blend
}

}  // namespace
}  // namespace genu::test
