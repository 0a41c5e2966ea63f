#include "genu/surface/local_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/mesh/tolerances.h"
#include "genu/surface/surface.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

/// A monomial must keep this fraction of its norm beside the earlier ones. On one side of its centre (at a mesh's edge)
/// x^3 keeps 0.05, x^4 but 0.014, and less with the kernel: degree 4 needs a finer sieve not to fall back there.
constexpr double independence(int degree) { return degree <= 3 ? 0.03 : 0.006; }

constexpr double kDiagonal = 0.70710678118654752;
constexpr std::pair<double, double> kRound[] = {{1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
                                                {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};

double kernel(double squared_distance, double radius) { return 1 - squared_distance / (radius * radius); }

}  // namespace

Height HeightFit::height(double u, double v) const {
  switch (degree) {
    case 2:
      return evaluate_height<2, 2>(coefficients.data(), u, v);
    case 3:
      return evaluate_height<3, 2>(coefficients.data(), u, v);
    case 4:
      return evaluate_height<4, 2>(coefficients.data(), u, v);
    default:
      return {};
  }
}

Mat3 HeightFit::curvature(const Vec3& x) const {
  const Vec3 local = axes.transpose() * (x - origin);
  const Height s = height(local.x(), local.y());
  const Vec3 gradient = axes * Vec3(-s.hu, -s.hv, 1);
  const double slope = gradient.norm();
  const Vec3 n = gradient / slope;
  Mat3 H = Mat3::Zero();
  H.topLeftCorner<2, 2>() << s.huu, s.huv, s.huv, s.hvv;
  const Mat3 P = Mat3::Identity() - n * n.transpose();
  return P * axes * H * axes.transpose() * P / slope;
}

HeightFitter::HeightFitter(const Mesh& mesh, const VertexGraph& graph)
    : mesh_(mesh), graph_(graph), stamp_(mesh.vertices.size(), 0) {}

HeightFit HeightFitter::fit(const FitRequest& request) {
  HeightFit fit;
  fit.origin = request.origin;
  const double last = request.may_adapt ? kMaxRadiusGrowth : 1;
  for (double growth = 1; growth <= last * 1.0001; growth *= kRadiusGrowth) {
    gather(request, growth * request.radius);
    if (static_cast<double>(gathered_.size()) < kSamplesPerCoefficient * coefficient_count(request.degree)) continue;
    fit.axes.col(2) = request.normal;
    average_normal(fit, growth * request.radius);
    if (solve(fit, request.degree, growth * request.radius)) return fit;
  }
  if (!request.may_adapt) return fit;
  // The last ball is the largest: a lower degree takes what is there.
  fit.axes.col(2) = request.normal;
  average_normal(fit, last * request.radius);
  for (int degree = request.degree - 1; degree >= kMinDegree; --degree) {
    const bool enough = static_cast<int>(gathered_.size()) > coefficient_count(degree);
    if (enough && solve(fit, degree, last * request.radius)) break;
  }
  return fit;
}

void HeightFitter::gather(const FitRequest& request, double radius) {
  ++now_;
  gathered_.clear();
  const double limit = radius * radius;
  // Beyond a crease lies another face, and vertices on it may belong to either. Of a crease itself all are taken.
  const bool amid =
      std::all_of(request.seeds.begin(), request.seeds.end(), [&](int v) { return graph_.is_on_crease(v); });
  const auto visit = [&](int v) {
    if (stamp_[v] == now_) return;
    stamp_[v] = now_;
    if (!amid && graph_.is_on_crease(v)) return;
    if ((mesh_.vertices[v] - request.origin).squaredNorm() >= limit) return;
    if (graph_.normals[v].dot(request.normal) < kConeCosine) return;
    gathered_.push_back(v);
  };
  for (int v : request.seeds) visit(v);
  for (std::size_t next = 0; next < gathered_.size(); ++next) {
    for (int w : graph_.neighbours(gathered_[next])) visit(w);
  }
}

void HeightFitter::average_normal(HeightFit& fit, double radius) const {
  Vec3 sum = Vec3::Zero();
  for (int v : gathered_) {
    const double k = kernel((mesh_.vertices[v] - fit.origin).squaredNorm(), radius);
    sum += std::max(k, 0.0) * graph_.areas[v] * graph_.normals[v];
  }
  const double length = sum.norm();
  const Vec3 n = length > 0 ? Vec3(sum / length) : Vec3(fit.axes.col(2));
  fit.axes.leftCols<2>() = tangent_basis(n);
  fit.axes.col(2) = n;
}

/// Looked at all round, as far as heights are asked for; where that fails half-way along the edges that leave gathered
/// vertices, and nowhere else, as past the edge of a mesh no fit knows the surface. `R` of the weighted monomials,
/// whose weights add up to `weight`.
bool HeightFitter::determined(const HeightFit& fit, const Eigen::Ref<const MatX>& R, int degree, double radius,
                              double weight) const {
  // |R^-T m|^2 of the monomials m at (u, v), in radii, by forward substitution.
  const auto settled = [&](double u, double v) {
    std::array<double, kMaxCoefficients> y;
    double sum = 0, ui = 1;
    for (int i = 0, k = 0; i <= degree; ++i, ui *= u) {
      double uv = ui;
      for (int j = 0; j <= degree - i; ++j, ++k, uv *= v) {
        y[k] = uv;
        for (int row = 0; row < k; ++row) y[k] -= R(row, k) * y[row];
        y[k] /= R(k, k);
        sum += y[k] * y[k];
      }
    }
    return sum * weight <= kMaxLeverage * kMaxLeverage;
  };
  const auto all_round = [&] {
    for (const auto& [u, v] : kRound)
      if (!settled(kFitReach * u, kFitReach * v) || !settled(0.5 * kFitReach * u, 0.5 * kFitReach * v)) return false;
    return true;
  };
  if (all_round()) return true;
  for (const int v : gathered_) {
    for (const int w : graph_.neighbours(v)) {
      if (graph_.normals[w].dot(fit.axes.col(2)) < kConeCosine) continue;
      Vec3 local = fit.axes.transpose() * (0.5 * (mesh_.vertices[v] + mesh_.vertices[w]) - fit.origin) / radius;
      local *= std::min(1.0, kFitReach / std::max(local.norm(), kFitReach));
      if (!settled(local.x(), local.y())) return false;
    }
  }
  return true;
}

bool HeightFitter::solve(HeightFit& fit, int degree, double radius) {
  const int rows = static_cast<int>(gathered_.size()), columns = coefficient_count(degree);
  matrix_.resize(static_cast<std::size_t>(rows) * columns);
  right_.resize(rows);
  Eigen::Map<MatX> A(matrix_.data(), rows, columns);
  Eigen::Map<VecX> b(right_.data(), rows);
  double total = 0;
  for (int r = 0; r < rows; ++r) {
    const Vec3 d = mesh_.vertices[gathered_[r]] - fit.origin;
    const Vec3 local = fit.axes.transpose() * d;
    const double weight = std::max(kernel(d.squaredNorm(), radius), 0.0) * graph_.areas[gathered_[r]];
    const double root = std::sqrt(weight), u = local.x() / radius, v = local.y() / radius;
    total += weight;
    double ui = root;
    for (int i = 0, k = 0; i <= degree; ++i, ui *= u) {
      double uv = ui;
      for (int j = 0; j <= degree - i; ++j, uv *= v) A(r, k++) = uv;
    }
    b(r) = root * local.z();
  }
  if (!(total > 0)) return false;

  reduce_to_triangle(A, b);
  for (int k = 0; k < columns; ++k) {
    const double norm = A.col(k).head(k + 1).norm();  // R has the column norms of the matrix it came from
    if (!(std::abs(A(k, k)) > independence(degree) * norm)) return false;
  }
  if (!determined(fit, A.topRows(columns), degree, radius, total)) return false;
  VecX x = solve_upper(A.topRows(columns), b.head(columns));

  double power[kMaxDegree + 1] = {1};
  for (int k = 1; k <= degree; ++k) power[k] = power[k - 1] / radius;
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; j <= degree - i; ++j) x[coefficient_index(degree, i, j)] *= power[i + j];
  }
  std::copy(x.begin(), x.end(), fit.coefficients.begin());
  fit.degree = degree;
  fit.radius = radius;
  fit.samples = rows;
  const double freedom = std::max(1, rows - columns);
  fit.residual_rms = std::sqrt(b.tail(rows - columns).squaredNorm() / total * rows / freedom);
  return true;
}

}  // namespace genu
