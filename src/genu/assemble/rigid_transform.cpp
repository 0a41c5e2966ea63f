#include "genu/assemble/rigid_transform.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include "genu/assemble/tolerances.h"

namespace genu {
namespace {

double error_of(const Mat3& R) { return (R * R.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff(); }

}  // namespace

std::string fault_of_transform(const Mat4& transform) {
  const Mat3 R = transform.topLeftCorner<3, 3>();
  const Eigen::RowVector4d last(0, 0, 0, 1);
  if ((transform.row(3) - last).cwiseAbs().maxCoeff() > kRotationRounding) {
    const bool turned = (transform.col(3).transpose() - last).cwiseAbs().maxCoeff() <= kRotationRounding;
    const auto row = transform.row(3);
    return fmt::format("has the last row {:.4g} {:.4g} {:.4g} {:.4g}, which must be 0 0 0 1{}", row[0], row[1], row[2],
                       row[3], turned ? ": it seems to be written column by column, and row by row is read" : "");
  }
  if (const double error = error_of(R); !(error <= kRotationRounding))
    return fmt::format(
        "is no rotation: its rows have the lengths {:.4g}, {:.4g}, {:.4g} (R R^T is {:.2g} off 1, at most "
        "{:g} is rounding)",
        R.row(0).norm(), R.row(1).norm(), R.row(2).norm(), error, kRotationRounding);
  if (R.determinant() < 0) return "mirrors (determinant -1): one of its frames is left-handed";
  return {};
}

Pose pose_of_transform(const Mat4& transform) {
  Pose pose;
  pose.R = transform.topLeftCorner<3, 3>();
  pose.p = transform.topRightCorner<3, 1>();
  // Newton's iteration for the polar decomposition: the error squares each time.
  constexpr int kEnough = 4;
  for (int k = 0; k < kEnough; ++k) pose.R = (1.5 * pose.R - 0.5 * pose.R * pose.R.transpose() * pose.R).eval();
  return pose;
}

}  // namespace genu
