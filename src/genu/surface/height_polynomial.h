// Polynomials z = h(u, v) of total degree D, packed by powers of u: the coefficients of u^i v^0 .. u^i v^(D-i) stand
// together, i = 0 .. D. Value, gradient and Hessian come from one Horner scheme.
#pragma once

namespace genu {

constexpr int kMinDegree = 2;
constexpr int kMaxDegree = 4;

constexpr int coefficient_count(int degree) { return (degree + 1) * (degree + 2) / 2; }
constexpr int kMaxCoefficients = coefficient_count(kMaxDegree);

/// Where the coefficient of u^i v^j stands in a polynomial of total degree `degree`.
constexpr int coefficient_index(int degree, int i, int j) { return i * (degree + 1) - i * (i - 1) / 2 + j; }

template <typename T>
struct HeightOf {
  T h{};
  T hu{}, hv{};
  T huu{}, huv{}, hvv{};
};
using Height = HeightOf<double>;

/// Order 0: the value alone; 1: with the gradient; 2: with the Hessian. Members beyond the order stay zero. T is a
/// number or a vector of numbers; s is zero at first.
template <int D, int Order, typename T>
[[gnu::always_inline]] inline void evaluate_height(const T* c, const T& u, const T& v, HeightOf<T>& s) {
#pragma GCC unroll 5
  for (int i = D; i >= 0; --i) {
    const T* row = c + coefficient_index(D, i, 0);
    T p = row[D - i], pv{}, pvv{};  // the row's polynomial in v, its first and half its second derivative
#pragma GCC unroll 5
    for (int j = D - i - 1; j >= 0; --j) {
      if constexpr (Order >= 2) pvv = pvv * v + pv;
      if constexpr (Order >= 1) pv = pv * v + p;
      p = p * v + row[j];
    }
    if constexpr (Order >= 2) {
      s.huu = s.huu * u + s.hu;  // half of it until the end
      s.huv = s.huv * u + s.hv;
      s.hvv = s.hvv * u + pvv;
    }
    if constexpr (Order >= 1) {
      s.hu = s.hu * u + s.h;
      s.hv = s.hv * u + pv;
    }
    s.h = s.h * u + p;
  }
  s.huu *= 2.0;
  s.hvv *= 2.0;
}

template <int D, int Order>
inline Height evaluate_height(const double* c, double u, double v) {
  Height s;
  evaluate_height<D, Order, double>(c, u, v, s);
  return s;
}

}  // namespace genu
