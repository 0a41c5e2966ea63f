#include "genu/surface/fit_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "genu/core/units.h"
#include "genu/mesh/tolerances.h"
#include "genu/surface/local_fit.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

double lower_quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// To one of four values an octave: a hole in the mesh does not change it.
double rounded(double x) { return x > 0 ? std::exp2(std::round(4 * std::log2(x)) / 4) : 0; }

/// Fits at vertices spread evenly over the surface, and what they say; medians and quantiles, so that edges and scraps
/// do not count.
class Probe {
 public:
  Probe(const Mesh& mesh, const VertexGraph& graph, int degree)
      : mesh_(mesh), graph_(graph), degree_(degree), fitters_([this] { return HeightFitter(mesh_, graph_); }) {
    // Each as far from all before it: what is different at one place of the mesh changes the probes near there, and a
    // motion of the mesh none.
    const double apart = rounded(std::sqrt(graph.area / kRadiusProbes));
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (graph.component[v] < 0 || graph.is_near_crease(static_cast<int>(v))) continue;
      const bool taken = std::any_of(vertices_.begin(), vertices_.end(), [&](int w) {
        return (mesh.vertices[static_cast<std::size_t>(w)] - mesh.vertices[v]).squaredNorm() < apart * apart;
      });
      if (!taken) vertices_.push_back(static_cast<int>(v));
    }
  }

  /// Median square of the disagreement about curvature, 1/m^2.
  double disagreement(double radius) {
    return lower_quantile(collect([&](HeightFitter& fitter, std::size_t i, double& out) {
                            const int v = vertices_[i];
                            if (near_crease(v, radius)) return false;
                            const HeightFit a = at(fitter, v, radius);
                            if (a.degree == 0) return false;
                            const Vec3 target =
                                a.origin + kPartnerDistance * radius * toward_neighbour(v, a.axes.col(2));
                            const int partner = advance_toward(v, target);
                            if ((mesh_.vertices[partner] - target).norm() > 0.3 * radius) return false;
                            const HeightFit b = at(fitter, partner, radius);
                            if (b.degree == 0) return false;
                            const Vec3 middle = 0.5 * (a.origin + b.origin);
                            out = 0.5 * (a.curvature(middle) - b.curvature(middle)).squaredNorm();
                            return true;
                          }),
                          0.5);
  }

  /// Quantiles of |mean curvature| (flat parts) and of the curvature's norm (median), 1/m.
  std::array<double, 2> flat_and_typical(double radius) {
    std::vector<double> mean(vertices_.size());
    std::vector<double> norm = collect([&](HeightFitter& fitter, std::size_t i, double& out) {
      const HeightFit fit = at(fitter, vertices_[i], radius);
      const Mat3 S = fit.curvature(fit.origin);
      mean[i] = fit.degree > 0 ? 0.5 * std::abs(S.trace()) : -1;
      out = S.norm();
      return fit.degree > 0;
    });
    std::erase(mean, -1);
    return {lower_quantile(std::move(mean), kFlatQuantile), lower_quantile(std::move(norm), 0.5)};
  }

 private:
  HeightFit at(HeightFitter& fitter, int v, double radius) const {
    return fitter.fit({mesh_.vertices[v], graph_.normals[v], std::span(&v, 1), radius, degree_, false});
  }

  /// A tangent direction that the mesh itself gives, so that it turns and mirrors with the mesh.
  Vec3 toward_neighbour(int v, const Vec3& normal) const {
    const Vec3 edge = mesh_.vertices[graph_.neighbours(v).front()] - mesh_.vertices[v];
    return (edge - normal * normal.dot(edge)).normalized();
  }

  /// Whether one of the two fits reaches a crease, which is within the narrowest patch of what is marked as near it.
  bool near_crease(int v, double radius) const {
    if (graph_.near_crease.empty()) return false;
    const double clear = (1 + kPartnerDistance) * radius - kNarrowestPatch * graph_.median_edge;
    const Vec3& x = mesh_.vertices[static_cast<std::size_t>(v)];
    for (std::size_t w = 0; w < mesh_.vertices.size(); ++w)
      if (graph_.near_crease[w] != 0 && (mesh_.vertices[w] - x).squaredNorm() < clear * clear) return true;
    return false;
  }

  int advance_toward(int v, const Vec3& target) const {
    for (int best = v;; v = best) {
      double least = (mesh_.vertices[v] - target).squaredNorm();
      for (int w : graph_.neighbours(v)) {
        const double d = (mesh_.vertices[w] - target).squaredNorm();
        if (d < least) least = d, best = w;
      }
      if (best == v) return v;
    }
  }

  template <class F>
  std::vector<double> collect(F&& measure) {
    std::vector<double> values(vertices_.size());
    std::vector<char> valid(vertices_.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices_.size(), 8), [&](const auto& range) {
      HeightFitter& fitter = fitters_.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) valid[i] = measure(fitter, i, values[i]);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (valid[i]) values[kept++] = values[i];
    }
    values.resize(kept);
    return values;
  }

  const Mesh& mesh_;
  const VertexGraph& graph_;
  int degree_;
  std::vector<int> vertices_;
  tbb::enumerable_thread_specific<HeightFitter> fitters_;
};

/// The part of the curvature's error at the narrowest radius that comes from noise, 1/m:
/// D^2 = N^2 rho^-6 + T^2 rho^(2 (degree - 1)).
double curvature_noise(Probe& probe, double h, int degree) {
  const double first = probe.disagreement(kRadiusWithoutNoise * h),
               second = probe.disagreement(kSecondRadius * kRadiusWithoutNoise * h);
  const double fall = std::pow(kSecondRadius, -6), growth = std::pow(kSecondRadius, 2 * (degree - 1));
  return kDisagreementGain * std::sqrt(std::max(0.0, (growth * first - second) / (growth - fall)));
}

/// Sets the radius of a choice whose degree is set, and says why.
void choose_radius(const Mesh& mesh, const VertexGraph& graph, FitChoice& choice) {
  const double h = graph.median_edge,
               narrowest = std::max(kRadiusWithoutNoise * h, graph.steps ? kRadiusOfSteps * graph.steps->height : 0.0);
  Probe probe(mesh, graph, choice.degree);
  const double noise = curvature_noise(probe, h, choice.degree);
  const int components = 1 + *std::max_element(graph.component.begin(), graph.component.end());
  const double sheet = kMaxPatchOfSheet * std::sqrt(graph.area / components);
  choice.radius = choice.least_radius = narrowest;
  choice.why = narrowest > kRadiusWithoutNoise * h ? fmt::format("{:g} steps of the mesh", kRadiusOfSteps)
                                                   : fmt::format("3 edges of {:.3g} mm", 1e3 * h);
  if (noise * narrowest < kNegligibleNoise) return;
  // The curvature itself is known only as well as the radius is wide: a few rounds settle both.
  for (int round = 0; round < kRadiusRounds; ++round) {
    const auto [flat, typical] = probe.flat_and_typical(choice.radius);
    const double wanted = flat > 0 ? narrowest * std::cbrt(noise / (kToleratedError * flat)) : sheet;
    const double cap = std::min(sheet, typical > 0 ? kMaxOfCurvature / typical : sheet);
    const double next = std::max(narrowest, std::min(wanted, cap));
    const bool settled = std::abs(next - choice.radius) < kRadiusSettled * choice.radius;
    choice.radius = next;
    if (next > narrowest) {
      choice.why = fmt::format("noise: curvature would err by {:.3g} 1/m at 3 edges, flat parts have {:.3g} 1/m{}",
                               noise, flat, wanted > cap ? "; held back by curvature or size" : "");
    }
    if (settled) break;
  }
}

}  // namespace

FitChoice choose_fit(const Mesh& mesh, const VertexGraph& graph, std::optional<double> radius,
                     std::optional<int> degree) {
  FitChoice choice;
  choice.degree = degree.value_or(graph.machined ? 4 : 3);
  if (radius) {
    choice.radius = choice.least_radius = *radius;
    choice.why = "fit radius as given";
  } else {
    choose_radius(mesh, graph, choice);
  }
  choice.noise = graph.steps ? MeshNoise{graph.steps->rms, graph.steps->height} : estimate_noise(mesh, graph);
  choice.uncertainty = fit_uncertainty(choice.noise, graph.median_edge, choice.radius, choice.degree);
  if (graph.steps) {
    const Vec3& d = graph.steps->direction;
    choice.why += fmt::format("; {} steps of {:.3g} mm along ({:.2g}, {:.2g}, {:.2g})", graph.steps->levels,
                              1e3 * graph.steps->height, d.x(), d.y(), d.z());
  }
  if (choice.noise.rms > 0) {
    choice.why += fmt::format("; noise {:.3g} um over {:.2g} mm: curvature known to {:.2g} 1/m, normal to {:.2g} deg",
                              1e6 * choice.noise.rms, 1e3 * choice.noise.correlation_length,
                              choice.uncertainty.curvature, choice.uncertainty.slope / units::kDegree);
  }
  return choice;
}

}  // namespace genu
