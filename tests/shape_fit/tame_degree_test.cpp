#include "genu/shape_fit/tame_degree.h"

#include <cmath>

#include <gtest/gtest.h>

namespace genu {
namespace {

const ChartBox kPatch{-0.02, 0.02, -0.01, 0.01};

template <class F>
std::vector<HeightSample> samples_of(const ChartBox& where, const F& f) {
  std::vector<HeightSample> out;
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 30; ++j) {
      const double u = where.u0 + where.width() * i / 30, v = where.v0 + where.height() * j / 30;
      out.push_back({u, v, f(u, v), 1});
    }
  return out;
}

int tame(const std::vector<HeightSample>& samples, const ChartBox& patch, bool cylindrical, int degree) {
  return highest_tame_degree(PolynomialFit(samples, patch, degree), samples, patch, cylindrical, degree);
}

TEST(TameDegree, AGentleShapeKeepsItsDegree) {
  const auto samples =
      samples_of(kPatch, [](double u, double v) { return 0.001 * std::sin(150 * u) * std::cos(99 * v); });
  EXPECT_EQ(tame(samples, kPatch, false, 9), 9);
}

TEST(TameDegree, WhatSwingsOutWhereNoSampleIsGoesDown) {
  const ChartBox half{-0.02, 0, -0.01, 0.01};  // the other half of the patch is bare
  const auto samples = samples_of(half, [](double u, double v) { return 0.001 * std::sin(600 * u) + 3 * v * v; });
  EXPECT_LT(tame(samples, kPatch, false, 9), 9);
}

TEST(TameDegree, FoldsGoDown) {
  const auto steep = samples_of(kPatch, [](double u, double) { return 0.005 * std::sin(1000 * u); });  // slopes of 5
  EXPECT_LT(tame(steep, kPatch, false, 12), 12);
  const ChartBox turn{-1, 1, -0.01, 0.01};
  const auto pinched =
      samples_of(turn, [](double u, double) { return 0.02 * (0.1 + u * u); });  // a tenth in the middle
  EXPECT_LT(tame(pinched, turn, true, 4), 2);
}

}  // namespace
}  // namespace genu
