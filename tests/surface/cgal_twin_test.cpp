// The blend's normal and curvature against CGAL's jet fitting (Cazals and Pouget 2005), another author's fit of the
// same vertices: no kernel, no areas, no blending, the frame by principal components.
//
// Fits of degree d within a radius r leave out the terms of order d + 1. That costs the normal O(r^d) and the
// curvature O(r^(d-1)) in both, with other constants: they differ by that much. With k the largest curvature,
//     |n - n'| <= c (k r)^d,    |S - S'| <= c k (k r)^(d-1)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/mesh_reader.h"
#include "support/blend_meshes.h"
#include "support/blend_torus.h"
#include "support/data.h"
#include "support/quantile.h"

namespace genu {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using JetFit = CGAL::Monge_via_jet_fitting<Kernel>;

/// Normal and curvature at a vertex, in the mesh's frame.
struct Jet {
  Vec3 n = Vec3::Zero();
  Mat3 S = Mat3::Zero();          ///< 1/m, zero across: -1/R on a sphere with its outward normal
  Vec2 principal = Vec2::Zero();  ///< 1/m, descending
};

Vec3 to_vec3(const Kernel::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

/// The vertices that a walk over the edges from `start` reaches within `radius`, `start` first. Empty where the walk
/// comes to a boundary: a one-sided fit is another estimate.
std::vector<int> follow(const Mesh& mesh, const VertexNeighbours& graph, const std::vector<bool>& boundary, int start,
                        double radius) {
  std::vector<int> found{start};
  std::set<int> seen{start};
  const auto at = [&](int v) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(v)]; };
  for (std::size_t next = 0; next < found.size(); ++next) {
    const auto v = static_cast<std::size_t>(found[next]);
    if (boundary[v]) return {};
    for (int k = graph.offset[v]; k < graph.offset[v + 1]; ++k) {
      const int w = graph.neighbours[static_cast<std::size_t>(k)];
      if ((at(w) - at(start)).norm() < radius && seen.insert(w).second) found.push_back(w);
    }
  }
  return found;
}

Jet jet_fit(const Mesh& mesh, const std::vector<int>& vertices, int degree, const Vec3& outward) {
  std::vector<Kernel::Point_3> points;
  for (int v : vertices) {
    const Vec3& p = mesh.vertices[static_cast<std::size_t>(v)];
    points.emplace_back(p.x(), p.y(), p.z());
  }
  JetFit fit;
  JetFit::Monge_form monge = fit(points.begin(), points.end(), static_cast<std::size_t>(degree), 2);
  monge.comply_wrt_given_normal({outward.x(), outward.y(), outward.z()});
  Jet out;
  out.n = to_vec3(monge.normal_direction());
  out.principal = {monge.principal_curvatures(0), monge.principal_curvatures(1)};
  const Vec3 d1 = to_vec3(monge.maximal_principal_direction()), d2 = to_vec3(monge.minimal_principal_direction());
  out.S = out.principal[0] * d1 * d1.transpose() + out.principal[1] * d2 * d2.transpose();
  return out;
}

Jet of_point(const SurfacePoint& point) {
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(point.S);
  return {point.n, test::tensor(point), {eigen.eigenvalues()[1], eigen.eigenvalues()[0]}};
}

struct Differences {
  std::vector<double> normal, curvature, principal;  ///< 1, 1/m, 1/m; principal: the worse of the two
  std::vector<double> size;                          ///< of the curvature, 1/m
  std::vector<double> narrower;                      ///< the jet minus the jet of 0.7 radii, curvature, 1/m
};

/// The blend minus the jet at about `count` vertices spread over the mesh.
Differences compare(const BlendSurface& surface, double radius, int degree, std::size_t count) {
  const Mesh& mesh = surface.mesh();
  const auto edges = mesh_edges(mesh);
  const auto graph = vertex_neighbours(mesh, edges);
  const auto boundary = boundary_vertices(mesh, edges);
  const std::size_t stride = std::max<std::size_t>(1, mesh.vertices.size() / count);
  Differences out;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += stride) {
    const std::vector<int> vertices = follow(mesh, graph, boundary, static_cast<int>(v), radius);
    SurfacePoint point;
    // Fewer points than coefficients make no fit: CGAL asks for as many.
    if (vertices.size() < static_cast<std::size_t>((degree + 1) * (degree + 2) / 2)) continue;
    EXPECT_TRUE(surface.project(mesh.vertices[v], point));
    const Jet blend = of_point(point), jet = jet_fit(mesh, vertices, degree, point.n);
    out.normal.push_back((blend.n - jet.n).norm());
    out.curvature.push_back((blend.S - jet.S).norm());
    out.principal.push_back((blend.principal - jet.principal).cwiseAbs().maxCoeff());
    out.size.push_back(jet.S.norm());
    const std::vector<int> fewer = follow(mesh, graph, boundary, static_cast<int>(v), 0.7 * radius);
    const auto coefficients = static_cast<std::size_t>((degree + 1) * (degree + 2) / 2);
    if (fewer.size() < coefficients) continue;
    out.narrower.push_back((jet_fit(mesh, fewer, degree, point.n).S - jet.S).norm());
  }
  return out;
}

double worst(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// Worst differences on the torus with fit radius 3 edges; edge (m).
Differences torus_differences(double edge, int degree) {
  const auto surface =
      test::build(test::jittered_torus(test::kMajor, test::kMinor, edge), test::fitted(3 * edge, degree));
  return compare(*surface, 3 * edge, degree, 100);
}

class JetTwin : public ::testing::TestWithParam<int> {};

TEST_P(JetTwin, AgreesOnATorusToTheOrderOfTheFit) {
  const int degree = GetParam();
  constexpr double kCurvature = 1 / test::kMinor, kNormalBound = 0.1, kCurvatureBound = 0.6;
  constexpr double kShareOfOrder = 0.6;  // the worst of 100 vertices of two irregular meshes
  Differences last;
  for (const double edge : {0.5e-3, 0.25e-3}) {
    const Differences now = torus_differences(edge, degree);
    ASSERT_GE(now.normal.size(), 90u);
    const double kr = kCurvature * 3 * edge;
    const double normal = worst(now.normal) / std::pow(kr, degree);
    const double curvature = worst(now.curvature) / (kCurvature * std::pow(kr, degree - 1));
    std::printf(
        "degree %d, k r = %.2f: normals %.1e = %.2f (kr)^%d, shape operators %.2e k = %.2f k (kr)^%d, "
        "principal curvatures %.2e k\n",
        degree, kr, worst(now.normal), normal, degree, worst(now.curvature) / kCurvature, curvature, degree - 1,
        worst(now.principal) / kCurvature);
    EXPECT_LT(normal, kNormalBound);
    EXPECT_LT(curvature, kCurvatureBound);
    if (!last.normal.empty()) {
      std::printf("  halving the edge: normals 1/%.1f, shape operators 1/%.1f\n",
                  worst(last.normal) / worst(now.normal), worst(last.curvature) / worst(now.curvature));
      EXPECT_GT(worst(last.normal) / worst(now.normal), kShareOfOrder * std::pow(2, degree));
      EXPECT_GT(worst(last.curvature) / worst(now.curvature), kShareOfOrder * std::pow(2, degree - 1));
    }
    last = now;
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, JetTwin, ::testing::Values(2, 3, 4));

void print_quantiles(const char* name, const Differences& d, double size) {
  std::printf(
      "  %s, %zu vertices: median, 95 %%, worst: normals %.1e %.1e %.1e, shape operators %.3f %.3f %.3f, "
      "principal curvatures %.3f %.3f %.3f of it; the jet from itself narrowed: median %.3f\n",
      name, d.size.size(), test::quantile(d.normal, 0.5), test::quantile(d.normal, 0.95), worst(d.normal),
      test::quantile(d.curvature, 0.5) / size, test::quantile(d.curvature, 0.95) / size, worst(d.curvature) / size,
      test::quantile(d.principal, 0.5) / size, test::quantile(d.principal, 0.95) / size, worst(d.principal) / size,
      test::quantile(d.narrower, 0.5) / size);
}

// A measured surface has shape and noise at every scale, so a fit's curvature depends on the radius it looks at. The
// kernel makes the blend look closer than an unweighted jet of the same radius: of radii from 0.4 to 1, the jet of 0.6
// was nearest to it (medians 0.16, 0.06 and 0.16 of the curvature at 0.4, 0.6 and 1). There the two must differ less
// than the jet from itself when its radius shrinks by 0.7: the choice of fit matters less than that of the radius.
constexpr double kMatched = 0.6;

TEST(JetTwinOnAFemur, DiffersByLessThanTheNoise) {
  const std::string file = "lenhart2015/ACLC01-R-femur-cart.stl";
  GENU_NEEDS_DATA(file);
  Diagnostics diagnostics;
  auto mesh = read_mesh(test::data_path(file), 1, diagnostics);
  ASSERT_TRUE(mesh);
  make_winding_consistent(*mesh, mesh_edges(*mesh));
  const auto surface = test::build(std::move(*mesh));
  const BlendFacts& facts = surface->facts();
  const Differences same = compare(*surface, facts.fit_radius, facts.degree, 200);
  const Differences matched = compare(*surface, kMatched * facts.fit_radius, facts.degree, 200);
  ASSERT_GE(same.size.size(), 100u);
  const double size = test::quantile(same.size, 0.5);
  std::printf("degree %d, fit radius %.2f mm, median curvature %.0f 1/m\n", facts.degree, 1e3 * facts.fit_radius, size);
  print_quantiles("same radius", same, size);
  print_quantiles("jet of 0.6 radii", matched, size);
  EXPECT_LT(test::quantile(same.normal, 0.5), 0.01);
  EXPECT_LT(test::quantile(same.curvature, 0.5), 0.25 * size);
  EXPECT_LT(test::quantile(matched.curvature, 0.95), 0.25 * size);
  EXPECT_LT(test::quantile(matched.curvature, 0.5), test::quantile(matched.narrower, 0.5));
}

}  // namespace
}  // namespace genu
