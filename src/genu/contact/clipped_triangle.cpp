#include "genu/contact/clipped_triangle.h"

namespace genu {
namespace {

/// Integrals over the part of the triangle next to corner i, up to the zero line between it and the two others.
void corner(double area, const Vec3& p, Eigen::Index i, ClippedIntegrals& out) {
  const Eigen::Index j = (i + 1) % 3, k = (i + 2) % 3;
  const double to_j = p[i] / (p[i] - p[j]), to_k = p[i] / (p[i] - p[k]);
  Mat3 ends = Mat3::Zero();  // barycentric coordinates of the part's corners, one per column
  ends(i, 0) = 1;
  ends(i, 1) = 1 - to_j;
  ends(j, 1) = to_j;
  ends(i, 2) = 1 - to_k;
  ends(k, 2) = to_k;
  const Vec3 sum = ends.rowwise().sum();
  const double part = area * to_j * to_k;
  out.share = part / 3 * sum;
  out.mass = part / 12 * (ends * ends.transpose() + sum * sum.transpose());
}

}  // namespace

bool clipped_integrals(double area, const Vec3& p, ClippedIntegrals& out) {
  const int positive = (p[0] > 0) + (p[1] > 0) + (p[2] > 0);
  if (positive == 0) return false;
  if (positive == 1) {
    corner(area, p, p[0] > 0 ? 0 : p[1] > 0 ? 1 : 2, out);
    return true;
  }
  ClippedIntegrals rest;
  if (positive == 2) corner(area, p, !(p[0] > 0) ? 0 : !(p[1] > 0) ? 1 : 2, rest);
  // A corner at zero cuts nothing off: corner() then computes 0 / p = 0.
  out.share = Vec3::Constant(area / 3) - rest.share;
  out.mass = area / 12 * (Mat3::Identity() + Mat3::Ones()) - rest.mass;
  return true;
}

}  // namespace genu
