// The small LU beside Eigen's, and the condition that it promises beside the true one.
#include "genu/equilibrium/small_lu.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace genu {
namespace {

MatX random_matrix(int rows, int columns, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return MatX::NullaryExpr(rows, columns, [&] { return unit(random); });
}

double largest_row_sum(const MatX& m) { return m.cwiseAbs().rowwise().sum().maxCoeff(); }

TEST(SmallLu, SolvesAsEigenDoes) {
  std::mt19937 random(1);
  SmallLu lu;
  for (int n = 1; n < 40; ++n) {
    const MatX A = random_matrix(n, n, random);
    const VecX b = random_matrix(n, 1, random);
    ASSERT_GT(lu.factor(A), 0) << n;
    VecX x;
    lu.solve(b, x);
    const VecX twin = A.partialPivLu().solve(b);
    EXPECT_LT((x - twin).norm(), 1e-13 * twin.norm() / A.partialPivLu().rcond()) << n;
    EXPECT_LT((A * x - b).norm(), 1e-12 * x.norm()) << n;
  }
}

// It has to be a bound for every matrix, and a useful one for most.
TEST(SmallLu, NeverPromisesABetterConditionThanThereIs) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> decades(-12, 0);
  SmallLu lu;
  double decades_given_away = 0;
  constexpr int kCount = 2000;
  for (int k = 0; k < kCount; ++k) {
    const int n = 2 + k % 12;
    MatX A = random_matrix(n, n, random);
    // Nearly singular, by as many decades as the draw says.
    A.col(0) = A.rightCols(n - 1).rowwise().sum() + std::pow(10, decades(random)) * A.col(0);
    const double promised = lu.factor(A);
    const double rcond = 1 / (largest_row_sum(A) * largest_row_sum(A.fullPivLu().inverse()));
    EXPECT_LE(promised, rcond * (1 + 1e-3)) << n;
    decades_given_away += std::log10(rcond / promised);
  }
  EXPECT_LT(decades_given_away / kCount, 1.5);
}

TEST(SmallLu, PromisesNothingOfSingularOrNonsensicalMatrices) {
  SmallLu lu;
  EXPECT_EQ(lu.factor(MatX::Zero(3, 3)), 0);
  MatX A = MatX::Ones(4, 4);
  EXPECT_EQ(lu.factor(A), 0);
  A = MatX::Identity(4, 4);
  A(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lu.factor(A), 0);
  A(2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(lu.factor(A), 0);
}

}  // namespace
}  // namespace genu
