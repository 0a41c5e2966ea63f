// residual SCENE: finds an equilibrium with a solver of its own.
//   residual tests/examples/hanging_bone.toml
//   1. read a scene without rigid contacts
//   2. Newton's method on its residual with its stiffness, from where the scene starts
//   3. print the coordinates (rad, m) and what is left of the residual
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <genu/genu.h>

namespace {

/// Gaussian elimination with row pivoting: x of A x = b.
std::vector<double> solve(genu::api::Matrix a, std::vector<double> b) {
  const std::size_t n = b.size();
  const auto at = [&](std::size_t i, std::size_t j) -> double& { return a.values[i * n + j]; };
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    for (std::size_t j = 0; j < n; ++j) std::swap(at(k, j), at(pivot, j));
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = at(i, k) / at(k, k);
      for (std::size_t j = k; j < n; ++j) at(i, j) -= factor * at(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= at(k, j) * b[j];
    b[k] /= at(k, k);
  }
  return b;
}

double size_of(const std::vector<double>& x) {
  double square = 0;
  for (const double v : x) square += v * v;
  return std::sqrt(square);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: residual SCENE\n"), 2;
  try {
    const genu::api::Scene scene = genu::api::load(argv[1]);
    std::vector<double> q = scene.start(), forces = scene.residual(q);
    constexpr int kMost = 50;
    constexpr double kSmall = 1e-10;  // N and N m
    int steps = 0;
    while (size_of(forces) > kSmall && steps++ < kMost) {
      const std::vector<double> step = solve(scene.stiffness(q), forces);
      for (std::size_t k = 0; k < q.size(); ++k) q[k] += step[k];
      forces = scene.residual(q);
    }
    const std::vector<std::string> names = scene.coordinates();
    for (std::size_t k = 0; k < q.size(); ++k) std::printf("%s,%.17g\n", names[k].c_str(), q[k]);
    std::fprintf(stderr, "residual %.2g after %d steps\n", size_of(forces), steps);
    return size_of(forces) <= kSmall ? 0 : 3;
  } catch (const genu::api::SceneError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
