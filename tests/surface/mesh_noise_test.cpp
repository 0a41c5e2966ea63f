// Known noise on known shapes is found to a factor of 2; shape alone is none.
#include "genu/surface/mesh_noise.h"

#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "genu/mesh_care/noise_field.h"
#include "support/blend_meshes.h"

namespace genu {
namespace {

struct ShapedMesh {
  std::string name;
  double edge;  ///< m
  Mesh mesh;
};

/// A sphere of radius 1 split `levels` times, stretched.
Mesh ellipsoid(int levels) {
  Mesh mesh = test::noisy_sphere(1, levels, 0);
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(Vec3(30e-3, 22e-3, 18e-3));
  return mesh;
}

Mesh bowl(double edge) {
  return test::jittered_patch(25e-3, edge, [](double x, double y) { return 12.5 * (x * x + y * y) + 60 * x * y * y; });
}

std::vector<ShapedMesh> shaped_meshes() {
  return {{"bowl", 0.5e-3, bowl(0.5e-3)},
          {"bowl", 1e-3, bowl(1e-3)},
          {"bowl", 2e-3, bowl(2e-3)},
          {"ellipsoid", 1e-3, ellipsoid(5)},
          {"ellipsoid", 2e-3, ellipsoid(4)},
          {"torus of 30 and 12 mm", 1e-3, test::jittered_torus(30e-3, 12e-3, 1e-3)},
          {"torus of 30 and 12 mm", 2e-3, test::jittered_torus(30e-3, 12e-3, 2e-3)}};
}

MeshNoise seen(const Mesh& mesh) { return estimate_noise(mesh, vertex_graph(mesh)); }

TEST(MeshNoise, ExactShapesHaveNone) {
  std::vector<ShapedMesh> all = shaped_meshes();
  // A tube of radius 5 mm: at the last edge each patch goes half round it.
  for (double edge : {0.25e-3, 0.5e-3, 1e-3, 2e-3})
    all.push_back({"torus of 15 and 5 mm", edge, test::jittered_torus(15e-3, 5e-3, edge)});
  for (const ShapedMesh& shape : all)
    EXPECT_EQ(seen(shape.mesh).rms, 0) << shape.name << ", edge " << 1e3 * shape.edge << " mm";
  EXPECT_EQ(seen({}).rms, 0);
}

/// Whether the noise stands out of these shapes: the wider it is correlated the more it looks like shape.
bool stands_out(const ShapedMesh& shape, const MeshNoise& noise) {
  const bool coarse_torus = shape.name[0] == 't' && shape.edge > 1.5e-3;
  if (noise.correlation_length > 4e-3) return noise.rms > 50e-6;
  if (noise.correlation_length > 1e-3 && coarse_torus) return noise.rms > 50e-6;
  if (noise.correlation_length > 0 || coarse_torus) return noise.rms > 5e-6;
  return true;
}

TEST(MeshNoise, KnownNoiseIsFoundToAFactorOfTwo) {
  double worst = 1, worst_length = 1;
  int cases = 0;
  for (const ShapedMesh& shape : shaped_meshes()) {
    for (const MeshNoise& noise :
         {MeshNoise{0.5e-6, 0}, MeshNoise{10e-6, 0}, MeshNoise{10e-6, 1e-3}, MeshNoise{10e-6, 2e-3},
          MeshNoise{10e-6, 4e-3}, MeshNoise{100e-6, 0}, MeshNoise{100e-6, 1e-3}, MeshNoise{100e-6, 2e-3},
          MeshNoise{100e-6, 4e-3}, MeshNoise{100e-6, 6e-3}}) {
      const MeshNoise found = seen(perturbed(shape.mesh, noise, 5));
      const std::string what = fmt::format(
          "{}, edge {:g} mm, {:g} um over {:g} mm: found {:.3g} um over {:.2g} mm", shape.name, 1e3 * shape.edge,
          1e6 * noise.rms, 1e3 * noise.correlation_length, 1e6 * found.rms, 1e3 * found.correlation_length);
      // What cannot be told from shape may be missed, never exaggerated.
      EXPECT_LT(found.rms, 2 * noise.rms) << what;
      if (!stands_out(shape, noise)) continue;
      // One sample of a field that is correlated over 6 mm is not much to tell its rms by.
      const double factor = noise.correlation_length > 4e-3 ? 2.5 : 2;
      EXPECT_GT(found.rms, noise.rms / factor) << what;
      worst = std::max({worst, found.rms / noise.rms, noise.rms / found.rms});
      ++cases;
      if (noise.correlation_length < 1.5 * shape.edge) {
        EXPECT_LT(found.correlation_length, 2 * shape.edge) << what;  // as good as white
      } else {
        const double ratio = found.correlation_length / noise.correlation_length;
        EXPECT_GT(ratio, 0.5) << what;
        EXPECT_LT(ratio, 2) << what;
        worst_length = std::max({worst_length, ratio, 1 / ratio});
      }
    }
  }
  std::printf("%d cases: rms wrong by a factor of at most %.2f, correlation length %.2f\n", cases, worst, worst_length);
}

TEST(MeshNoise, SeesNanometresWhereTheShapeAllowsIt) {
  for (double edge : {0.5e-3, 1e-3, 2e-3}) {
    const MeshNoise found = seen(perturbed(bowl(edge), {1e-9, 0}, 4));
    std::printf("bowl, edge %.1f mm, 1 nm: found %.2f nm over %.2f mm\n", 1e3 * edge, 1e9 * found.rms,
                1e3 * found.correlation_length);
    EXPECT_GT(found.rms, 0.5e-9);
    EXPECT_LT(found.rms, 2e-9);
    EXPECT_LT(found.correlation_length, 2 * edge);
  }
}

TEST(MeshNoise, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = perturbed(bowl(1e-3), {15e-6, 2e-3}, 1);
  const MeshNoise many = seen(mesh);
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const MeshNoise one = seen(mesh);
  EXPECT_EQ(one.rms, many.rms);
  EXPECT_EQ(one.correlation_length, many.correlation_length);
  EXPECT_GT(one.rms, 0);
}

}  // namespace
}  // namespace genu
