// Each decomposition against its definition, on matrices of every rank.
#include "genu/core/decompositions.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

MatX random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  return MatX::NullaryExpr(rows, columns, [&] { return entry(random); });
}

/// rows x columns of a given rank.
MatX of_rank(Eigen::Index rank, Eigen::Index rows, Eigen::Index columns) {
  return random_matrix(rows, rank, 1) * random_matrix(rank, columns, 2);
}

double off_identity(const MatX& m) { return (m - MatX::Identity(m.rows(), m.cols())).norm(); }

template <int N>
void expect_symmetric_eigen() {
  using Matrix = Eigen::Matrix<double, N, N>;
  const int n = N == Eigen::Dynamic ? 7 : N;
  const Matrix half = random_matrix(n, n, 3), A = half + half.transpose();
  const SymmetricEigen<N> eigen = symmetric_eigen(A);
  EXPECT_LT(off_identity(eigen.vectors.transpose() * eigen.vectors), 1e-13);
  EXPECT_LT((A * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
  for (int k = 1; k < n; ++k) EXPECT_LE(eigen.values[k - 1], eigen.values[k]);
}

TEST(Decompositions, SymmetricEigenvectorsDiagonalise) {
  expect_symmetric_eigen<2>();
  expect_symmetric_eigen<3>();
  expect_symmetric_eigen<Eigen::Dynamic>();
  EXPECT_LT((symmetric_eigenvalues((Mat2() << 2, 1, 1, 2).finished()) - Vec2(1, 3)).norm(), 1e-15);
  EXPECT_LT((symmetric_eigenvalues(Mat3(Vec3(5, -1, 2).asDiagonal())) - Vec3(-1, 2, 5)).norm(), 1e-15);
  const Mat2 nothing = Mat2::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(symmetric_eigen(nothing).values.allFinite());
}

TEST(Decompositions, GeneralEigenvectorsDiagonalise) {
  const MatX A = random_matrix(6, 6, 4);
  const GeneralEigen eigen = general_eigen(A);
  const Eigen::MatrixXcd left = A.cast<std::complex<double>>() * eigen.vectors;
  EXPECT_LT((left - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
  EXPECT_NEAR(eigen.values.sum().real(), A.trace(), 1e-13);
  EXPECT_NEAR(general_eigenvalues(A).prod().real(), eigen.values.prod().real(), 1e-13);
  const MatX turn = (MatX(2, 2) << 0, -3, 3, 0).finished();
  EXPECT_NEAR(general_eigenvalues(turn).imag().cwiseAbs().minCoeff(), 3, 1e-15);
}

TEST(Decompositions, SingularValuesRebuildTheMatrix) {
  for (const auto& [rows, columns] : {std::pair{7, 4}, {4, 7}, {5, 5}}) {
    const MatX A = of_rank(3, rows, columns);
    for (const LeftVectors left : {LeftVectors::thin, LeftVectors::all}) {
      const SingularValues svd = singular_values(A, left);
      const Eigen::Index k = svd.values.size();
      EXPECT_EQ(svd.U.cols(), left == LeftVectors::all ? rows : k);
      EXPECT_EQ(svd.V.cols(), columns);
      EXPECT_LT(off_identity(svd.U.transpose() * svd.U) + off_identity(svd.V.transpose() * svd.V), 1e-13);
      EXPECT_LT((svd.U.leftCols(k) * svd.values.asDiagonal() * svd.V.leftCols(k).transpose() - A).norm(), 1e-13);
      EXPECT_LT(svd.values[3], 1e-14 * svd.values[0]);
    }
  }
}

TEST(Decompositions, TrianglesSolveLeastSquares) {
  const MatX A = random_matrix(9, 4, 5);
  const VecX b = random_matrix(9, 1, 6);
  const ThinQr qr = thin_qr(A);
  EXPECT_LT(off_identity(qr.Q.transpose() * qr.Q), 1e-14);
  EXPECT_LT((qr.Q * qr.R - A).norm(), 1e-14);
  EXPECT_EQ(MatX(qr.R.triangularView<Eigen::StrictlyLower>()).norm(), 0);

  MatX reduced = A;
  VecX right = b;
  reduce_to_triangle(reduced, right);
  const VecX x = solve_upper(reduced.topRows(4), right.head(4));
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), 1e-14);
  EXPECT_NEAR(right.tail(5).norm(), (A * x - b).norm(), 1e-14);
  EXPECT_LT((least_squares_solution(A, b) - x).norm(), 1e-14);
  EXPECT_LT((definite_solution(A.transpose() * A, A.transpose() * b) - x).norm(), 1e-13);
}

TEST(Decompositions, LeastNormSolutionLiesAcrossTheNullSpace) {
  const MatX A = of_rank(3, 5, 7);
  const VecX b = A * random_matrix(7, 1, 7), x = minimum_norm_solution(A, b);
  const MatX free = null_space(A, 1e-10);
  ASSERT_EQ(free.cols(), 4);
  EXPECT_LT(off_identity(free.transpose() * free), 1e-14);
  EXPECT_LT((A * free).norm(), 1e-14);
  EXPECT_LT((A * x - b).norm(), 1e-14);
  EXPECT_LT((free.transpose() * x).norm(), 1e-14);
  const MatX other = kernel(A, 1e-10);
  ASSERT_EQ(other.cols(), 4);
  EXPECT_LT((A * other).norm(), 1e-13 * other.norm());
}

TEST(Decompositions, NothingHeldLeavesEverythingFree) {
  EXPECT_EQ(off_identity(null_space(MatX(0, 6), 1e-10)), 0);
  EXPECT_EQ(null_space(MatX::Identity(6, 6), 1e-10).cols(), 0);
  EXPECT_EQ(kernel(MatX::Identity(6, 6), 1e-10).norm(), 0);
}

TEST(Decompositions, ASingularMatrixHasNoFullPivotSolution) {
  EXPECT_EQ(full_pivot_solution(of_rank(2, 3, 3), MatX::Identity(3, 3)).size(), 0);
  const MatX A = random_matrix(4, 4, 8);
  EXPECT_LT(off_identity(A * full_pivot_solution(A, MatX::Identity(4, 4))), 1e-13);
}

// Nothing is held, or nothing is free: dimensions that scenes without contacts and constraints have.
TEST(Decompositions, TakeMatricesWithoutRowsOrColumns) {
  const MatX none(0, 0), no_rows(0, 3), no_columns(3, 0);
  EXPECT_EQ(null_space(no_rows, 1e-10), MatX::Identity(3, 3));
  EXPECT_EQ(null_space(no_columns, 1e-10).size(), 0);
  EXPECT_EQ(null_space(none, 1e-10).size(), 0);
  EXPECT_EQ(kernel(no_rows, 1e-10), MatX::Identity(3, 3));
  EXPECT_EQ(kernel(no_columns, 1e-10).size(), 0);
  EXPECT_EQ(symmetric_eigen(none).values.size(), 0);
  EXPECT_EQ(general_eigen(none).values.size(), 0);
  EXPECT_EQ(general_eigenvalues(none).size(), 0);
  for (const LeftVectors left : {LeftVectors::thin, LeftVectors::all}) {
    const SingularValues wide = singular_values(no_rows, left), tall = singular_values(no_columns, left);
    EXPECT_EQ(wide.values.size() + tall.values.size(), 0);
    EXPECT_EQ(wide.V, MatX::Identity(3, 3));
    EXPECT_EQ(tall.U.rows(), 3);
    EXPECT_EQ(tall.U.cols(), left == LeftVectors::all ? 3 : 0);
  }
  EXPECT_EQ(thin_qr(no_columns).Q.rows(), 3);
  EXPECT_EQ(least_squares_solution(no_columns, MatX::Ones(3, 2)).size(), 0);
  EXPECT_EQ(least_squares_solution(no_rows, MatX(0, 2)), MatX::Zero(3, 2));
  EXPECT_EQ(minimum_norm_solution(no_rows, VecX()), VecX::Zero(3));
  EXPECT_EQ(minimum_norm_solution(no_columns, VecX::Ones(3)).size(), 0);
  EXPECT_EQ(full_pivot_solution(none, MatX(0, 2)).cols(), 2);
  EXPECT_EQ(definite_solution(none, VecX()).size(), 0);
}

}  // namespace
}  // namespace genu
