#include "genu/surface/polynomial.h"

#include <algorithm>
#include <array>

#include "genu/surface/tolerances.h"

namespace genu {
namespace {

constexpr int kPowersAtOnce = 4;  // of x at a time
constexpr std::size_t kMostPowers = (kMaxPolynomialExponent / kPowersAtOnce + 1) * kPowersAtOnce;

using Four [[gnu::vector_size(kPowersAtOnce * sizeof(double))]] = double;

/// Of the coefficient of each power of x, a polynomial in y: value, first and half the second derivative.
struct Coefficients {
  alignas(sizeof(Four)) std::array<double, kMostPowers> q, q1, q2;
};

[[gnu::always_inline]] inline void put(const Four& four, double* to) {
  for (int k = 0; k < kPowersAtOnce; ++k) to[k] = four[k];
}

[[gnu::always_inline]] inline void in_y(const std::vector<double>& c, const std::vector<int>& lengths, double y,
                                        Coefficients& out) {
  const double* end = c.data();
  std::size_t row = 0;
  for (const int length : lengths) {
    const double* begin = end;
    end += kPowersAtOnce * length;
    Four q = {}, q1 = {}, q2 = {};
    for (const double* from = end; from != begin;) {
      from -= kPowersAtOnce;
      q2 = q2 * y + q1;
      q1 = q1 * y + q;
      q = q * y + Four{from[0], from[1], from[2], from[3]};
    }
    put(q, &out.q[row]);
    put(q1, &out.q1[row]);
    put(q2, &out.q2[row]);
    row += kPowersAtOnce;
  }
}

[[gnu::always_inline]] inline PolynomialJet jet(const std::vector<double>& c, const std::vector<int>& lengths, int rows,
                                                double x, double y) {
  Coefficients of;
  in_y(c, lengths, y, of);
  PolynomialJet r;
  for (int row = rows - 1; row >= 0; --row) {
    const std::size_t i = at(row);
    r.xx = r.xx * x + 2 * r.x;
    r.xy = r.xy * x + r.y;
    r.x = r.x * x + r.f;
    r.yy = r.yy * x + 2 * of.q2[i];
    r.y = r.y * x + of.q1[i];
    r.f = r.f * x + of.q[i];
  }
  return r;
}

[[gnu::always_inline]] inline double value_of(const std::vector<double>& c, const std::vector<int>& lengths, double x,
                                              double y) {
  double f = 0;
  const double* end = c.data() + c.size();
  for (std::size_t block = lengths.size(); block-- > 0;) {
    const double* begin = end - kPowersAtOnce * lengths[block];
    Four q = {};
    for (const double* from = end; from != begin;) {
      from -= kPowersAtOnce;
      q = q * y + Four{from[0], from[1], from[2], from[3]};
    }
    end = begin;
    for (int k = kPowersAtOnce - 1; k >= 0; --k) f = f * x + q[k];
  }
  return f;
}

#ifdef __x86_64__
[[gnu::target("avx2")]] PolynomialJet jet_avx2(const std::vector<double>& c, const std::vector<int>& lengths, int rows,
                                               double x, double y) {
  return jet(c, lengths, rows, x, y);
}
[[gnu::target("avx2")]] double value_avx2(const std::vector<double>& c, const std::vector<int>& lengths, double x,
                                          double y) {
  return value_of(c, lengths, x, y);
}
const bool kLanesOfAvx2 = __builtin_cpu_supports("avx2") != 0;
#endif

}  // namespace

Polynomial::Polynomial(const std::vector<PolynomialTerm>& terms) {
  for (const PolynomialTerm& t : terms)
    if (t.c != 0) rows_ = std::max(rows_, t.i + 1);
  lengths_.assign(at((rows_ - 1) / kPowersAtOnce + 1), 0);
  for (const PolynomialTerm& t : terms)
    if (t.c != 0) lengths_[at(t.i / kPowersAtOnce)] = std::max(lengths_[at(t.i / kPowersAtOnce)], t.j + 1);
  std::vector<int> first;
  int size = 0;
  for (const int length : lengths_) {
    first.push_back(size);
    size += kPowersAtOnce * length;
  }
  c_.assign(at(size), 0.0);
  for (const PolynomialTerm& t : terms)
    if (t.c != 0) c_[at(first[at(t.i / kPowersAtOnce)] + kPowersAtOnce * t.j + t.i % kPowersAtOnce)] += t.c;
}

PolynomialJet Polynomial::jet_anywhere(double x, double y) const { return jet(c_, lengths_, rows_, x, y); }

PolynomialJet Polynomial::operator()(double x, double y) const {
#ifdef __x86_64__
  if (kLanesOfAvx2) return jet_avx2(c_, lengths_, rows_, x, y);
#endif
  return jet_anywhere(x, y);
}

double Polynomial::value(double x, double y) const {
#ifdef __x86_64__
  if (kLanesOfAvx2) return value_avx2(c_, lengths_, x, y);
#endif
  return value_of(c_, lengths_, x, y);
}

}  // namespace genu
