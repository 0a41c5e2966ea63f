#include "genu/surface/patch_shells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "genu/core/decompositions.h"
#include "genu/mesh/tolerances.h"
#include "genu/surface/height_polynomial.h"
#include "genu/surface/surface.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr int kShellColumns = coefficient_count(kShellDegree);
constexpr int kFewestSamples = kShellColumns + 5;

/// One weighted row of monomials of (u, v), by degree: 1; u, v; u^2, u v, v^2; ...
void set_row(double u, double v, double root, Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) {
  row[0] = root;
  for (int degree = 1, column = 1; degree <= kShellDegree; ++degree, column += degree) {
    for (int j = 0; j < degree; ++j) row[column + j] = u * row[column - degree + j];
    row[column + degree] = v * row[column - 1];
  }
}

double weight(double square) { return std::max(1 - square, 0.0); }

/// Calls f(column, shell) for the columns of set_row.
template <class F>
void for_columns(F&& f) {
  for (int degree = 0, column = 0; degree <= kShellDegree; ++degree) {
    for (int j = 0; j <= degree; ++j) f(column++, static_cast<std::size_t>(degree));
  }
}

}  // namespace

ShellFitter::ShellFitter(const Mesh& mesh, const VertexGraph& graph)
    : mesh_(mesh), graph_(graph), stamp_(mesh.vertices.size(), 0) {}

/// False at a crease. A vertex near one has it within the narrowest patch, so it may lie that far within this one.
bool ShellFitter::gather(int v, double radius) {
  const double clear = std::max(0.0, radius - kNarrowestPatch * graph_.median_edge);
  if (graph_.is_near_crease(v)) return false;
  ++now_;
  gathered_.assign(1, v);
  stamp_[v] = now_;
  for (std::size_t next = 0; next < gathered_.size(); ++next) {
    for (int w : graph_.neighbours(gathered_[next])) {
      if (stamp_[w] == now_) continue;
      stamp_[w] = now_;
      const double square = (mesh_.vertices[w] - mesh_.vertices[v]).squaredNorm();
      if (square >= radius * radius) continue;
      if (square <= clear * clear && graph_.is_near_crease(w)) return false;
      if (graph_.normals[w].dot(graph_.normals[v]) >= kConeCosine) gathered_.push_back(w);
    }
  }
  const std::size_t all = gathered_.size(), most = kMaxShellSamples;
  if (all <= most) return true;
  for (std::size_t i = 0; i < most; ++i) gathered_[i] = gathered_[i * all / most];
  gathered_.resize(most);
  return true;
}

bool ShellFitter::energies(int v, double radius, ShellEnergies& out) {
  if (!gather(v, radius) || samples() < kFewestSamples) return false;
  Vec3 n = Vec3::Zero();
  for (int w : gathered_) n += graph_.areas[w] * graph_.normals[w];
  if (!(n.norm() > 0)) return false;
  n.normalize();
  const Mat32 T = tangent_basis(n);
  MatX A(samples(), kShellColumns);
  VecX b(samples());
  double total = 0;
  for (int r = 0; r < samples(); ++r) {
    const Vec3 d = (mesh_.vertices[gathered_[r]] - mesh_.vertices[v]) / radius;
    const double w = weight(d.squaredNorm()), root = std::sqrt(w);
    total += w;
    set_row(T.col(0).dot(d), T.col(1).dot(d), root, A.row(r));
    b[r] = root * radius * n.dot(d);
  }
  reduce_to_triangle(A, b);
  out = {};
  for_columns([&](int column, std::size_t shell) { out[shell] += b[column] * b[column] / total; });
  out.back() = b.tail(samples() - kShellColumns).squaredNorm() / total;
  return true;
}

NoiseShells::NoiseShells(int samples) {
  samples = std::max(samples, kFewestSamples);
  // A sunflower's seeds: evenly spread, without the symmetries of a grid.
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  MatX A(samples, kShellColumns), points(samples, 2);
  roots_.resize(samples);
  for (int i = 0; i < samples; ++i) {
    const double square = (i + 0.5) / samples, r = std::sqrt(square);
    points.row(i) << r * std::cos(golden * i), r * std::sin(golden * i);
    roots_[i] = std::sqrt(weight(square));
    set_row(points(i, 0), points(i, 1), roots_[i], A.row(i));
  }
  basis_ = thin_qr(A).Q;
  squares_.resize(samples, samples);
  for (int j = 0; j < samples; ++j) squares_.col(j) = (points.rowwise() - points.row(j)).rowwise().squaredNorm();
}

ShellEnergies NoiseShells::energies(double length) const {
  MatX covariance = roots_.asDiagonal();
  if (length > 0) covariance = (squares_ / (-length * length)).array().exp().matrix() * covariance;
  covariance = roots_.asDiagonal() * covariance;
  const double total = roots_.squaredNorm();
  const VecX parts = (covariance * basis_).cwiseProduct(basis_).colwise().sum() / total;
  ShellEnergies out{};
  for_columns([&](int column, std::size_t shell) { out[shell] += parts[column]; });
  out.back() = std::max(1 - parts.sum(), 0.0);
  return out;
}

}  // namespace genu
