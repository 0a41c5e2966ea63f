// The sums of a blend against the formula written down plainly, and between processors.
#include "genu/surface/blend_sum.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "genu/surface/height_polynomial.h"

namespace genu::test {
namespace {

constexpr double kRadius = 2.5e-3;

/// Nodes at random places about the origin, some out of reach, on two sheets.
struct Patch {
  Patch(int D, int count, unsigned seed) : degree(D), stride(12 + static_cast<std::size_t>(coefficient_count(D))) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < count; ++i) {
      for (const double reach : {3e-3, 3e-3, 2e-4}) records.push_back(reach * unit(random));
      Eigen::Vector4d turn(1, 0, 0, 0);
      for (const int axis : {1, 2, 3}) turn[axis] = (axis == 3 ? 1 : 0.1) * unit(random);
      const Mat3 axes = Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]).normalized().toRotationMatrix();
      records.insert(records.end(), axes.data(), axes.data() + 9);
      for (int k = 0; k < coefficient_count(degree); ++k)
        records.push_back(k == 0 ? 1e-4 * unit(random) : unit(random));
      sheet.push_back(i % 3 == 0 ? 1 : 0);
      candidates.push_back(count - 1 - i);
    }
  }
  BlendNodes nodes() const { return {records.data(), stride, sheet.data(), kRadius}; }

  int degree;
  std::size_t stride;
  std::vector<double> records;
  std::vector<int> sheet, candidates;
};

/// Near the surface of a patch.
Vec3 place(std::mt19937& random) {
  Vec3 x;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    x[axis] = (axis < 2 ? 1e-3 : 3e-4) * std::uniform_real_distribution<double>(-1, 1)(random);
  return x;
}

/// sum w g / sum w, one node after the other, each power by itself.
bool plain_value(const Patch& patch, const Vec3& x, int sheet, double& f) {
  double W = 0, F = 0;
  for (std::size_t i = 0; i < patch.sheet.size(); ++i) {
    const double* r = &patch.records[i * patch.stride];
    const Vec3 d = x - Eigen::Map<const Vec3>(r);
    if (d.norm() >= kRadius || (sheet >= 0 && patch.sheet[i] != sheet)) continue;
    const Vec3 local = Eigen::Map<const Mat3>(r + 3).transpose() * d;
    double h = 0;
    for (int a = 0; a <= patch.degree; ++a)
      for (int b = 0; a + b <= patch.degree; ++b)
        h += r[12 + coefficient_index(patch.degree, a, b)] * std::pow(local.x(), a) * std::pow(local.y(), b);
    const double w = std::pow(1 - d.squaredNorm() / (kRadius * kRadius), 4);
    W += w;
    F += w * (local.z() - h);
  }
  f = F / W;
  return W > 0;
}

template <int D>
void expect_plain_value_and_differences(int count, int sheet) {
  const Patch patch(D, count, 7 + static_cast<unsigned>(count));
  std::mt19937 random(3);
  int compared = 0;
  for (int k = 0; k < 50; ++k) {
    const Vec3 x = place(random);
    BlendJet jet;
    double plain;
    if (!blend_sum<D, 2>(patch.nodes(), x, patch.candidates, sheet, jet)) continue;
    ASSERT_TRUE(plain_value(patch, x, sheet, plain));
    EXPECT_NEAR(jet.f, plain, 1e-17) << D << ' ' << count;
    BlendJet first, value;
    ASSERT_TRUE((blend_sum<D, 1>(patch.nodes(), x, patch.candidates, sheet, first)));
    ASSERT_TRUE((blend_sum<D, 0>(patch.nodes(), x, patch.candidates, sheet, value)));
    EXPECT_EQ(value.f, jet.f);
    EXPECT_EQ(first.f, jet.f);
    EXPECT_EQ(first.gradient, jet.gradient);
    constexpr double kStep = 1e-7;
    for (int axis = 0; axis < 3; ++axis) {
      BlendJet up, down;
      const bool both = blend_sum<D, 1>(patch.nodes(), x + kStep * Vec3::Unit(axis), patch.candidates, sheet, up) &&
                        blend_sum<D, 1>(patch.nodes(), x - kStep * Vec3::Unit(axis), patch.candidates, sheet, down);
      if (!both) continue;  // at the end of what is in reach
      ++compared;
      EXPECT_NEAR((up.f - down.f) / (2 * kStep), jet.gradient[axis], 1e-6);
      const Vec3 bend = (up.gradient - down.gradient) / (2 * kStep);
      EXPECT_LT((bend - jet.hessian.col(axis)).norm(), 1e-4 * (1 + jet.hessian.norm()));
    }
  }
  EXPECT_GE(compared, count >= 30 ? 140 : 0) << count;
}

TEST(BlendSum, IsTheFormulaWrittenPlainlyForEveryNumberOfNodes) {
  for (const int count : {1, 2, 3, 4, 5, 30, 64, 65, 131})
    for (const int sheet : {-1, 0}) {
      expect_plain_value_and_differences<2>(count, sheet);
      expect_plain_value_and_differences<3>(count, sheet);
      expect_plain_value_and_differences<4>(count, sheet);
    }
}

TEST(BlendSum, HasTheSameBitsOnEveryProcessor) {
  const Patch patch(3, 90, 5);
  std::mt19937 random(4);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 x = place(random);
    BlendJet here, anywhere;
    ASSERT_TRUE((blend_sum<3, 2>(patch.nodes(), x, patch.candidates, -1, here)));
    ASSERT_TRUE((blend_sum_anywhere<3, 2>(patch.nodes(), x, patch.candidates, -1, anywhere)));
    EXPECT_EQ(here.f, anywhere.f);
    EXPECT_EQ(here.gradient, anywhere.gradient);
    EXPECT_EQ(here.hessian, anywhere.hessian);
  }
}

TEST(BlendSum, KnowsNothingOutOfReach) {
  const Patch patch(2, 20, 6);
  BlendJet jet;
  EXPECT_FALSE((blend_sum<2, 2>(patch.nodes(), Vec3(0, 0, 1), patch.candidates, -1, jet)));
  EXPECT_FALSE((blend_sum<2, 2>(patch.nodes(), Vec3::Zero(), {}, -1, jet)));
  EXPECT_FALSE((blend_sum<2, 2>(patch.nodes(), Vec3::Zero(), patch.candidates, 2, jet)));
}

}  // namespace
}  // namespace genu::test
