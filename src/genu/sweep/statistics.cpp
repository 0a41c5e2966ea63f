#include "genu/sweep/statistics.h"

#include <algorithm>
#include <cmath>

#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

/// Ranks from 1 of the numbers whose partners are numbers too; equal ones have the mean of their ranks. NaN elsewhere.
std::vector<double> ranks_of(const Ordered& of, const std::vector<double>& partners) {
  std::vector<std::size_t> order;
  for (const std::size_t k : of.order)
    if (std::isfinite(partners[k])) order.push_back(k);
  std::vector<double> ranks(of.values.size(), kNoNumber);
  for (std::size_t k = 0; k < order.size();) {
    std::size_t end = k;
    while (end < order.size() && of.values[order[end]] == of.values[order[k]]) ++end;
    for (std::size_t i = k; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(k + 1 + end);
    k = end;
  }
  return ranks;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/// Standard error of the mean.
double error_of(const std::vector<double>& values) {
  const Moments m = moments(values);
  return m.sd / std::sqrt(static_cast<double>(m.count));
}

}  // namespace

std::vector<double> finite_of(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

Moments moments(const std::vector<double>& values) {
  const std::vector<double> numbers = finite_of(values);
  Moments m;
  m.count = numbers.size();
  if (numbers.empty()) return m;
  m.mean = mean_of(numbers);
  if (numbers.size() < 2) return m;
  double square = 0;
  for (const double v : numbers) square += (v - m.mean) * (v - m.mean);
  m.sd = std::sqrt(square / static_cast<double>(numbers.size() - 1));
  const double half = kTwoSided95 * m.sd / std::sqrt(static_cast<double>(numbers.size()));
  m.mean_95 = {m.mean - half, m.mean + half};
  return m;
}

double quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return kNoNumber;
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

Interval quantile_interval(const std::vector<double>& sorted, double q) {
  const auto n = static_cast<double>(sorted.size());
  const double half = kTwoSided95 * std::sqrt(n * q * (1 - q));
  const double low = std::floor(n * q - half), high = std::ceil(n * q + half) + 1;  // ranks from 1
  Interval interval;
  if (low >= 1 && low <= n) interval.low = sorted[static_cast<std::size_t>(low) - 1];
  if (high >= 1 && high <= n) interval.high = sorted[static_cast<std::size_t>(high) - 1];
  return interval;
}

Interval probability_interval(std::uint64_t count, std::uint64_t n) {
  if (n == 0) return {};
  const double total = static_cast<double>(n), p = static_cast<double>(count) / total, z2 = kTwoSided95 * kTwoSided95;
  const double middle = (p + z2 / (2 * total)) / (1 + z2 / total);
  const double half = kTwoSided95 * std::sqrt(p * (1 - p) / total + z2 / (4 * total * total)) / (1 + z2 / total);
  return {count == 0 ? 0 : middle - half, count == n ? 1 : middle + half};
}

std::vector<std::size_t> ascending(const std::vector<double>& values) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::isfinite(values[k])) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

double rank_correlation(const Ordered& x, const Ordered& y) {
  const std::vector<double> a = ranks_of(x, y.values), b = ranks_of(y, x.values);
  std::size_t pairs = 0;
  for (const double rank : a) pairs += std::isfinite(rank) ? 1 : 0;
  if (pairs < 2) return kNoNumber;
  const double mean = 0.5 * static_cast<double>(pairs + 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!std::isfinite(a[k])) continue;
    ab += (a[k] - mean) * (b[k] - mean);
    aa += (a[k] - mean) * (a[k] - mean);
    bb += (b[k] - mean) * (b[k] - mean);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : kNoNumber;
}

Interval rank_correlation_interval(double correlation, std::size_t n) {
  constexpr std::size_t kFewestPairs = 4;
  if (!std::isfinite(correlation) || n < kFewestPairs) return {};
  const double variance = (1 + 0.5 * correlation * correlation) / (static_cast<double>(n) - 3);
  const double half = kTwoSided95 * std::sqrt(variance);
  const double z = std::atanh(std::clamp(correlation, -1.0, 1.0));
  return {std::tanh(z - half), std::tanh(z + half)};
}

std::vector<SobolIndex> sobol_indices(const std::vector<double>& values, std::size_t factors) {
  const std::size_t block = factors + 2;
  std::vector<std::size_t> whole;  // first values of blocks
  for (std::size_t k = 0; k + block <= values.size(); k += block)
    if (std::all_of(values.begin() + static_cast<std::ptrdiff_t>(k),
                    values.begin() + static_cast<std::ptrdiff_t>(k + block), [](double v) { return std::isfinite(v); }))
      whole.push_back(k);
  std::vector<SobolIndex> indices(factors);
  std::vector<double> of_a_and_b;
  for (const std::size_t k : whole) of_a_and_b.insert(of_a_and_b.end(), {values[k], values[k + 1]});
  const Moments m = moments(of_a_and_b);
  const double variance = m.sd * m.sd;
  for (std::size_t f = 0; f < factors; ++f) {
    indices[f].blocks = whole.size();
    if (whole.size() < 2 || !(variance > 0)) continue;
    std::vector<double> first, total;
    for (const std::size_t k : whole) {
      const double a = values[k] - m.mean, b = values[k + 1] - m.mean, ab = values[k + 2 + f] - m.mean;
      first.push_back(b * (ab - a) / variance);
      total.push_back((a - ab) * (a - ab) / (2 * variance));
    }
    indices[f] = {mean_of(first), mean_of(total), error_of(first), error_of(total), whole.size()};
  }
  return indices;
}

}  // namespace genu
