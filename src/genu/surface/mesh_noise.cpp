#include "genu/surface/mesh_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <Eigen/LU>

#include "genu/mesh/tolerances.h"
#include "genu/surface/patch_shells.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr std::size_t kFirstShell = 2;  // degrees 0 and 1 are how the patch lies

/// m: the largest coordinate.
double size_of(const Mesh& mesh) {
  double size = 0;
  for (const Vec3& v : mesh.vertices) size = std::max(size, v.cwiseAbs().maxCoeff());
  return size;
}

/// Medians over the mesh of the energies within one radius.
struct Band {
  int step = 0;  ///< radius = narrowest * sqrt(2)^step
  double radius = 0;
  int samples = 0;  ///< 0 where too few patches have enough vertices
  ShellEnergies energies{};
};

template <class T>
T median(std::vector<T>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Fitters = tbb::enumerable_thread_specific<ShellFitter>;

Band measure(const Mesh& mesh, const VertexGraph& graph, Fitters& fitters, double radius) {
  // Beside creases fewer patches are whole: more are tried.
  const std::size_t probes = graph.near_crease.empty() ? kNoiseProbes : kCreasedNoiseProbes;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / probes);
  const std::size_t count = (mesh.vertices.size() + step - 1) / step;
  std::vector<ShellEnergies> found(count);
  std::vector<int> samples(count, 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4), [&](const auto& range) {
    ShellFitter& fitter = fitters.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const int v = static_cast<int>(i * step);
      if (graph.component[v] >= 0 && fitter.energies(v, radius, found[i])) samples[i] = fitter.samples();
    }
  });
  Band band;
  band.radius = radius;
  std::vector<double> values;
  for (std::size_t shell = kFirstShell; shell < kShells; ++shell) {
    values.clear();
    for (std::size_t i = 0; i < count; ++i) {
      if (samples[i] > 0) values.push_back(found[i][shell]);
    }
    if (values.size() < kMinProbes) return band;
    band.energies[shell] = std::max(median(values), kTinyEnergy);
  }
  std::erase(samples, 0);
  band.samples = median(samples);
  return band;
}

std::vector<Band> measure_all(const Mesh& mesh, const VertexGraph& graph) {
  Fitters fitters([&] { return ShellFitter(mesh, graph); });
  const int components = 1 + *std::max_element(graph.component.begin(), graph.component.end());
  const double widest = kMaxPatchOfSheet * std::sqrt(graph.area / std::max(1, components));
  std::vector<Band> bands;
  for (int step = 0; step < kMaxBands; ++step) {
    const double radius = kNarrowestPatch * graph.median_edge * std::pow(2, 0.5 * step);
    if (step >= kMinBands && radius > widest) break;
    Band band = measure(mesh, graph, fitters, radius);
    band.step = step;
    if (band.samples == 0) continue;
    if (std::sqrt(band.energies[2]) > kMaxPatchCurvature * radius) break;
    bands.push_back(band);
  }
  return bands;
}

/// One median beside what unit amplitudes of shape (even and odd degrees) and noise would give.
struct Row {
  double measured = 0;
  Vec3 unit = Vec3::Zero();
};

double misfit(const std::vector<Row>& rows, const Vec3& amplitudes) {
  double sum = 0;
  for (const Row& r : rows) sum += std::pow(std::log(r.measured / std::max(r.unit.dot(amplitudes), kTinyEnergy)), 2);
  return sum;
}

/// The least squares solution of the normal equations with amplitudes >= 0: the best of all subsets.
Vec3 solve_nonnegative(const Mat3& normal, const Vec3& right) {
  // Columns differ by many orders of magnitude.
  const Vec3 scale = normal.diagonal().cwiseSqrt().cwiseMax(kTinyEnergy).cwiseInverse();
  const Mat3 N = scale.asDiagonal() * normal * scale.asDiagonal();
  const Vec3 b = scale.cwiseProduct(right);
  Vec3 best = Vec3::Zero();
  double least = 0;
  for (int subset = 1; subset < 8; ++subset) {
    Mat3 part = Mat3::Identity();
    Vec3 side = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      if ((subset >> i & 1) == 0) continue;
      side[i] = b[i];
      for (int j = 0; j < 3; ++j) {
        if ((subset >> j & 1) != 0) part(i, j) = N(i, j);
      }
    }
    const Vec3 x = part.inverse() * side;
    if (!x.allFinite() || x.minCoeff() < 0) continue;
    const double cost = x.dot(N * x) - 2 * x.dot(b);
    if (cost < least) least = cost, best = x;
  }
  return scale.cwiseProduct(best);
}

/// The amplitudes with about the least misfit: relative errors first, weights from the last model then.
Vec3 fit_amplitudes(const std::vector<Row>& rows, bool with_noise) {
  Vec3 x = Vec3::Zero();
  for (int round = 0; round <= kReweightings; ++round) {
    Mat3 normal = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (const Row& r : rows) {
      const double model = round == 0 ? r.measured : std::max(r.unit.dot(x), 1e-3 * r.measured);
      const double root = std::sqrt(r.measured * model);
      const Vec3 a = Vec3(r.unit[0], r.unit[1], with_noise ? r.unit[2] : 0) / root;
      normal += a * a.transpose();
      right += a * (r.measured / root);
    }
    x = solve_nonnegative(normal, right);
  }
  return x;
}

/// The mixture of shape and noise that the medians are compared with.
class Mixture {
 public:
  explicit Mixture(const std::vector<Band>& bands) : bands_(bands), first_(bands.front().radius) {
    for (const Band& band : bands) {
      for (std::size_t shell = kFirstShell; shell < kShells; ++shell)
        rows_.push_back({band.energies[shell], Vec3::Zero()});
      references_.try_emplace(band.samples, band.samples);
    }
  }

  struct Fit {
    double misfit = std::numeric_limits<double>::infinity();
    double noise_rms = 0;
  };

  /// The best shape length with the noise that set_noise() left, or without any.
  Fit best(bool with_noise) {
    Fit fit;
    for (int s = 1; s <= kShapeLengths; ++s) {
      set_shape(first_ * std::pow(2, 0.5 * s));
      const Vec3 x = fit_amplitudes(rows_, with_noise);
      const double cost = misfit(rows_, x);
      if (cost < fit.misfit) fit = {cost, std::sqrt(x[2])};
    }
    return fit;
  }

  /// n = 0: white.
  double length(int n) const {
    return n == 0 ? 0 : first_ * std::pow(2, -0.5 * bands_.front().step) * kShortestNoise * std::pow(2, 0.25 * (n - 1));
  }

  void set_noise(int n) {
    auto row = rows_.begin();
    for (const Band& band : bands_) {
      // Bands of as many vertices share what depends on the ratio of length and radius alone.
      const auto [known, fresh] = known_.try_emplace({band.samples, n == 0 ? -1000 : n - 2 * band.step});
      if (fresh) known->second = references_.at(band.samples).energies(length(n) / band.radius);
      for (std::size_t shell = kFirstShell; shell < kShells; ++shell, ++row) {
        // A sum of squares of m + 1 numbers: its median lies below its mean (Wilson and Hilferty 1931).
        const double freedom = shell + 1 < kShells ? static_cast<double>(shell + 1) : 2.0 * kShells;
        row->unit[2] = known->second[shell] * std::pow(1 - 2 / (9 * freedom), 3);
      }
    }
  }

 private:
  void set_shape(double length) {
    auto row = rows_.begin();
    for (const Band& band : bands_) {
      const double ratio = std::pow(band.radius / length, 2);
      for (std::size_t shell = kFirstShell; shell < kShells; ++shell, ++row) {
        const double power = std::pow(ratio, static_cast<double>(shell));
        const bool rest = shell + 1 == kShells;  // degrees 6 and 7
        row->unit[0] = shell % 2 == 0 ? power : 0;
        row->unit[1] = rest ? power * ratio : shell % 2 == 1 ? power : 0;
      }
    }
  }

  const std::vector<Band>& bands_;
  double first_;
  std::vector<Row> rows_;
  std::map<int, NoiseShells> references_;
  std::map<std::pair<int, int>, ShellEnergies> known_;
};

}  // namespace

MeshNoise estimate_noise(const Mesh& mesh, const VertexGraph& graph) {
  if (!(graph.median_edge > 0)) return {};
  const std::vector<Band> bands = measure_all(mesh, graph);
  if (bands.size() < kMinBands) return {};
  Mixture mixture(bands);
  const double without = mixture.best(false).misfit;
  if (without < kNoiseEvidence) return {};
  std::vector<Mixture::Fit> fits;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n <= kNoiseLengths && mixture.length(n) <= bands.back().radius; ++n) {
    mixture.set_noise(n);
    fits.push_back(mixture.best(true));
    least = std::min(least, fits.back().misfit);
  }
  if (without - least < kNoiseEvidence) return {};
  // Weak noise that is correlated widely does as well as strong noise that is correlated more widely still: of the
  // lengths that do about as well, the middle between the shortest and the best.
  const auto good = [&](double limit) {
    const auto fit = std::find_if(fits.begin(), fits.end(), [&](const auto& f) { return f.misfit <= least + limit; });
    return MeshNoise{fit->noise_rms, mixture.length(static_cast<int>(fit - fits.begin()))};
  };
  const MeshNoise shortest = good(kAlikeMisfit), best = good(0);
  if (best.rms < std::numeric_limits<double>::epsilon() * size_of(mesh)) return {};  // of coordinates' last digits
  if (shortest.correlation_length == 0) return shortest;
  return {std::sqrt(shortest.rms * best.rms), std::sqrt(shortest.correlation_length * best.correlation_length)};
}

}  // namespace genu
