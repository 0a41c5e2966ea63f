// The sums of a blend over the nodes in reach of a point: four nodes at a time, in the lanes of a vector.
#pragma once

#include <span>

#include "genu/core/types.h"

namespace genu {

/// Nodes of a blend. For each a record: centre (3), axes u, v, n (9), coefficients of its height.
struct BlendNodes {
  static constexpr int kHeader = 12;
  const double* records = nullptr;
  std::size_t stride = 0;  ///< numbers in a record
  const int* sheet = nullptr;
  double radius = 0;  ///< m
};

/// f in m, gradient dimensionless, Hessian in 1/m.
struct BlendJet {
  double f = 0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
};

/// f (blend_field.h) and its derivatives up to `Order`, from heights of degree D, over those of `candidates` on one
/// sheet (-1: on any). False where too little weight is in reach. The same bits on every processor.
template <int D, int Order>
bool blend_sum(const BlendNodes& nodes, const Vec3& x, std::span<const int> candidates, int sheet, BlendJet& out);

/// The same without instructions that some processors lack.
template <int D, int Order>
bool blend_sum_anywhere(const BlendNodes& nodes, const Vec3& x, std::span<const int> candidates, int sheet,
                        BlendJet& out);

}  // namespace genu
