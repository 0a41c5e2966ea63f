// A fit must give back a polynomial of its own degree, see one sheet only, and cope with few vertices.
#include "genu/surface/local_fit.h"

#include <gtest/gtest.h>

#include "support/blend_meshes.h"
#include "support/finite_difference.h"

namespace genu {
namespace {

TEST(HeightPolynomial, DerivativesAgreeWithDifferences) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-1, 1);
  double c[kMaxCoefficients];
  for (double& v : c) v = draw(random);
  for (int k = 0; k < 50; ++k) {
    const double u = draw(random), v = draw(random);
    const Height s = evaluate_height<4, 2>(c, u, v);
    double direct = 0;
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; j <= 4 - i; ++j) direct += c[coefficient_index(4, i, j)] * std::pow(u, i) * std::pow(v, j);
    }
    const auto at = [&](double a, double b) { return evaluate_height<4, 2>(c, a, b); };
    EXPECT_NEAR(s.h, direct, 1e-13);
    EXPECT_NEAR(s.hu, test::derivative([&](double t) { return at(u + t, v).h; }, 1e-3), 1e-9);
    EXPECT_NEAR(s.hv, test::derivative([&](double t) { return at(u, v + t).h; }, 1e-3), 1e-9);
    EXPECT_NEAR(s.huu, test::derivative([&](double t) { return at(u + t, v).hu; }, 1e-3), 1e-9);
    EXPECT_NEAR(s.huv, test::derivative([&](double t) { return at(u, v + t).hu; }, 1e-3), 1e-9);
    EXPECT_NEAR(s.hvv, test::derivative([&](double t) { return at(u, v + t).hv; }, 1e-3), 1e-9);
  }
}

HeightFit fit_at(const Mesh& mesh, int v, double radius, int degree) {
  const VertexGraph graph = vertex_graph(mesh);
  return HeightFitter(mesh, graph).fit({mesh.vertices[v], graph.normals[v], std::span(&v, 1), radius, degree, true});
}

/// Worst distance (m) of the fit from z = height(x, y) along its own normal, within `reach` of its origin.
template <class F>
double worst_error(const HeightFit& fit, F&& height, double reach) {
  double worst = 0;
  for (double u = -reach; u <= reach; u += reach / 5) {
    for (double v = -reach; v <= reach; v += reach / 5) {
      const Vec3 p = fit.origin + fit.axes * Vec3(u, v, fit.height(u, v).h);
      worst = std::max(worst, std::abs(p.z() - height(p.x(), p.y())));
    }
  }
  return worst;
}

TEST(LocalFit, GivesBackAPolynomialOfItsDegree) {
  // Level at the origin, so that the frame there is the polynomial's own but for the mesh's own asymmetry.
  const auto quadric = [](double x, double y) { return 0.3 + 2 * x * x - 3 * x * y + y * y; };
  const Mesh flat = test::jittered_patch(0.3, 0.02, [](double x, double y) { return 0.2 * x - 0.1 * y; });
  const int middle = static_cast<int>(flat.vertices.size()) / 2;
  const HeightFit plane = fit_at(flat, middle, 0.08, 2);
  EXPECT_LT(worst_error(
                plane, [](double x, double y) { return 0.2 * x - 0.1 * y; }, 0.05),
            1e-14);
  EXPECT_LT(plane.residual_rms, 1e-14);
  const Mesh curved = test::jittered_patch(0.3, 0.02, quadric);
  const double cubic = worst_error(fit_at(curved, middle, 0.08, 3), quadric, 0.05);
  const double quartic = worst_error(fit_at(curved, middle, 0.08, 4), quadric, 0.05);
  EXPECT_LT(cubic, 2e-4);
  EXPECT_LT(quartic, cubic / 3);
}

TEST(LocalFit, SeesOneSheetOnly) {
  const auto top = [](double x, double y) { return 0.5 * x * x + y * y; };
  const auto bottom = [=](double x, double y) { return top(x, y) - 0.03; };
  const Mesh single = test::jittered_patch(0.3, 0.02, top);
  for (bool flipped : {false, true}) {
    const Mesh both = test::joined(single, test::jittered_patch(0.3, 0.02, bottom, flipped, 9));
    const int middle = static_cast<int>(single.vertices.size()) / 2;
    EXPECT_EQ(fit_at(single, middle, 0.1, 3).coefficients, fit_at(both, middle, 0.1, 3).coefficients);
  }
}

TEST(LocalFit, WidensAndLowersItsDegreeWhereVerticesAreFew) {
  const auto flat = [](double, double) { return 0.0; };
  const Mesh mesh = test::jittered_patch(0.1, 0.02, flat);
  const HeightFit corner = fit_at(mesh, 0, 0.04, 3);
  EXPECT_EQ(corner.degree, 3);
  EXPECT_GT(corner.radius, 0.04);
  const HeightFit scrap = fit_at(test::jittered_patch(0.03, 0.02, flat), 0, 0.04, 3);  // 16 vertices, not all in reach
  EXPECT_GE(scrap.degree, kMinDegree);
  const HeightFit none = fit_at(test::jittered_patch(0.01, 0.02, flat), 0, 0.04, 3);  // 4 vertices
  EXPECT_EQ(none.degree, 0);
}

}  // namespace
}  // namespace genu
