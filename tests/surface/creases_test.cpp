// Creases are found on shells, boxes and roofs, and on no bone; fits stop at them and the noise is that of the rest.
#include "genu/surface/creases.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "genu/mesh_care/noise_field.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/surface/fit_choice.h"
#include "genu/surface/local_fit.h"
#include "support/blend_meshes.h"
#include "support/data.h"
#include "support/shells.h"

namespace genu {
namespace {

Mesh bowl(double half, double edge) {
  return test::jittered_patch(half, edge, [](double x, double y) { return 12.5 * (x * x + y * y); });
}

TEST(Creases, RoundShapesHaveNone) {
  for (const double noise : {0.0, 5e-6, 50e-6, 200e-6}) {
    EXPECT_TRUE(graph_with_creases(test::jittered_torus(15e-3, 5e-3, 0.5e-3, noise)).near_crease.empty()) << noise;
    EXPECT_TRUE(graph_with_creases(test::jittered_torus(30e-3, 12e-3, 2e-3, noise)).near_crease.empty()) << noise;
    EXPECT_TRUE(graph_with_creases(perturbed(bowl(25e-3, 1e-3), {noise, 2e-3}, 5)).near_crease.empty()) << noise;
  }
  EXPECT_TRUE(graph_with_creases({}).near_crease.empty());
}

TEST(Creases, MeasuredCartilageHasNone) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  for (const std::string bone : {"femur", "tibia", "patella"})
    for (const std::string resolution : {"", "-medium", "-coarse"}) {
      const std::string name = "lenhart2015/ACLC01-R-" + bone + (bone == "patella" ? "-cart_shift" : "-cart");
      Diagnostics out;
      const auto mesh = read_mesh(test::data_path(name + resolution + ".stl"), 1, out);
      ASSERT_TRUE(mesh) << name;
      EXPECT_TRUE(graph_with_creases(*mesh).near_crease.empty()) << name << resolution;
    }
}

TEST(Creases, OfABoxAreItsEdges) {
  const Mesh box = test::box({-10e-3, -10e-3, -5e-3}, {10e-3, 10e-3, 5e-3}, 20);
  const VertexGraph graph = graph_with_creases(box);
  ASSERT_EQ(graph.near_crease.size(), box.vertices.size());
  for (std::size_t v = 0; v < box.vertices.size(); ++v) {
    const Vec3 x = box.vertices[v].cwiseAbs();
    const int sides = (x.x() > 9.999e-3) + (x.y() > 9.999e-3) + (x.z() > 4.999e-3);
    EXPECT_EQ(graph.is_on_crease(static_cast<int>(v)), sides > 1) << box.vertices[v].transpose();
    const bool near = graph.is_near_crease(static_cast<int>(v));
    EXPECT_FALSE(near && x.head<2>().maxCoeff() < 6e-3) << box.vertices[v].transpose();
    EXPECT_TRUE(near || sides < 2) << box.vertices[v].transpose();
  }
}

/// A roof of two planes: fits beside the ridge know one of them only.
TEST(Creases, FitsStopThere) {
  const Mesh roof = test::jittered_patch(15e-3, 1e-3, [](double x, double) { return -0.3 * std::abs(x - 0.3e-3); });
  const VertexGraph graph = graph_with_creases(roof);
  ASSERT_FALSE(graph.near_crease.empty());
  HeightFitter fitter(roof, graph);
  int fits = 0;
  for (int v = 0; v < static_cast<int>(roof.vertices.size()); ++v) {
    const Vec3& x = roof.vertices[static_cast<std::size_t>(v)];
    if (graph.is_on_crease(v) || std::abs(x.x() - 0.3e-3) < 1.5e-3 || x.cwiseAbs().maxCoeff() > 14e-3) continue;
    const HeightFit fit = fitter.fit({x, graph.normals[static_cast<std::size_t>(v)], std::span(&v, 1), 4e-3, 3, true});
    ASSERT_GT(fit.degree, 0);
    EXPECT_LT(fit.residual_rms, 1e-12);
    ++fits;
  }
  EXPECT_GT(fits, 500);
}

TEST(Creases, NoiseOfAShellIsThatOfItsFaces) {
  for (const MeshNoise noise : {MeshNoise{0, 0}, MeshNoise{5e-6, 0}, MeshNoise{20e-6, 1e-3}, MeshNoise{20e-6, 2e-3}}) {
    const Mesh sheet = perturbed(bowl(15e-3, 0.8e-3), noise, 3), shell = test::thickened(sheet, 2.5e-3);
    const VertexGraph graph = graph_with_creases(shell);
    ASSERT_FALSE(graph.near_crease.empty());
    const FitChoice open = choose_fit(sheet, graph_with_creases(sheet), std::nullopt, std::nullopt),
                    closed = choose_fit(shell, graph, std::nullopt, std::nullopt);
    std::printf("noise %.0f um over %.0f mm: seen %.3g um on the sheet, %.3g on the shell; fit radius %.2f, %.2f mm\n",
                1e6 * noise.rms, 1e3 * noise.correlation_length, 1e6 * open.noise.rms, 1e6 * closed.noise.rms,
                1e3 * open.radius, 1e3 * closed.radius);
    EXPECT_LE(closed.noise.rms, 2 * noise.rms + 0.2e-6);
    EXPECT_GE(closed.noise.rms, 0.5 * noise.rms);
    EXPECT_NEAR(closed.radius, open.radius, 0.25 * open.radius);
  }
}

TEST(Creases, AreTheSameForAnyNumberOfThreads) {
  const Mesh shell = test::thickened(perturbed(bowl(15e-3, 0.8e-3), {20e-6, 1e-3}, 3), 2.5e-3);
  const VertexGraph many = graph_with_creases(shell);
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const VertexGraph one = graph_with_creases(shell);
  EXPECT_EQ(one.near_crease, many.near_crease);
  EXPECT_EQ(one.on_crease, many.on_crease);
}

}  // namespace
}  // namespace genu
