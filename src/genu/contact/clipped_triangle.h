// Integrals over the part of a triangle where a linear function is positive. They are exact, and C1 in the function's
// values as its zero line moves over the triangle.
#pragma once

#include "genu/core/types.h"

namespace genu {

/// In barycentric coordinates l_i, over the part where sum l_i p_i > 0.
struct ClippedIntegrals {
  Mat3 mass = Mat3::Zero();   ///< of l_i l_j: sum_j mass_ij p_j is the integral of l_i p, its derivative to p_j mass_ij
  Vec3 share = Vec3::Zero();  ///< of l_i: their sum is the area of the part
};

/// For a triangle with this area and these values of p at its corners. False, with `out` unchanged, where none is
/// positive.
bool clipped_integrals(double area, const Vec3& p, ClippedIntegrals& out);

}  // namespace genu
