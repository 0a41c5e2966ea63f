// The spectrum of a patch: polynomials lie in their degree, noise where its covariance puts it.
#include "genu/surface/patch_shells.h"

#include <cstdio>
#include <numeric>

#include <gtest/gtest.h>

#include "genu/mesh_care/noise_field.h"
#include "support/blend_meshes.h"

namespace genu {
namespace {

TEST(PatchShells, APolynomialHasNothingAboveItsDegree) {
  const Mesh flat = test::jittered_patch(10e-3, 1e-3, [](double, double) { return 0.0; });
  const VertexGraph graph = vertex_graph(flat);
  for (int degree = 2; degree <= kShellDegree; ++degree) {
    Mesh mesh = flat;
    for (Vec3& v : mesh.vertices) v.z() = 1e-9 * std::pow((v.x() - 2 * v.y()) / 1e-3, degree);
    ShellFitter fitter(mesh, graph);  // the flat mesh's normals: the frame in which it is a polynomial
    ShellEnergies e;
    const int middle = static_cast<int>(mesh.vertices.size()) / 2;
    ASSERT_TRUE(fitter.energies(middle, 4e-3, e));
    const std::size_t own = static_cast<std::size_t>(degree);
    for (std::size_t shell = own + 1; shell < kShells; ++shell) EXPECT_LT(e[shell], 1e-20 * e[own]) << degree;
  }
  ShellEnergies e;
  EXPECT_FALSE(ShellFitter(flat, graph).energies(0, 2e-3, e));  // too few vertices
}

TEST(PatchShells, NoiseHasTheEnergiesThatItsCovarianceSays) {
  const Mesh flat = test::jittered_patch(40e-3, 1e-3, [](double, double) { return 0.0; });
  for (double length : {0.0, 2e-3, 4e-3}) {
    ShellEnergies mean{};
    int count = 0;
    double samples = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Mesh noisy = perturbed(flat, {1e-6, length}, seed);
      const VertexGraph graph = vertex_graph(noisy);
      ShellFitter fitter(noisy, graph);
      for (std::size_t v = 0; v < noisy.vertices.size(); v += 7) {
        const Vec3& p = noisy.vertices[v];
        ShellEnergies e;
        if (p.head<2>().cwiseAbs().maxCoeff() > 34e-3 || !fitter.energies(static_cast<int>(v), 5e-3, e)) continue;
        for (std::size_t shell = 0; shell < kShells; ++shell) mean[shell] += e[shell];
        samples += fitter.samples();
        ++count;
      }
    }
    const ShellEnergies expected = NoiseShells(static_cast<int>(samples / count)).energies(length / 5e-3);
    std::printf("length %.0f mm, measured / expected energy of degrees 2 .. 5, rest:", 1e3 * length);
    for (std::size_t shell = 2; shell < kShells; ++shell) {
      const double ratio = mean[shell] / count / (1e-12 * expected[shell]);
      std::printf(" %.2f", ratio);
      // The highest degrees of a field that wide hold little, and what aliases into them depends on the grid.
      EXPECT_NEAR(ratio, 1, expected[shell] > 0.01 ? 0.25 : 0.5) << shell;
    }
    std::printf("\n");
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 1, 1e-12);
  }
}

}  // namespace
}  // namespace genu
