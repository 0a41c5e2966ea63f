#include "genu/surface/blend_field.h"

#include <algorithm>
#include <limits>

#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr int kRecordHeader = 12;

Vec3 centre_of(const double* record) { return {record[0], record[1], record[2]}; }

void pack(const HeightFit& fit, int degree, double* record) {
  for (int k = 0; k < 3; ++k) {
    record[k] = fit.origin[k];
    for (int a = 0; a < 3; ++a) record[3 + 3 * a + k] = fit.axes(k, a);
  }
  for (int i = 0; i <= fit.degree; ++i) {
    for (int j = 0; j <= fit.degree - i; ++j) {
      record[kRecordHeader + coefficient_index(degree, i, j)] = fit.coefficients[coefficient_index(fit.degree, i, j)];
    }
  }
}

}  // namespace

BlendField::BlendField(std::span<const HeightFit> fits, std::vector<int> sheet, int degree, double blend_radius,
                       const std::vector<Crease>& creases)
    : degree_(degree),
      blend_radius_(blend_radius),
      stride_(kRecordHeader + coefficient_count(degree)),
      records_(fits.size() * stride_, 0.0),
      sheet_(std::move(sheet)) {
  for (const Crease& c : creases) {
    across_.resize(std::max(across_.size(), static_cast<std::size_t>(std::max(c.a, c.b)) + 1));
    across_[static_cast<std::size_t>(c.a)].emplace_back(c.b, c.convex);
    across_[static_cast<std::size_t>(c.b)].emplace_back(c.a, c.convex);
  }
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    pack(fits[i], degree, &records_[i * stride_]);
    centres.push_back(fits[i].origin);
  }
  cells_ = CellLists(centres, std::span(&blend_radius, 1), 0.5 * blend_radius);
  mixed_.assign(cells_.cell_count(), 0);
  for (int c = 0; c < cells_.cell_count(); ++c) {
    const auto list = cells_.list(c);
    mixed_[c] = std::any_of(list.begin(), list.end(), [&](int i) { return sheet_[i] != sheet_[list[0]]; });
  }
}

int BlendField::nearest_node(const Vec3& x) const { return nearest_node(x, cells_.at(x)); }

int BlendField::nearest_node(const Vec3& x, std::span<const int> candidates) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int i : candidates) {
    const double* record = &records_[static_cast<std::size_t>(i) * stride_];
    const Vec3 d = x - centre_of(record);
    const double across = d.x() * record[9] + d.y() * record[10] + d.z() * record[11];
    const double squared = d.squaredNorm();
    if (squared >= blend_radius_ * blend_radius_) continue;
    const double score = across * across + kSidewaysWeight * squared;
    if (score < least) least = score, best = i;
  }
  return best;
}

/// The sheet that answers for x where those of a crease are in reach.
template <int D>
int BlendField::across_creases(const Vec3& x, std::span<const int> candidates, int nearest) const {
  if (static_cast<std::size_t>(nearest) >= across_.size() || across_[static_cast<std::size_t>(nearest)].empty())
    return nearest;
  double f = 0;
  if (!sum<D, 0>(x, candidates, nearest, f, nullptr, nullptr)) return nearest;
  int sheet = nearest;
  for (const auto& [other, convex] : across_[static_cast<std::size_t>(nearest)]) {
    double g = 0;
    if (!sum<D, 0>(x, candidates, other, g, nullptr, nullptr)) continue;
    if (convex ? g > f : g < f) f = g, sheet = other;
  }
  return sheet;
}

template <int D, int Order>
bool BlendField::evaluate(const Vec3& x, double& f, Vec3* gradient, Mat3* hessian) const {
  const int cell = cells_.cell_of(x);
  const auto candidates = cells_.list(cell);
  if (candidates.empty()) return false;
  int sheet = -1;
  if (mixed_[cell]) {
    const int nearest = nearest_node(x, candidates);
    if (nearest < 0) return false;
    sheet = sheet_[nearest];
    if (!across_.empty()) sheet = across_creases<D>(x, candidates, sheet);
  }
  return sum<D, Order>(x, candidates, sheet, f, gradient, hessian);
}

/// Of one sheet; -1: of all nodes in reach.
template <int D, int Order>
bool BlendField::sum(const Vec3& x, std::span<const int> candidates, int sheet, double& f, Vec3* gradient,
                     Mat3* hessian) const {
  const double inverse = 1 / (blend_radius_ * blend_radius_);
  // Sums of w, w g and of their gradients and Hessians (upper triangles xx, xy, xz, yy, yz, zz).
  double W = 0, F = 0, W1[3] = {}, F1[3] = {}, W2[6] = {}, F2[6] = {}, K1 = 0, G1 = 0;
  for (int i : candidates) {
    const double* r = &records_[static_cast<std::size_t>(i) * stride_];
    const double d[3] = {x[0] - r[0], x[1] - r[1], x[2] - r[2]};
    const double a = 1 - (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * inverse;
    if (!(a > 0) || (sheet >= 0 && sheet_[i] != sheet)) continue;
    const double *e1 = r + 3, *e2 = r + 6, *n = r + 9;
    const double u = d[0] * e1[0] + d[1] * e1[1] + d[2] * e1[2];
    const double v = d[0] * e2[0] + d[1] * e2[1] + d[2] * e2[2];
    const double z = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
    const Height s = evaluate_height<D, Order>(r + kRecordHeader, u, v);
    const double g = z - s.h, a2 = a * a, w = a2 * a2;
    W += w;
    F += w * g;
    if constexpr (Order >= 1) {
      const double k1 = -8 * inverse * a2 * a;  // grad w = k1 d
      double g1[3];
      for (int k = 0; k < 3; ++k) {
        g1[k] = n[k] - s.hu * e1[k] - s.hv * e2[k];
        W1[k] += k1 * d[k];
        F1[k] += w * g1[k] + (g * k1) * d[k];
      }
      if constexpr (Order >= 2) {
        const double k2 = 48 * inverse * inverse * a2;  // Hess w = k2 d d^T + k1 I
        K1 += k1;
        G1 += g * k1;
        // w Hess g + grad w grad g^T + grad g grad w^T + g k2 d d^T = p e1^T + q e2^T + sym(d m^T), all symmetric.
        double p[3], q[3], m[3], b[3];
        for (int k = 0; k < 3; ++k) {
          p[k] = -w * (s.huu * e1[k] + s.huv * e2[k]);
          q[k] = -w * (s.huv * e1[k] + s.hvv * e2[k]);
          m[k] = k1 * g1[k] + (0.5 * g * k2) * d[k];
          b[k] = k2 * d[k];
        }
        for (int row = 0, k = 0; row < 3; ++row) {
          for (int col = row; col < 3; ++col, ++k) {
            W2[k] += b[row] * d[col];
            F2[k] += p[row] * e1[col] + q[row] * e2[col] + d[row] * m[col] + m[row] * d[col];
          }
        }
      }
    }
  }
  if (!(W > kMinBlendWeight)) return false;
  const double scale = 1 / W;
  f = F * scale;
  if constexpr (Order >= 1) {
    double f1[3];
    for (int k = 0; k < 3; ++k) (*gradient)[k] = f1[k] = (F1[k] - f * W1[k]) * scale;
    if constexpr (Order >= 2) {
      for (int row = 0, k = 0; row < 3; ++row) {
        for (int col = row; col < 3; ++col, ++k) {
          double h = F2[k] - f * W2[k] - f1[row] * W1[col] - W1[row] * f1[col];
          if (row == col) h += G1 - f * K1;
          (*hessian)(row, col) = (*hessian)(col, row) = h * scale;
        }
      }
    }
  }
  return true;
}

template <int Order>
bool BlendField::dispatch(const Vec3& x, double& f, Vec3* gradient, Mat3* hessian) const {
  switch (degree_) {
    case 2:
      return evaluate<2, Order>(x, f, gradient, hessian);
    case 3:
      return evaluate<3, Order>(x, f, gradient, hessian);
    default:
      return evaluate<4, Order>(x, f, gradient, hessian);
  }
}

bool BlendField::value(const Vec3& x, double& f) const { return dispatch<0>(x, f, nullptr, nullptr); }
bool BlendField::value(const Vec3& x, double& f, Vec3& gradient) const { return dispatch<1>(x, f, &gradient, nullptr); }
bool BlendField::value(const Vec3& x, double& f, Vec3& gradient, Mat3& hessian) const {
  return dispatch<2>(x, f, &gradient, &hessian);
}

}  // namespace genu
