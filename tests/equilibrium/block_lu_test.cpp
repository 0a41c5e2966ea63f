// The factors by blocks beside the dense ones: solutions, condition, signs of eigenvalues; and what is refused.
#include "genu/equilibrium/block_lu.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace genu {
namespace {

/// Bodies in a ring, each tied to the next; three more rows, one for all bodies. `symmetric`: K is.
MatX ring(int bodies, bool symmetric, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto noise = [&](int rows, int columns) {
    return MatX::NullaryExpr(rows, columns, [&] { return unit(random); });
  };
  const int n = 6 * bodies;
  MatX m = MatX::Zero(n + 3, n + 3);
  for (int i = 0; i < bodies; ++i) {
    const int j = (i + 1) % bodies;
    m.block<6, 6>(6 * i, 6 * i) += noise(6, 6) + 4 * Mat6::Identity();
    m.block<6, 6>(6 * i, 6 * j) += noise(6, 6);
    m.block<6, 6>(6 * j, 6 * i) += noise(6, 6);
  }
  m.row(n).segment(12, 6) = noise(1, 6);
  m.row(n + 1).segment(6 * (bodies - 2), 12) = noise(1, 12);
  m.row(n + 2).head(n) = noise(1, n);
  m.col(n) = m.row(n);
  m.col(n + 1) = m.row(n + 1);
  m.col(n + 2) = m.row(n + 2);
  if (symmetric) m = ((m + m.transpose()) / 2).eval();
  return m;
}

TEST(BlockLu, SolvesAsTheDenseFactorsDo) {
  BlockLu lu;
  for (const int bodies : {10, 17, 33}) {
    for (unsigned seed = 1; seed < 6; ++seed) {
      const MatX A = ring(bodies, false, seed);
      const VecX exact = ring(bodies, false, 9).col(0) + VecX::LinSpaced(A.rows(), 0, 1);
      ASSERT_TRUE(lu.factor(A, bodies));
      VecX x;
      lu.solve(A * exact, x);
      EXPECT_LT((x - exact).norm(), 1e-14 / A.partialPivLu().rcond() * exact.norm());
    }
  }
}

TEST(BlockLu, EstimatesTheConditionAsTheDenseFactorsDo) {
  BlockLu lu;
  for (unsigned seed = 1; seed < 20; ++seed) {
    const MatX A = ring(12, false, seed);
    ASSERT_TRUE(lu.factor(A, 12));
    const MatX inverse = A.fullPivLu().inverse();
    const auto norm = [](const MatX& m) { return m.cwiseAbs().colwise().sum().maxCoeff(); };
    const double rcond = 1 / (norm(A) * norm(inverse));
    EXPECT_GE(lu.rcond(), rcond * (1 - 1e-9));
    EXPECT_LE(lu.rcond(), 3 * rcond);
  }
}

TEST(BlockLu, CountsNegativeEigenvalues) {
  BlockLu lu;
  for (unsigned seed = 1; seed < 20; ++seed) {
    const MatX A = ring(11, true, seed) - (seed % 4) * MatX::Identity(69, 69);
    ASSERT_TRUE(lu.factor(A, 11));
    const VecX values = Eigen::SelfAdjointEigenSolver<MatX>(A).eigenvalues();
    EXPECT_EQ(lu.negative_eigenvalues(), (values.array() < 0).count()) << seed;
  }
}

TEST(BlockLu, TheSameMatrixGivesTheSameBitsWhateverCameBefore) {
  const MatX A = ring(13, false, 1);
  MatX other = A;
  other.block<6, 6>(0, 36).setOnes();
  BlockLu fresh, used;
  ASSERT_TRUE(fresh.factor(A, 13));
  ASSERT_TRUE(used.factor(other, 13));
  ASSERT_TRUE(used.factor(A, 13));
  VecX x, y;
  fresh.solve(A.col(3), x);
  used.solve(A.col(3), y);
  EXPECT_EQ(x, y);
}

TEST(BlockLu, RefusesWhatItCannotPivot) {
  BlockLu lu;
  MatX A = ring(10, false, 2);
  A.topRows(6).setZero();
  A.leftCols(6).setZero();
  EXPECT_FALSE(lu.factor(A, 10));
  A = ring(10, false, 2);
  A(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lu.factor(A, 10));
}

}  // namespace
}  // namespace genu
