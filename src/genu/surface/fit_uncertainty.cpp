#include "genu/surface/fit_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "genu/core/decompositions.h"
#include "genu/surface/blend_nodes.h"
#include "genu/surface/height_polynomial.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

const Vec2 kShift(0.31, 0.17);  // of a cell: the point looked at is no special one

/// Points of a triangular lattice within `reach` of the origin.
std::vector<Vec2> lattice(double edge, double reach) {
  std::vector<Vec2> points;
  const double rise = std::sqrt(0.75) * edge;
  const int most = static_cast<int>(reach / rise) + 2;
  for (int j = -most; j <= most; ++j) {
    for (int i = -most; i <= most; ++i) {
      const Vec2 x((i + kShift.x() + 0.5 * (j & 1)) * edge, (j + kShift.y()) * rise);
      if (x.norm() < reach) points.push_back(x);
    }
  }
  return points;
}

/// Value, d/dx and d2/dx2 at the origin as rows of coefficients over the vertices, lengths in fit radii.
struct Functionals {
  std::vector<Vec2> vertices;
  MatX rows;  ///< 3 x vertices
};

/// Adds weight(x) * h(x) of one node's fit, and its derivatives along x, to `sums`.
void add_fit(const std::vector<Vec2>& vertices, const Vec2& node, int degree, const Vec3& weight, MatX& sums) {
  const int columns = coefficient_count(degree);
  std::vector<int> used;
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    if ((vertices[static_cast<std::size_t>(i)] - node).norm() < 1) used.push_back(i);
  }
  const int count = static_cast<int>(used.size());
  MatX A(count, columns);
  VecX roots(count);
  for (int r = 0; r < count; ++r) {
    const Vec2 d = vertices[static_cast<std::size_t>(used[static_cast<std::size_t>(r)])] - node;
    roots[r] = std::sqrt(1 - d.squaredNorm());
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; j <= degree - i; ++j)
        A(r, coefficient_index(degree, i, j)) = roots[r] * std::pow(d.x(), i) * std::pow(d.y(), j);
    }
  }
  const MatX solution = least_squares_solution(A, roots.asDiagonal());  // coefficients x used vertices
  MatX basis = MatX::Zero(3, columns);
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; j <= degree - i; ++j) {
      const int k = coefficient_index(degree, i, j);
      const double y = std::pow(-node.y(), j);
      basis(0, k) = y * std::pow(-node.x(), i);
      if (i >= 1) basis(1, k) = y * i * std::pow(-node.x(), i - 1);
      if (i >= 2) basis(2, k) = y * i * (i - 1) * std::pow(-node.x(), i - 2);
    }
  }
  const MatX h = basis * solution;
  for (int r = 0; r < count; ++r) {
    const int v = used[static_cast<std::size_t>(r)];
    sums(0, v) += weight[0] * h(0, r);
    sums(1, v) += weight[1] * h(0, r) + weight[0] * h(1, r);
    sums(2, v) += weight[2] * h(0, r) + 2 * weight[1] * h(1, r) + weight[0] * h(2, r);
  }
}

Functionals reference(int degree) {
  Functionals out;
  out.vertices = lattice(kReferenceEdge, 1 + kBlendRadius);
  MatX sums = MatX::Zero(3, static_cast<Eigen::Index>(out.vertices.size()));
  Vec3 W = Vec3::Zero();
  for (const Vec2& node : lattice(kNodeDistance * kNodeSpacing, kBlendRadius)) {
    const double inverse = 1 / (kBlendRadius * kBlendRadius), a = 1 - node.squaredNorm() * inverse, d = -node.x();
    const Vec3 weight(std::pow(a, 4), -8 * inverse * d * std::pow(a, 3),
                      -8 * inverse * std::pow(a, 3) + 48 * inverse * inverse * d * d * a * a);
    W += weight;
    add_fit(out.vertices, node, degree, weight, sums);
  }
  // The quotient rule for sums / W.
  out.rows.resize(3, sums.cols());
  out.rows.row(0) = sums.row(0) / W[0];
  out.rows.row(1) = (sums.row(1) - W[1] * out.rows.row(0)) / W[0];
  out.rows.row(2) = (sums.row(2) - 2 * W[1] * out.rows.row(1) - W[2] * out.rows.row(0)) / W[0];
  return out;
}

template <int D>
const Functionals& once() {
  static const Functionals functionals = reference(D);
  return functionals;
}

const Functionals& reference_of(int degree) { return degree <= 2 ? once<2>() : degree == 3 ? once<3>() : once<4>(); }

/// The area over which noise of vertices `edge` apart errs alike: the sum of its correlations times a vertex's area.
double correlated_area(double edge, double length) {
  const double cell = std::sqrt(0.75) * edge * edge, wide = std::numbers::pi * length * length;
  // The lattice's sum passes from the one to the other where they are about alike.
  return std::max(cell, wide);
}

}  // namespace

FitUncertainty fit_uncertainty(const MeshNoise& noise, double edge, double fit_radius, int degree) {
  const Functionals& f = reference_of(degree);
  const double length = noise.correlation_length / fit_radius;
  Vec3 variance = Vec3::Zero();
  if (length < kReferenceEdge) {
    // Finer than the reference mesh resolves: white noise of the same correlated area.
    const double areas = correlated_area(edge / fit_radius, length) / correlated_area(kReferenceEdge, 0);
    variance = areas * f.rows.rowwise().squaredNorm();
  } else {
    const auto count = static_cast<Eigen::Index>(f.vertices.size());
    MatX covariance(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        const Vec2 d = f.vertices[static_cast<std::size_t>(i)] - f.vertices[static_cast<std::size_t>(j)];
        covariance(i, j) = covariance(j, i) = std::exp(-d.squaredNorm() / (length * length));
      }
    }
    variance = (f.rows * covariance).cwiseProduct(f.rows).rowwise().sum();
  }
  const Vec3 sigma = noise.rms * variance.cwiseMax(0).cwiseSqrt();
  return {sigma[0], sigma[1] / fit_radius, sigma[2] / (fit_radius * fit_radius)};
}

}  // namespace genu
