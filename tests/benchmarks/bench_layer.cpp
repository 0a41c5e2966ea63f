// How long an elastic layer takes that is evaluated with its tangent along a path, beside a plain elastic foundation
// that knows nothing of the pose before (every triangle casts its ray into the same tree), both on one core:
// build/bin/bench_layer. Both sums must agree. Exit code 1 where they do not, where the layer is less than 10 times as
// fast with as many triangles on both bodies, or where ten times the triangles make a triangle in contact dearer.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "genu/contact/triangle_layer.h"
#include "genu/core/timer.h"
#include "support/layers.h"

namespace {

using namespace genu;

constexpr double kDepth = 6e-3, kThickness = 6e-3, kModulus = 10e6;
constexpr int kPoses = 30, kRounds = 7, kEvaluations = 3;  // evaluations of Newton's method at each pose

LayerLaw law() {
  LayerLaw law;
  law.confined_modulus = kModulus;
  return law;
}

/// A ball that rolls over a dished plate by 0.4 mm a pose, as a condyle does by a degree of flexion; the three
/// evaluations of a pose come closer and closer, as Newton's method does.
std::vector<Pose> path() {
  std::vector<Pose> poses;
  for (int k = 0; k < kPoses; ++k)
    for (int i = 0; i < kEvaluations; ++i) {
      const double off = std::pow(10.0, -2 * (i + 1)) * 1e-3;
      poses.push_back(Pose{exp_rotation({0, 0.0175 * k, 0}), {0.4e-3 * k - 6e-3, 0, 20e-3 - 0.5e-3 + off}}.inverse());
    }
  return poses;
}

/// What a foundation without any memory does.
LayerSum plain(const Mesh& casting, const TriangleTree& target, const Pose& X_TC) {
  LayerSum out;
  for (const auto& t : casting.triangles) {
    const auto v = [&](std::size_t i) -> const Vec3& { return casting.vertices[static_cast<std::size_t>(t[i])]; };
    const Vec3 area = 0.5 * (v(1) - v(0)).cross(v(2) - v(0)), x = (v(0) + v(1) + v(2)) / 3, n = area.normalized();
    const Vec3 direction = -(X_TC.R * n);
    const auto hit = target.leaving(X_TC * x, direction, kDepth);
    if (!hit) continue;
    const LayerLaw::Pressure p = law().at(hit.distance, kThickness);
    const Vec3& plane = target.area_vector(hit.triangle);
    const Vec3 w = X_TC.R.transpose() * (plane / -plane.dot(direction));
    add_pressure(x, n, x - hit.distance * n, w, p.p * area.norm(), p.slope * area.norm(), out);
    out.load += p.p * area.norm();
  }
  return out;
}

struct Times {
  double warm = 0, plain = 0;  ///< s per evaluation, median
  double worst = 0;            ///< of the load, relative
  int touching = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Times measure(const Mesh& casting, const Mesh& target_mesh) {
  const auto target = std::make_shared<const TriangleTree>(target_mesh);
  const TriangleLayer layer(casting, target, kDepth, law(), {kThickness, nullptr, nullptr});
  const std::vector<Pose> poses = path();
  Times times;
  std::vector<double> warm, cold;
  for (int round = 0; round < kRounds; ++round) {
    TriangleLayer::Memory memory;
    std::vector<LayerSum> sums(poses.size()), expected(poses.size());
    layer.add(poses[0], memory, sums[0]);  // the first pose of a path is cold
    sums[0] = {};
    const Timer timer;
    for (std::size_t k = 0; k < poses.size(); ++k) layer.add(poses[k], memory, sums[k]);
    warm.push_back(timer.seconds() / static_cast<double>(poses.size()));
    const Timer again;
    for (std::size_t k = 0; k < poses.size(); ++k) expected[k] = plain(casting, *target, poses[k]);
    cold.push_back(again.seconds() / static_cast<double>(poses.size()));
    for (std::size_t k = 0; k < poses.size(); ++k)
      times.worst = std::max(times.worst, std::abs(sums[k].load - expected[k].load) / expected[k].load);
    int touching = 0;
    layer.visit(poses.back(), memory, [&](const LayerPoint&) { ++touching; });
    times.touching = touching;
  }
  times.warm = median(warm);
  times.plain = median(cold);
  return times;
}

/// A square dish |x|, |y| <= half, of `n` squares a side.
Mesh dish(double half, int n) {
  Mesh mesh = test::sheet(half, n);
  for (Vec3& v : mesh.vertices) v.z() = v.head<2>().squaredNorm() / (2 * 60e-3);
  return mesh;
}

/// A ball with about `triangles` of them.
Mesh ball(double triangles) {
  return test::ball(20e-3, std::sqrt(4 * M_PI * 20e-3 * 20e-3 / triangles * 4 / std::sqrt(3.0)));
}

}  // namespace

int main() {
  bool good = true;
  fmt::print("{:<34}{:>10}{:>10}{:>10}{:>12}{:>12}{:>8}\n", "layer, evaluated with its tangent", "triangles",
             "of other", "touching", "warm [us]", "plain [us]", "ratio");
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  const auto row = [&](const char* name, const Mesh& casting, const Mesh& target) {
    const Times t = measure(casting, target);
    fmt::print("{:<34}{:>10}{:>10}{:>10}{:>12.1f}{:>12.1f}{:>8.1f}\n", name, casting.triangles.size(),
               target.triangles.size(), t.touching, 1e6 * t.warm, 1e6 * t.plain, t.plain / t.warm);
    good = good && t.worst < 1e-12;
    return t;
  };
  for (const Times& t : {row("10k triangles a body", dish(30e-3, 71), ball(1e4)),
                         row("100k triangles a body", dish(30e-3, 224), ball(1e5))})
    good = good && t.plain > 10 * t.warm;
  const Times small = row("10k, the same triangles", dish(10e-3, 71), ball(1e5)),
              large = row("100k, the same triangles", dish(31.6e-3, 224), ball(1e5));
  return good && large.warm / large.touching < 1.5 * small.warm / small.touching ? 0 : 1;
}
