#include "genu/mesh_care/noise_field.h"

#include <cmath>
#include <numbers>
#include <random>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "genu/mesh/vertex_graph.h"
#include "genu/mesh_care/tolerances.h"

namespace genu {
namespace {

/// cos(wave . x + phase): with normal wave vectors of variance 2 / l^2 the mean product of two values is half the
/// Gaussian correlation (random Fourier features, Rahimi and Recht 2007).
struct Wave {
  Vec3 wave;
  double phase;
};

std::vector<Wave> draw_waves(double length, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, std::numbers::sqrt2);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  std::vector<Wave> waves(kNoiseWaves);
  for (Wave& w : waves) {
    for (int axis = 0; axis < 3; ++axis) w.wave[axis] = normal(random) / length;
    w.phase = angle(random);
  }
  return waves;
}

}  // namespace

std::vector<double> noise_field(const std::vector<Vec3>& points, const MeshNoise& noise, std::uint64_t seed) {
  std::vector<double> heights(points.size(), 0.0);
  if (!(noise.rms > 0)) return heights;
  if (!(noise.correlation_length > 0)) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, noise.rms);
    for (double& h : heights) h = normal(random);
    return heights;
  }
  const std::vector<Wave> waves = draw_waves(noise.correlation_length, seed);
  const double scale = noise.rms * std::sqrt(2.0 / kNoiseWaves);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      double sum = 0;
      for (const Wave& w : waves) sum += std::cos(w.wave.dot(points[i]) + w.phase);
      heights[i] = scale * sum;
    }
  });
  return heights;
}

Mesh perturbed(const Mesh& mesh, const MeshNoise& noise, std::uint64_t seed) {
  const VertexGraph graph = vertex_graph(mesh);
  const std::vector<double> heights = noise_field(mesh.vertices, noise, seed);
  Mesh out = mesh;
  for (std::size_t v = 0; v < out.vertices.size(); ++v) out.vertices[v] += heights[v] * graph.normals[v];
  return out;
}

}  // namespace genu
