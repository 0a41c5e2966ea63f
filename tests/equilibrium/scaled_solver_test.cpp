// LU where it can be trusted, the least solution where it cannot, and no answer to nonsense.
#include "genu/equilibrium/scaled_solver.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace genu {
namespace {

MatX random_matrix(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  return MatX::NullaryExpr(n, n, [&] { return unit(random); });
}

TEST(ScaledSolver, WellConditionedMatricesAreSolvedByLu) {
  for (int n = 1; n < 30; n += 4) {
    const MatX A = random_matrix(n, 7) + n * MatX::Identity(n, n);
    const VecX exact = random_matrix(n, 3).col(0);
    ScaledSolver solver;
    ASSERT_TRUE(solver.factor(A));
    VecX x;
    solver.solve(A * exact, x);
    EXPECT_FALSE(solver.minimum_norm());
    EXPECT_TRUE(solver.full_rank());
    EXPECT_EQ(solver.rank(), n);
    EXPECT_LT((x - exact).norm(), 1e-13 * exact.norm());
  }
}

TEST(ScaledSolver, SingularMatricesGiveTheLeastSolution) {
  const int n = 9;
  for (int rank = 1; rank < n; ++rank) {
    const MatX A = random_matrix(n, 5).leftCols(rank) * random_matrix(n, 6).topRows(rank);
    const VecX b = random_matrix(n, 8).col(0);  // not in the range of A: least squares too
    ScaledSolver solver;
    ASSERT_TRUE(solver.factor(A));
    EXPECT_TRUE(solver.minimum_norm());
    EXPECT_FALSE(solver.full_rank());
    EXPECT_EQ(solver.rank(), rank);
    VecX x;
    solver.solve(b, x);
    Eigen::JacobiSVD<MatX> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(1e-10);
    const VecX pseudo = svd.solve(b);
    EXPECT_LT((x - pseudo).norm(), 1e-9 * pseudo.norm()) << rank;
  }
}

TEST(ScaledSolver, ExactZeroPivotsAreSeen) {
  ScaledSolver solver;
  ASSERT_TRUE(solver.factor(MatX::Zero(3, 3)));
  EXPECT_EQ(solver.rcond(), 0);
  EXPECT_EQ(solver.rank(), 0);
  VecX x;
  solver.solve(VecX::Ones(3), x);
  EXPECT_EQ(x, VecX::Zero(3));
}

TEST(ScaledSolver, RefusesWhatIsNotFinite) {
  MatX A = MatX::Identity(3, 3);
  ScaledSolver solver;
  A(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver.factor(A));
  A(1, 2) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(solver.factor(A));
  A(1, 2) = 0;
  EXPECT_TRUE(solver.factor(A));
}

TEST(ScaledSolver, NothingToSolveIsNoError) {
  ScaledSolver solver;
  ASSERT_TRUE(solver.factor(MatX(0, 0)));
  VecX x = VecX::Ones(2);
  solver.solve(VecX(0), x);
  EXPECT_EQ(x.size(), 0);
}

}  // namespace
}  // namespace genu
