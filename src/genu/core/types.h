// Small fixed-size vectors and matrices. Everything inside genu is SI: m, N, kg, s, rad.
#pragma once

#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace genu {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Mat4 = Eigen::Matrix4d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat12 = Eigen::Matrix<double, 12, 12>;
using Mat32 = Eigen::Matrix<double, 3, 2>;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

/// An index as the standard containers take it.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The matrix of the cross product: skew(a) * b = a x b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace genu
