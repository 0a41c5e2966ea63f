// Eigen's decompositions behind plain functions, so that they are compiled once: as templates each file that used one
// compiled all of it anew, which was a third of the time to build. Matrices without rows or columns are allowed: a null
// space is then everything, a solution zero, and there are no eigenvalues.
#pragma once

#include <complex>

#include "genu/core/types.h"

namespace genu {

/// Eigenvalues, rising, and orthonormal eigenvectors, as columns, of a symmetric N x N matrix.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Only the lower triangle is read. Not finite where the matrix is not.
SymmetricEigen<2> symmetric_eigen(const Mat2& matrix);
SymmetricEigen<3> symmetric_eigen(const Mat3& matrix);
SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const MatX& matrix);

/// The eigenvalues alone, rising.
Vec2 symmetric_eigenvalues(const Mat2& matrix);
Vec3 symmetric_eigenvalues(const Mat3& matrix);

/// Of any real square matrix, in no order; vectors are columns of norm 1.
struct GeneralEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
GeneralEigen general_eigen(const MatX& matrix);
Eigen::VectorXcd general_eigenvalues(const MatX& matrix);

/// A = U diag(values) V^T, values falling. V is square; U has as many columns as there are values (thin) or is square.
struct SingularValues {
  MatX U;
  VecX values;
  MatX V;
};
enum class LeftVectors { thin, all };
SingularValues singular_values(const MatX& A, LeftVectors left);

/// A = Q R of an m x n matrix, m >= n, by Householder reflections: Q m x n with orthonormal columns, R n x n upper
/// triangular.
struct ThinQr {
  MatX Q, R;
};
ThinQr thin_qr(const MatX& A);

/// The same in place, for least squares |A x - b|: R in A's upper triangle (below it what is left of the reflections),
/// b turned to Q^T b.
void reduce_to_triangle(Eigen::Ref<MatX> A, Eigen::Ref<VecX> b);

/// R x = b with the upper triangle of a square matrix.
VecX solve_upper(const Eigen::Ref<const MatX>& R, const Eigen::Ref<const VecX>& b);

/// The least-squares solution X of A X = B for each column, by QR with column pivoting.
MatX least_squares_solution(const MatX& A, const MatX& B);

/// The one of least norm, by complete orthogonal decomposition.
VecX minimum_norm_solution(const MatX& A, const VecX& b);

/// Orthonormal columns that span { x : A x = 0 } (n columns in A); pivots below `threshold` of the largest are zero.
MatX null_space(const MatX& A, double threshold);

/// Columns that span the same space, by LU with full pivoting: not orthonormal, but few entries where few rows trade.
/// One column of zeros where there is none.
MatX kernel(const MatX& A, double threshold);

/// A^-1 B by LU with full pivoting; empty where A is singular.
MatX full_pivot_solution(const MatX& A, const MatX& B);

/// A x = b with a symmetric positive definite A, by LDL^T.
VecX definite_solution(const Eigen::Ref<const MatX>& A, const Eigen::Ref<const VecX>& b);

}  // namespace genu
