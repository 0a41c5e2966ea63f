#include "genu/surface/blend_sum.h"

#include <algorithm>
#include <array>

#include "genu/surface/height_polynomial.h"
#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;

double total(const Lanes& v) { return (v[0] + v[1]) + (v[2] + v[3]); }

/// Sums of w, w g and of their gradients and Hessians (upper triangles xx, xy, xz, yy, yz, zz), lane by lane.
struct Sums {
  Lanes W = {}, F = {}, W1[3] = {}, F1[3] = {}, W2[6] = {}, F2[6] = {}, K1 = {}, G1 = {};
};

/// Nodes in reach: their records, and the root of the root of their weight.
struct Reached {
  static constexpr int kMost = 64;
  std::array<const double*, kMost> records;
  alignas(sizeof(Lanes)) std::array<double, kMost> a;
};

/// Adds what kLanes nodes give. `from`: their records.
template <int D, int Order>
[[gnu::always_inline]] inline void add(const double* const* from, const Lanes& a, const Vec3& x, double inverse,
                                       Sums& sums) {
  constexpr int kSize = BlendNodes::kHeader + coefficient_count(D);
  Lanes r[kSize];
  for (int k = 0; k < kSize; ++k) r[k] = Lanes{from[0][k], from[1][k], from[2][k], from[3][k]};
  const Lanes d[3] = {x[0] - r[0], x[1] - r[1], x[2] - r[2]};
  const Lanes *e1 = r + 3, *e2 = r + 6, *n = r + 9;
  const Lanes u = d[0] * e1[0] + d[1] * e1[1] + d[2] * e1[2];
  const Lanes v = d[0] * e2[0] + d[1] * e2[1] + d[2] * e2[2];
  const Lanes z = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
  HeightOf<Lanes> height;
  evaluate_height<D, Order>(r + BlendNodes::kHeader, u, v, height);
  const Lanes g = z - height.h, a2 = a * a, w = a2 * a2;
  sums.W += w;
  sums.F += w * g;
  if constexpr (Order >= 1) {
    const Lanes k1 = -8 * inverse * a2 * a;  // grad w = k1 d
    Lanes g1[3];
    for (int k = 0; k < 3; ++k) {
      g1[k] = n[k] - height.hu * e1[k] - height.hv * e2[k];
      sums.W1[k] += k1 * d[k];
      sums.F1[k] += w * g1[k] + (g * k1) * d[k];
    }
    if constexpr (Order >= 2) {
      const Lanes k2 = 48 * inverse * inverse * a2;  // Hess w = k2 d d^T + k1 I
      sums.K1 += k1;
      sums.G1 += g * k1;
      // w Hess g + grad w grad g^T + grad g grad w^T + g k2 d d^T = p e1^T + q e2^T + sym(d m^T), all symmetric.
      Lanes p[3], q[3], m[3], b[3];
      for (int k = 0; k < 3; ++k) {
        p[k] = -w * (height.huu * e1[k] + height.huv * e2[k]);
        q[k] = -w * (height.huv * e1[k] + height.hvv * e2[k]);
        m[k] = k1 * g1[k] + (0.5 * g * k2) * d[k];
        b[k] = k2 * d[k];
      }
      for (int row = 0, k = 0; row < 3; ++row) {
        for (int col = row; col < 3; ++col, ++k) {
          sums.W2[k] += b[row] * d[col];
          sums.F2[k] += p[row] * e1[col] + q[row] * e2[col] + d[row] * m[col] + m[row] * d[col];
        }
      }
    }
  }
}

template <int Order>
[[gnu::always_inline]] inline bool quotient(const Sums& sums, BlendJet& out) {
  const double W = total(sums.W);
  if (!(W > kMinBlendWeight)) return false;
  const double scale = 1 / W, f = total(sums.F) * scale;
  out.f = f;
  if constexpr (Order >= 1) {
    double f1[3], W1[3];
    for (int k = 0; k < 3; ++k) {
      W1[k] = total(sums.W1[k]);
      out.gradient[k] = f1[k] = (total(sums.F1[k]) - f * W1[k]) * scale;
    }
    if constexpr (Order >= 2) {
      const double diagonal = total(sums.G1) - f * total(sums.K1);
      for (int row = 0, k = 0; row < 3; ++row) {
        for (int col = row; col < 3; ++col, ++k) {
          double h = total(sums.F2[k]) - f * total(sums.W2[k]) - f1[row] * W1[col] - W1[row] * f1[col];
          if (row == col) h += diagonal;
          out.hessian(row, col) = out.hessian(col, row) = h * scale;
        }
      }
    }
  }
  return true;
}

template <int D, int Order>
[[gnu::always_inline]] inline bool sum(const BlendNodes& nodes, const Vec3& x, std::span<const int> candidates,
                                       int sheet, BlendJet& out) {
  const double inverse = 1 / (nodes.radius * nodes.radius);
  Sums sums;
  Reached reached;
  for (std::size_t next = 0; next < candidates.size();) {
    const std::size_t end = std::min(candidates.size(), next + Reached::kMost);
    std::size_t count = 0;
    // Without branches: which are in reach has no pattern.
    for (; next < end; ++next) {
      const int i = candidates[next];
      const double* r = nodes.records + static_cast<std::size_t>(i) * nodes.stride;
      const double d[3] = {x[0] - r[0], x[1] - r[1], x[2] - r[2]};
      const double a = 1 - (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * inverse;
      reached.records[count] = r;
      reached.a[count] = a;
      count += static_cast<std::size_t>(a > 0) & static_cast<std::size_t>(sheet < 0 || nodes.sheet[i] == sheet);
    }
    // What fills up the last lanes has no weight.
    for (std::size_t k = count; k % kLanes != 0; ++k) reached.records[k] = reached.records[0], reached.a[k] = 0;
    for (std::size_t k = 0; k < count; k += kLanes)
      add<D, Order>(&reached.records[k], Lanes{reached.a[k], reached.a[k + 1], reached.a[k + 2], reached.a[k + 3]}, x,
                    inverse, sums);
  }
  return quotient<Order>(sums, out);
}

#ifdef __x86_64__
template <int D, int Order>
[[gnu::target("avx2")]] bool sum_avx2(const BlendNodes& nodes, const Vec3& x, std::span<const int> candidates,
                                      int sheet, BlendJet& out) {
  return sum<D, Order>(nodes, x, candidates, sheet, out);
}
const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
#endif

}  // namespace

template <int D, int Order>
bool blend_sum_anywhere(const BlendNodes& nodes, const Vec3& x, std::span<const int> candidates, int sheet,
                        BlendJet& out) {
  return sum<D, Order>(nodes, x, candidates, sheet, out);
}

template <int D, int Order>
bool blend_sum(const BlendNodes& nodes, const Vec3& x, std::span<const int> candidates, int sheet, BlendJet& out) {
#ifdef __x86_64__
  if (kHasAvx2) return sum_avx2<D, Order>(nodes, x, candidates, sheet, out);
#endif
  return sum<D, Order>(nodes, x, candidates, sheet, out);
}

#define GENU_BLEND_SUM(D, ORDER)                                                                           \
  template bool blend_sum<D, ORDER>(const BlendNodes&, const Vec3&, std::span<const int>, int, BlendJet&); \
  template bool blend_sum_anywhere<D, ORDER>(const BlendNodes&, const Vec3&, std::span<const int>, int, BlendJet&);
GENU_BLEND_SUM(2, 0)
GENU_BLEND_SUM(2, 1)
GENU_BLEND_SUM(2, 2)
GENU_BLEND_SUM(3, 0)
GENU_BLEND_SUM(3, 1)
GENU_BLEND_SUM(3, 2)
GENU_BLEND_SUM(4, 0)
GENU_BLEND_SUM(4, 1)
GENU_BLEND_SUM(4, 2)

}  // namespace genu
