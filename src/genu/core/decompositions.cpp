#include "genu/core/decompositions.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Jacobi>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace genu {
namespace {

using SymmetricSolver = Eigen::SelfAdjointEigenSolver<MatX>;
using Reflections = Eigen::HouseholderQR<Eigen::Ref<MatX>>;

}  // namespace

SymmetricEigen<2> symmetric_eigen(const Mat2& matrix) {
  Eigen::JacobiRotation<double> turn;
  turn.makeJacobi(matrix(0, 0), matrix(1, 0), matrix(1, 1));
  const double c = turn.c(), s = turn.s(), fall = matrix(1, 0) == 0 ? 0 : s / c * matrix(1, 0);
  SymmetricEigen<2> out{{matrix(0, 0) - fall, matrix(1, 1) + fall}, Mat2()};
  out.vectors << c, s, -s, c;
  if (out.values[0] > out.values[1]) {
    std::swap(out.values[0], out.values[1]);
    out.vectors.col(0).swap(out.vectors.col(1));
  }
  return out;
}

SymmetricEigen<3> symmetric_eigen(const Mat3& matrix) {
  const SymmetricSolver solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const MatX& matrix) {
  if (matrix.size() == 0) return {};
  const SymmetricSolver solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vec2 symmetric_eigenvalues(const Mat2& matrix) { return symmetric_eigen(matrix).values; }
Vec3 symmetric_eigenvalues(const Mat3& matrix) { return SymmetricSolver(matrix, Eigen::EigenvaluesOnly).eigenvalues(); }

GeneralEigen general_eigen(const MatX& matrix) {
  if (matrix.size() == 0) return {};
  const Eigen::EigenSolver<MatX> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd general_eigenvalues(const MatX& matrix) {
  if (matrix.size() == 0) return {};
  return Eigen::EigenSolver<MatX>(matrix, false).eigenvalues();
}

SingularValues singular_values(const MatX& A, LeftVectors left) {
  const Eigen::Index m = A.rows(), n = A.cols();
  if (A.size() == 0) return {MatX::Identity(m, left == LeftVectors::all ? m : 0), VecX(), MatX::Identity(n, n)};
  const auto u = left == LeftVectors::all ? Eigen::ComputeFullU : Eigen::ComputeThinU;
  const Eigen::JacobiSVD<MatX> svd(A, u | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

ThinQr thin_qr(const MatX& A) {
  if (A.size() == 0) return {MatX::Zero(A.rows(), 0), MatX::Zero(0, 0)};
  MatX reflections = A;
  const Reflections qr(reflections);
  ThinQr out;
  out.Q = qr.householderQ() * MatX::Identity(A.rows(), A.cols());
  out.R = reflections.topRows(A.cols()).triangularView<Eigen::Upper>();
  return out;
}

void reduce_to_triangle(Eigen::Ref<MatX> A, Eigen::Ref<VecX> b) {
  if (A.size() == 0) return;
  const Reflections qr(A);
  b.applyOnTheLeft(qr.householderQ().adjoint());
}

VecX solve_upper(const Eigen::Ref<const MatX>& R, const Eigen::Ref<const VecX>& b) {
  return R.triangularView<Eigen::Upper>().solve(b);
}

MatX least_squares_solution(const MatX& A, const MatX& B) {
  if (A.size() == 0) return MatX::Zero(A.cols(), B.cols());
  return A.colPivHouseholderQr().solve(B);
}

VecX minimum_norm_solution(const MatX& A, const VecX& b) {
  if (A.size() == 0) return VecX::Zero(A.cols());
  return A.completeOrthogonalDecomposition().solve(b);
}

MatX null_space(const MatX& A, double threshold) {
  const Eigen::Index n = A.cols();
  if (A.size() == 0) return MatX::Identity(n, n);
  Eigen::ColPivHouseholderQR<MatX> qr(A.transpose());
  qr.setThreshold(threshold);
  const MatX Q = qr.householderQ() * MatX::Identity(n, n);
  return Q.rightCols(n - qr.rank());
}

MatX kernel(const MatX& A, double threshold) {
  if (A.size() == 0) return MatX::Identity(A.cols(), std::max<Eigen::Index>(A.cols(), 1));
  Eigen::FullPivLU<MatX> lu(A);
  lu.setThreshold(threshold);
  return lu.kernel();
}

MatX full_pivot_solution(const MatX& A, const MatX& B) {
  if (A.size() == 0) return MatX::Zero(0, B.cols());
  const Eigen::FullPivLU<MatX> lu(A);
  if (!lu.isInvertible()) return {};
  return lu.solve(B);
}

VecX definite_solution(const Eigen::Ref<const MatX>& A, const Eigen::Ref<const VecX>& b) {
  if (A.size() == 0) return VecX();
  return A.ldlt().solve(b);
}

}  // namespace genu
